/* SPDX-License-Identifier: MIT
 *
 * Visibility of disc-shaped lights by convolution soft shadow maps (core/lights/csm.h). The uniforms
 * are set by irb_csm_bind(); CSM_ORDER, CSM_SAT and RASTER_PROJECTION by irb_csm_defines().
 *
 * For a receiver at depth d, over a footprint of the map, with [] the means over it:
 *
 *     s_f   = 1/2 + sum a_k (cos(c_k d) [sin(c_k z)] - sin(c_k d) [cos(c_k z)])   (eqs 3.4, 3.5)
 *     z_avg = ([z] - [z]/2 - sum a_k (cos(c_k d) [z sin(c_k z)] - sin(c_k d) [z cos(c_k z)]))
 *             / (1 - s_f)                                                            (thesis 3.2.5)
 *
 * a_k = 2/c_k, less where damped. This is the mean of H(z - d): 1 where the map's surface lies
 * behind the receiver. (The thesis writes H(d - z) and prints the series of H(z - d).) In z_avg the
 * inverted test is 1 - f, so [z] stands for its constant term.
 */
#include "lights/csm.glsl"
#include "lights/paraboloid.glsl"
#include "lights/raster_charts.glsl"

uniform sampler2DArray csm_images;
uniform int csm_size;   /* texels a side of a face */
uniform int csm_levels; /* of mipmaps */
uniform float csm_span; /* largest z */
uniform float csm_offset, csm_search_offset; /* in z */
uniform float csm_scale;
uniform float csm_search_scale, csm_penumbra_scale;
layout(std140, binding = CSM_RANGES) uniform CsmRanges { vec4 csm_ranges[CSM_MOST]; };
layout(std140, binding = CSM_WEIGHTS) uniform CsmWeights { vec4 csm_weights[CSM_ORDER_MOST]; };

/* Widest footprint, as the angle of its radius; wider ones take in most of the hemisphere. Source:
 * ours. */
const float CSM_WIDEST = 1.0;
/* Share of a footprint that must be covered for it to have a blocker: below it 1 - s_f says nothing
 * any more. Source: ours. */
const float CSM_LEAST_COVER = 0.02;
/* Nearest blocker as a share of the receiver's distance; keeps eq. 3.2 finite. Source: ours. */
const float CSM_NEAREST = 1e-3;

/* Where a direction lies: texels, the bounds that its footprint must not leave, the first layer,
 * and texels a radian. */
struct csm_place {
    vec2 centre, low, high;
    int layer;
    float density;
};

/* d: unit, d.z >= 0. */
csm_place csm_place_of(int map, vec3 d)
{
    csm_place p;
    float size = float(csm_size);
    p.low = vec2(0.0);
    p.high = vec2(size);
#if RASTER_PROJECTION == 0
    bool top = d.z >= max(abs(d.x), abs(d.y)), on_x = abs(d.x) >= abs(d.y);
    float w = top ? d.z : on_x ? d.x : d.y;
    vec2 uv = (top ? d.xy : on_x ? d.yz : d.xz) / w;
    int face = top ? 0 : on_x ? 1 : 2;
    /* never across the horizon, where the other side begins */
    p.low.y = !top && w > 0.0 ? 0.5 * size : 0.0;
    p.high.y = !top && w < 0.0 ? 0.5 * size : size;
    p.layer = (3 * map + face) * CSM_LAYERS;
    /* a texel's area against its solid angle: 1/cos^3 */
    p.density = 0.5 * size * inversesqrt(abs(w * w * w));
#else
    vec2 uv = paraboloid(d);
    p.layer = map * CSM_LAYERS;
    p.density = 0.5 * size / (1.0 + d.z);
#endif
    p.centre = clamp((0.5 * uv + 0.5) * size, p.low, p.high);
    return p;
}

#if CSM_SAT
/* A box, texels. */
struct csm_footprint {
    vec4 box; /* low, high */
    float scale;
};

csm_footprint csm_footprint_of(csm_place p, float side)
{
    csm_footprint f;
    f.box = vec4(max(p.centre - 0.5 * side, p.low), min(p.centre + 0.5 * side, p.high));
    vec2 extent = f.box.zw - f.box.xy;
    f.scale = 1.0 / (extent.x * extent.y);
    return f;
}

/* Sum over [0, x] x [0, y]: texel i ends at i + 1, and before the first there is nothing. */
vec4 csm_sum(vec2 at, int layer)
{
    vec2 first = min(at, 1.0);
    return first.x * first.y *
           textureLod(csm_images, vec3((at - 0.5) / float(csm_size), layer), 0.0);
}

vec4 csm_mean(csm_footprint f, int layer)
{
    return f.scale * ((csm_sum(f.box.zw, layer) - csm_sum(f.box.xw, layer)) -
                      (csm_sum(f.box.zy, layer) - csm_sum(f.box.xy, layer)));
}
#else
/* Bilinear in two levels. */
struct csm_footprint {
    vec2 fine, coarse; /* texture coordinates */
    float level, blend;
};

