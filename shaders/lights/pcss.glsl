/* SPDX-License-Identifier: MIT
 *
 * Visibility from imperfect shadow maps: of the light's centre, and of its disc by
 * percentage-closer soft shadows (Fernando 2005; thesis 3.1.1, 5.3.3).
 *
 * In the light's frame the disc of radius R lies in the plane z = 0. A blocker at a share
 * f = d_blocker/d_receiver of the way hides the point (u,v) R of the disc where it stands on the
 * ray from the light's centre through
 *
 *     q + w (u, v, 0),   w = R (1 - f)/f = (d_receiver - d_blocker) R / d_blocker   (eq. 3.2)
 *
 * so taps are points of the receiver's plane parallel to the disc, within w of the receiver. They
 * are projected one by one: their z is the receiver's, so none leaves the map's disc, and the
 * disc's foreshortening and the map's Jacobian come out right by themselves. (A small angle a about
 * a direction at angle theta to the normal is a/(1 + cos theta) in [-1,1]^2.)
 */
#include "lights/ism_fetch.glsl"
#include "lights/paraboloid.glsl"
#include "lights/shadow_test.glsl"

/* 1 tap = xy (unit disc): of the blocker search, then of the filter. */
layout(std140, binding = 1) uniform Taps { vec4 taps[2 * TAPS_MOST]; };

uniform int search_taps, filter_taps;
uniform float search_scale;   /* radius of the blocker search, in R */
uniform float penumbra_scale; /* factor of w */

/* Tap radii beyond this many distances of the receiver change nothing any more: the taps are at the
 * horizon. It keeps squares finite, whatever the light's area. Source: ours. */
const float WIDEST = 64.0;
/* Nearest blocker as a share of the receiver's distance; keeps eq. 3.2 finite. Source: ours. */
const float NEAREST = 1e-4;

/* The tap at offset o (m) from the receiver: whether the surface in its texel stands before the
 * receiver. That surface's z is depth.x / depth.y. The tap's own length is the distance to the
 * plane z = q.z. */
bool is_blocked(shadow_test s, vec2 o, out vec2 depth)
{
    vec2 tap = s.q.xy + o;
    float len = sqrt(dot(tap, tap) + s.q.z * s.q.z);
    ivec2 texel = ivec2(tap * (s.texels / (len + s.q.z)) + s.centre);
    float distance = uintBitsToFloat(texelFetch(ism_atlas, texel, 0).r); /* +Inf: none */
    /* direction of the texel's centre, times 1 + p.p */
    vec2 p = (vec2(texel) + 0.5 - s.centre) * (1.0 / s.texels);
    float p2 = dot(p, p);
    float plane = 2.0 * dot(p, s.m.xy) + (1.0 - p2) * s.m.z;
    vec2 change = abs(s.m.xy - p * s.m.z); /* half of it, over a unit of p */
    plane += s.slack * (change.x + change.y);
    depth = vec2(distance * (1.0 - p2), 1.0 + p2);
    float biased = distance + s.offset;
    return biased < s.scale * len && biased * plane < s.scale * (1.0 + p2);
}

/* Visibility of the light's centre: 0 or 1. */
float binary_visibility(shadow_test s)
{
    vec2 depth;
    return is_blocked(s, vec2(0.0), depth) ? 0.0 : 1.0;
}

/* Share of the disc of radius R (m) that is seen, [0,1]. Receivers that are not `needed` get any
 * value, and cost less where whole groups of them are not. */
float soft_visibility(shadow_test s, float radius, bool needed)
{
    float region = min(search_scale * radius, WIDEST * length(s.q));
    vec2 depths = vec2(0.0);
    int count = needed ? search_taps : 0;
    for (int i = 0; i < count; i++) {
        vec2 depth;
        depths += is_blocked(s, region * taps[i].xy, depth) ? depth : vec2(0.0);
    }
    /* no blocker found: lit. The quotient of both sums, rather than a mean of quotients, spares a
     * division a tap. */
    float f = depths.y > 0.0 ? max(depths.x / (depths.y * s.q.z), NEAREST) : 1.0;
    float w = min(penumbra_scale * radius * (1.0 - f) / f, region);
    int blocked = 0;
    count = depths.y > 0.0 ? filter_taps : 0;
    for (int i = 0; i < count; i++) {
        vec2 depth;
        blocked += is_blocked(s, w * taps[TAPS_MOST + i].xy, depth) ? 1 : 0;
    }
    return 1.0 - float(blocked) / float(filter_taps);
}
