/* SPDX-License-Identifier: MIT
 *
 * Form factor from a differential receiver to a polygon of uniform radiosity, by the contour
 * integral (Lambert 1760; Baum et al. 1989, eq. 8):
 *     F = 1/(2 pi) |sum_i theta_i n . (v_i x v_(i+1))/|v_i x v_(i+1)||,
 * v_i the corners seen from the receiver, theta_i the angle between neighbours, n the receiver's
 * normal. What lies below the receiver's horizon is cut off. E = Phi/A F.
 *
 *     polygon_sum s = polygon_begin();
 *     for every edge: polygon_edge(s, n, v_i, v_(i+1));
 *     F = polygon_end(s, n);
 *
 * The polygon is convex and its corners run counter-clockwise seen from its front. Receivers behind
 * it get 0. One in its plane is the caller's to leave out: there the value jumps.
 */
#include "lights/form_factor.glsl"

struct polygon_sum {
    float sum;
    vec3 leaving, entering; /* where the contour crosses the horizon, downwards and upwards */
};

polygon_sum polygon_begin()
{
    return polygon_sum(0.0, vec3(0.0), vec3(0.0));
}

/* theta/sin(theta) of an acute angle by its cosine: a polynomial (Chebyshev interpolation, relative
 * error 1e-7), smooth at 0, so that the terms of small and distant polygons cancel as they
 * should. */
float acute_angle_over_sine(float c)
{
    float g = 0.0171853692;
    g = g * c - 0.0960763048;
    g = g * c + 0.250126529;
    g = g * c - 0.421895719;
    g = g * c + 0.555748958;
    g = g * c - 0.660758619;
    g = g * c + 0.784853813;
    g = g * c - 0.99998017;
    return g * c + 1.57079621;
}

float angle_over_sine(float cosine, float sine2)
{
    float g = acute_angle_over_sine(abs(cosine));
    return cosine >= 0.0 ? g : PI * inversesqrt(max(sine2, 1e-14)) - g;
}

/* theta n . (a x b)/|a x b|; e = b - a, given, since the difference of near neighbours would lose
 * what a x e keeps. */
float contour_term(vec3 n, vec3 a, vec3 b, vec3 e)
{
    vec3 c = cross(a, e);
    float inverse = inversesqrt(max(dot(a, a) * dot(b, b), 1e-36));
    float sine2 = dot(c, c) * (inverse * inverse);
    return dot(n, c) * inverse * angle_over_sine(dot(a, b) * inverse, sine2);
}

void polygon_edge(inout polygon_sum s, vec3 n, vec3 a, vec3 b)
{
    float height_a = dot(n, a), height_b = dot(n, b);
    if (!(height_a > 0.0) && !(height_b > 0.0))
        return;
    vec3 e = b - a;
    /* where the edge crosses the horizon; only used where it does */
    float crossing = clamp(height_a / (height_a - height_b), 0.0, 1.0);
    float begin = height_a > 0.0 ? 0.0 : crossing;
    float end = height_b > 0.0 ? 1.0 : crossing;
    vec3 from = a + begin * e, to = a + end * e;
    if (!(height_a > 0.0))
        s.entering = from;
    if (!(height_b > 0.0))
        s.leaving = to;
    s.sum += contour_term(n, from, to, (end - begin) * e);
}

/* The term of an edge above the horizon whose ends are seen at an acute angle, in the polygon's own
 * frame: n the receiver's normal there, height its distance from the plane, a and b the corners in
 * the plane, seen from the foot of its perpendicular; inverse_a = 1/|(a, height)|. */
float planar_term(vec3 n, float height, vec2 a, float inverse_a, vec2 b, float inverse_b)
{
    vec2 e = b - a;
    float inverse = inverse_a * inverse_b;
    float n_c = height * (n.x * e.y - n.y * e.x) + n.z * (a.x * e.y - a.y * e.x);
    return n_c * inverse * acute_angle_over_sine((dot(a, b) + height * height) * inverse);
}

float polygon_end(polygon_sum s, vec3 n)
{
    /* along the horizon; nothing where it was not crossed */
    float sum = s.sum + contour_term(n, s.leaving, s.entering, s.entering - s.leaving);
    return max(-sum, 0.0) / (2.0 * PI); /* corners seen from the front run clockwise round n */
}