vec2 csm_inside(csm_place p, float level)
{
    float half_texel = 0.5 * exp2(level);
    return clamp(p.centre, p.low + half_texel, p.high - half_texel) / float(csm_size);
}

/* A bilinear look-up is a box of one texel convolved with a tent of two: variance 1/4 texel^2,
 * that of a box of sqrt(3) texels. */
csm_footprint csm_footprint_of(csm_place p, float side)
{
    csm_footprint f;
    float level = clamp(log2(side * 0.57735027), 0.0, float(csm_levels - 1));
    f.level = min(floor(level), float(csm_levels - 2));
    f.blend = level - f.level;
    f.fine = csm_inside(p, f.level);
    f.coarse = csm_inside(p, f.level + 1.0);
    return f;
}

vec4 csm_mean(csm_footprint f, int layer)
{
    return mix(textureLod(csm_images, vec3(f.fine, layer), f.level),
               textureLod(csm_images, vec3(f.coarse, layer), f.level + 1.0), f.blend);
}
#endif

/* s_f, before scale. */
float csm_lit(csm_footprint f, int layer, float d)
{
    csm_phase p = csm_phase_of(d);
    float sum = 0.5;
    for (int i = 0; i < CSM_PAIRS; i++) {
        vec4 basis = csm_mean(f, layer + 1 + i);
        sum += csm_weights[2 * i].x * (p.now.x * basis.x - p.now.y * basis.y);
        csm_phase_next(p);
        if (2 * i + 2 <= CSM_ORDER)
            sum += csm_weights[2 * i + 1].x * (p.now.x * basis.z - p.now.y * basis.w);
        csm_phase_next(p);
    }
    return sum;
}

/* z_avg in [0, receiver], or the receiver's own z where nothing is nearer than d. */
float csm_blocker(csm_footprint f, int layer, float d, float receiver)
{
    csm_phase p = csm_phase_of(d);
    float mean_z = csm_mean(f, layer).x, lit = 0.5, lit_z = 0.5 * mean_z;
    for (int i = 0; i < CSM_PAIRS; i++) {
        vec4 basis = csm_mean(f, layer + 1 + i);
        vec4 weighted = csm_mean(f, layer + 1 + CSM_PAIRS + i);
        vec2 a = csm_weights[2 * i].x * vec2(p.now.x, -p.now.y);
        lit += dot(a, basis.xy);
        lit_z += dot(a, weighted.xy);
        csm_phase_next(p);
        if (2 * i + 2 <= CSM_ORDER) {
            a = csm_weights[2 * i + 1].x * vec2(p.now.x, -p.now.y);
            lit += dot(a, basis.zw);
            lit_z += dot(a, weighted.zw);
        }
        csm_phase_next(p);
    }
    float cover = 1.0 - lit;
    return cover > CSM_LEAST_COVER ? clamp((mean_z - lit_z) / cover, 0.0, receiver) : receiver;
}

/* Side of the square, texels, that has the solid angle of a disc of radius w (m) parallel to the
 * light at the receiver: sqrt(cosine) is its foreshortening. At least a texel. */
float csm_side(csm_place p, float w, float distance, float cosine)
{
    const float SQRT_PI = 1.77245385;
    float angle = min(w * sqrt(cosine) / distance, CSM_WIDEST);
    return clamp(SQRT_PI * angle * p.density, 1.0, float(csm_size));
}

/* Share of a disc of radius `radius` (m) round the light that q (m, in the light's frame) sees, in
 * [0,1]. q.z < 0 is taken for the horizon. Of radius 0: of its centre. */
float csm_visibility(int map, vec3 q, float radius)
{
    float distance = max(length(q), 1e-9);
    vec3 d = vec3(q.xy, max(q.z, 0.0)) / distance;
    d = dot(d, d) > 1e-6 ? normalize(d) : vec3(0.0, 0.0, 1.0);
    csm_place p = csm_place_of(map, d);
    float z = min(distance * csm_ranges[map].x, csm_span);
    float w = 0.0, region = csm_search_scale * radius;
    if (region > 0.0) {
        csm_footprint search = csm_footprint_of(p, csm_side(p, region, distance, d.z));
        float blocker = csm_blocker(search, p.layer, z - csm_search_offset, z);
        if (blocker == z) /* none */
            return 1.0;
        float near = z > 0.0 ? max(blocker / z, CSM_NEAREST) : 1.0;
        w = min(csm_penumbra_scale * radius * (1.0 - near) / near, region); /* eq. 3.2 */
    }
    csm_footprint f = csm_footprint_of(p, csm_side(p, w, distance, d.z));
    return clamp(csm_scale * csm_lit(f, p.layer, z - csm_offset), 0.0, 1.0);
}
