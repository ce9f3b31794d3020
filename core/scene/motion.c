/* SPDX-License-Identifier: MIT */
#include "core/scene/motion.h"

#include "core/scene/vec.h"

#include <stdlib.h>
#include <string.h>

/* Quaternions nearer than this to parallel are interpolated linearly: sin of their angle is lost.
 */
#define NEARLY_PARALLEL 0.9999995

void irb_motion_destroy(struct irb_motion *motion)
{
    if (!motion)
        return;
    for (int i = 0; i < motion->channel_count; i++) {
        free(motion->channels[i].times);
        free(motion->channels[i].values);
    }
    free(motion->channels);
    free(motion->nodes);
    free(motion->object_nodes);
    free(motion);
}

/* ---- Matrices ---- */

void irb_motion_multiply(const double a[16], const double b[16], double out[16])
{
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;

            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            out[4 * column + row] = sum;
        }
}

/* T * R * S (glTF 2.0, 3.5.3). */
void irb_motion_local(const struct irb_motion_node *node, double out[16])
{
    const double *s = node->scale, *t = node->translation, *q = node->rotation;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double x = 0, y = 0, z = 0, w = 1;

    if (node->has_matrix) {
        memcpy(out, node->matrix, sizeof node->matrix);
        return;
    }
    if (length > 0) {
        x = q[0] / length;
        y = q[1] / length;
        z = q[2] / length;
        w = q[3] / length;
    }
    const double columns[4][4] = {{s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w),
                                   s[0] * 2 * (x * z - y * w), 0},
                                  {s[1] * 2 * (x * y - z * w), s[1] * (1 - 2 * (x * x + z * z)),
                                   s[1] * 2 * (y * z + x * w), 0},
                                  {s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w),
                                   s[2] * (1 - 2 * (x * x + y * y)), 0},
                                  {t[0], t[1], t[2], 1}};
    memcpy(out, columns, sizeof columns);
}

/* Of an affine matrix, by cofactors. */
static bool invert(const double m[16], double out[16])
{
    const double *axes[3] = {m, m + 4, m + 8};
    double rows[3][3], determinant;

    for (int i = 0; i < 3; i++)
        vec_cross(axes[(i + 1) % 3], axes[(i + 2) % 3], rows[i]);
    determinant = vec_dot(axes[0], rows[0]);
    if (determinant == 0 || !isfinite(1 / determinant))
        return false;
    memset(out, 0, 16 * sizeof *out);
    out[15] = 1;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            out[4 * column + row] = rows[row][column] / determinant;
        out[12 + row] = -vec_dot(rows[row], m + 12) / determinant;
    }
    return true;
}

/* ---- Keys ---- */

/* `part` of a CUBIC key: 0 in-tangent, 1 value, 2 out-tangent. */
static const float *key_values(const struct irb_motion_channel *channel, int key, int part)
{
    int parts = channel->interpolation == IRB_MOTION_CUBIC ? 3 : 1;

    return channel->values +
           (size_t)channel->width * ((size_t)key * (size_t)parts + (size_t)(parts == 3 ? part : 0));
}

/* Spherical linear interpolation the short way round (glTF 2.0, appendix C.4). */
static void slerp(const float *a, const float *b, double s, double out[4])
{
    double cosine = 0, sign, from = 1 - s, to = s;

    for (int i = 0; i < 4; i++)
        cosine += (double)a[i] * b[i];
    sign = cosine < 0 ? -1 : 1;
    cosine = fabs(cosine);
    if (cosine < NEARLY_PARALLEL) {
        double angle = acos(cosine);

        from = sin((1 - s) * angle) / sin(angle);
        to = sin(s * angle) / sin(angle);
    }
    for (int i = 0; i < 4; i++)
        out[i] = from * a[i] + sign * to * b[i];
}

