/* SPDX-License-Identifier: MIT
 *
 * Exact solid angle of a square texel on the image plane z = 1, seen from the origin: two
 * triangles by Van Oosterom and Strackee 1983, eq. 8,
 *     tan(omega/2) = a . (b x c) / (|a||b||c| + (a.b)|c| + (a.c)|b| + (b.c)|a|),
 * whose triple product is side^2 for the corners of a texel, so that nothing cancels.
 */

/* atan for x >= 0 to float precision (the built-in may be a polynomial with 2e-5 relative error):
 * atan x = 2 atan(x/(1 + sqrt(1 + x^2))), until the series is short. */
float exact_atan(float x)
{
    float scale = 1.0;
    for (int i = 0; i < 3; i++) {
        if (x > 0.1) {
            x = x / (1.0 + sqrt(1.0 + x * x));
            scale *= 2.0;
        }
    }
    /* Taylor series; with x <= 0.2 the first term left out is below 1e-8 relative */
    float y = x * x;
    return scale * x * (1.0 - y * (1.0 / 3.0 - y * (1.0 / 5.0 - y * (1.0 / 7.0 - y * (1.0 / 9.0 -
           y / 11.0)))));
}

float triangle_solid_angle(vec3 a, vec3 b, vec3 c, float triple)
{
    float la = length(a), lb = length(b), lc = length(c);
    float denominator = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
    return 2.0 * exact_atan(triple / denominator);
}

float texel_solid_angle(vec2 corner, float side)
{
    vec3 a = vec3(corner, 1.0);
    vec3 b = vec3(corner.x + side, corner.y, 1.0);
    vec3 c = vec3(corner + side, 1.0);
    vec3 d = vec3(corner.x, corner.y + side, 1.0);
    float triple = side * side;
    return triangle_solid_angle(a, b, c, triple) + triangle_solid_angle(a, c, d, triple);
}
