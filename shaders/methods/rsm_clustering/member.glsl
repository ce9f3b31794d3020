/* SPDX-License-Identifier: MIT
 *
 * What a texel brings into its cluster.
 */
struct member {
    vec3 position; /* m */
    float area;    /* of the surface that the texel sees, m2 */
    vec3 normal;
    vec3 flux; /* W */
};
