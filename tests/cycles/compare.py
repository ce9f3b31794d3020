# SPDX-License-Identifier: MIT
"""Whether two renderers give the same image, up to the noise that each shows between two seeds.

With A and B the means of each renderer's two images, the difference A - B has the variance
    s^2 = (<(A1 - A2)^2> + <(B1 - B2)^2>) / 4
if both converge to the same image. The mean square of A - B over the image is compared with that;
the same again for means over blocks of pixels, whose noise is lower, so that a small difference
over an area shows.
"""

BLOCK = 8  # pixels a side
LEAST_SHARE = 0.5  # of a block's pixels that must take part


class Result:
    """All relative to the mean of B."""

    def __init__(self):
        self.ratio = 0  # sum of A over sum of B
        self.difference = 0  # root mean square of A - B
        self.noise = (0, 0)  # of A and of B
        self.mean = 0  # of B, in its unit
        self.samples = 0

    @property
    def expected(self):
        return (self.noise[0] ** 2 + self.noise[1] ** 2) ** 0.5

    @property
    def factor(self):
        """Of the difference over what the noise explains."""
        return self.difference / self.expected if self.expected > 0 else float('inf')


def compare(a, b):
    """a, b: pairs of equally long lists of numbers, the same quantity with two seeds."""
    result = Result()
    count = result.samples = len(a[0])
    sums = [0.0] * 5
    for a1, a2, b1, b2 in zip(a[0], a[1], b[0], b[1]):
        mean_a, mean_b = (a1 + a2) / 2, (b1 + b2) / 2
        sums[0] += mean_a
        sums[1] += mean_b
        sums[2] += (mean_a - mean_b) ** 2
        sums[3] += (a1 - a2) ** 2 / 4
        sums[4] += (b1 - b2) ** 2 / 4
    result.mean = sums[1] / count
    result.ratio = sums[0] / sums[1]
    result.difference = (sums[2] / count) ** 0.5 / result.mean
    result.noise = tuple((s / count) ** 0.5 / result.mean for s in sums[3:5])
    return result


def pixels(channels, mask):
    """One list of the values of all channels at the pixels of the mask."""
    return [v for channel in channels for v, keep in zip(channel, mask) if keep]


def blocks(channels, mask, width, height):
    """One list of the means over blocks of pixels that are mostly in the mask."""
    groups = {}
    for y in range(height):
        for x in range(width):
            if mask[y * width + x]:
                groups.setdefault((y // BLOCK, x // BLOCK), []).append(y * width + x)
    groups = [g for g in groups.values() if len(g) >= LEAST_SHARE * BLOCK * BLOCK]
    return [sum(channel[i] for i in group) / len(group) for channel in channels
            for group in groups]


def interior(position, normal, width, height):
    """Pixels whose 3 x 3 neighbourhood is one smooth surface: normals within 25 degrees, and
    positions within 1 % of the distance to the eye of the pixel's tangent plane. Elsewhere the
    two pixel filters may see different surfaces. position: X, Y, Z, coverage; normal: X, Y, Z,
    distance to the eye."""
    least_cosine, most_step = 0.9, 0.01
    mask = [False] * (width * height)
    for y in range(1, height - 1):
        for x in range(1, width - 1):
            i = y * width + x
            n = [c[i] for c in normal[:3]]
            p = [c[i] for c in position[:3]]
            mask[i] = all(
                position[3][j] > 0 and
                sum(a * c[j] for a, c in zip(n, normal)) >= least_cosine and
                abs(sum(a * (c[j] - b) for a, b, c in zip(n, p, position))) <=
                most_step * normal[3][i]
                for j in (i + dx + dy * width for dy in (-1, 0, 1) for dx in (-1, 0, 1)))
    return mask