/* Between keys k and k + 1 at s in (0,1) (glTF 2.0, appendix C). */
static void interpolate(const struct irb_motion_channel *channel, int k, double s, double *out)
{
    const float *a = key_values(channel, k, 1), *b = key_values(channel, k + 1, 1);
    double length = (double)channel->times[k + 1] - channel->times[k];
    double s2 = s * s, s3 = s2 * s;

    if (channel->interpolation == IRB_MOTION_LINEAR && channel->path == IRB_MOTION_ROTATION) {
        slerp(a, b, s, out);
        return;
    }
    for (int i = 0; i < channel->width; i++) {
        if (channel->interpolation == IRB_MOTION_STEP)
            out[i] = a[i];
        else if (channel->interpolation == IRB_MOTION_LINEAR)
            out[i] = a[i] + s * ((double)b[i] - a[i]);
        else
            out[i] = (2 * s3 - 3 * s2 + 1) * a[i] +
                     (s3 - 2 * s2 + s) * length * key_values(channel, k, 2)[i] +
                     (3 * s2 - 2 * s3) * b[i] +
                     (s3 - s2) * length * key_values(channel, k + 1, 0)[i];
    }
}

static void evaluate_channel(const struct irb_motion_channel *channel, double seconds, double *out)
{
    const float *times = channel->times;
    int last = channel->count - 1, k = 0;

    while (k < last && times[k + 1] <= seconds)
        k++;
    if (k == last || seconds <= times[k]) {
        for (int i = 0; i < channel->width; i++)
            out[i] = key_values(channel, k, 1)[i];
        return;
    }
    interpolate(channel, k, (seconds - times[k]) / ((double)times[k + 1] - times[k]), out);
}

/* ---- Nodes ---- */

static void world_matrices(const struct irb_motion *motion, const struct irb_motion_node *nodes,
                           double (*world)[16])
{
    for (int n = 0; n < motion->node_count; n++) {
        double local[16];

        irb_motion_local(&nodes[n], local);
        if (nodes[n].parent < 0)
            memcpy(world[n], local, sizeof local);
        else
            irb_motion_multiply(world[nodes[n].parent], local, world[n]);
    }
}

void irb_motion_rest(const struct irb_motion *motion, double (*world)[16])
{
    world_matrices(motion, motion->nodes, world);
}

bool irb_motion_weights(const struct irb_motion *motion, int node, double seconds, double *weights)
{
    bool found = false;

    for (int c = 0; c < motion->channel_count; c++) {
        const struct irb_motion_channel *channel = &motion->channels[c];

        if (channel->path != IRB_MOTION_WEIGHTS || channel->node != node)
            continue;
        evaluate_channel(channel, seconds, weights);
        found = true;
    }
    return found;
}

bool irb_motion_prepare(struct irb_motion *motion, int *node)
{
    double(*world)[16] = malloc(((size_t)motion->node_count + 1) * sizeof *world);
    bool ok = true;

    *node = 0;
    if (!world)
        return false;
    for (int c = 0; c < motion->channel_count; c++)
        if (motion->channels[c].path != IRB_MOTION_WEIGHTS)
            motion->nodes[motion->channels[c].node].moves = true;
    world_matrices(motion, motion->nodes, world);
    for (int n = 0; n < motion->node_count && ok; n++) {
        struct irb_motion_node *at = &motion->nodes[n];

        at->moves = at->moves || (at->parent >= 0 && motion->nodes[at->parent].moves);
        ok = !at->moves || invert(world[n], at->rest_inverse);
        *node = n;
    }
    free(world);
    return ok;
}

void irb_motion_evaluate(const struct irb_motion *motion, double seconds, double (*world)[16])
{
    struct irb_motion_node *posed = malloc(((size_t)motion->node_count + 1) * sizeof *posed);

    if (!posed) { /* the pose at rest */
        world_matrices(motion, motion->nodes, world);
        return;
    }
    memcpy(posed, motion->nodes, (size_t)motion->node_count * sizeof *posed);
    for (int c = 0; c < motion->channel_count; c++) {
        const struct irb_motion_channel *channel = &motion->channels[c];
        struct irb_motion_node *node = &posed[channel->node];
        double *slots[] = {node->translation, node->rotation, node->scale};

        if (channel->path != IRB_MOTION_WEIGHTS)
            evaluate_channel(channel, seconds, slots[channel->path]);
    }
    world_matrices(motion, posed, world);
    free(posed);
}

bool irb_motion_transform(const struct irb_motion *motion, double (*world)[16], int object,
                          float transform[16])
{
    int node = motion->object_nodes[object];
    double product[16];

    if (node < 0 || !motion->nodes[node].moves)
        return false;
    irb_motion_multiply(world[node], motion->nodes[node].rest_inverse, product);
    for (int i = 0; i < 16; i++)
        transform[i] = (float)product[i];
    return true;
}
