/* SPDX-License-Identifier: MIT
 *
 * Form factors of a polygon to the pixels of a tile, for lights/shade.glsl.
 */
#include "lights/polygon_form_factor.glsl"

/* A receiver this near to the polygon's plane, as a share of the polygon's radius, is on it as far
 * as floats can tell: its form factor is 0, not the jump between 0 and 1. Source: ours. */
const float ON_PLANE = 1e-5;

/* F/A of a polygon for the tile's pixels, 1/m2. Corners are loaded once for all pixels.
 *
 * Two loops, of which most lights need one or none: a software rasteriser leaves a loop that no
 * lane takes part in, but walks through both sides of a branch. */
void polygon_factors(virtual_light l, vec3 x[PIXELS], vec3 n[PIXELS], out float f[PIXELS])
{
    float radius = lights[l.first + 1].w;
    vec2 last = lights[l.first + 2 + CORNERS / 2].zw;
    vec3 q[PIXELS], n_l[PIXELS]; /* in the light's frame */
    vec2 a[PIXELS];
    float inverse_a[PIXELS];
    polygon_sum s[PIXELS];
    bool front[PIXELS], some = false, whole = true;
    for (int j = 0; j < PIXELS; j++) {
        q[j] = (x[j] - l.position) * l.frame;
        n_l[j] = n[j] * l.frame;
        float above = -dot(n_l[j], q[j]); /* the centre above the receiver's horizon, m */
        front[j] = q[j].z > ON_PLANE * radius && above > -radius && l.area > 0.0;
        some = some || front[j];
        /* above the horizon as a whole, and no edge is seen at an obtuse angle */
        bool far = above > radius && dot(q[j], q[j]) > 2.0 * radius * radius;
        whole = whole && (!front[j] || far);
        a[j] = last - q[j].xy;
        inverse_a[j] = inversesqrt(max(dot(a[j], a[j]) + q[j].z * q[j].z, LEAST_R2));
        s[j] = polygon_begin();
    }
    int pairs = some && whole ? CORNERS / 2 : 0, cut_pairs = some && !whole ? CORNERS / 2 : 0;
    for (int k = 0; k < pairs; k++) {
        vec4 pair = lights[l.first + 3 + k];
        for (int j = 0; j < PIXELS; j++) {
            vec2 b = pair.xy - q[j].xy, c = pair.zw - q[j].xy;
            float inverse_b = inversesqrt(max(dot(b, b) + q[j].z * q[j].z, LEAST_R2));
            float inverse_c = inversesqrt(max(dot(c, c) + q[j].z * q[j].z, LEAST_R2));
            s[j].sum += planar_term(n_l[j], q[j].z, a[j], inverse_a[j], b, inverse_b) +
                        planar_term(n_l[j], q[j].z, b, inverse_b, c, inverse_c);
            a[j] = c;
            inverse_a[j] = inverse_c;
        }
    }
    for (int k = 0; k < cut_pairs; k++) {
        vec4 pair = lights[l.first + 3 + k];
        for (int j = 0; j < PIXELS; j++) {
            vec3 b = vec3(pair.xy - q[j].xy, -q[j].z), c = vec3(pair.zw - q[j].xy, -q[j].z);
            polygon_edge(s[j], n_l[j], vec3(a[j], -q[j].z), b);
            polygon_edge(s[j], n_l[j], b, c);
            a[j] = c.xy;
        }
    }
    for (int j = 0; j < PIXELS; j++)
        f[j] = front[j] ? polygon_end(s[j], n_l[j]) / l.area : 0.0;
}
