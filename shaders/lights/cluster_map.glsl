/* SPDX-License-Identifier: MIT
 *
 * Cluster map: the number of each RSM texel's cluster, or why it has none, as
 * core/lights/cluster_map.h has it.
 */
const uint NO_CLUSTER = 0xffffffffu; /* lit, but in no cluster's reach */
const uint UNLIT = 0xfffffffeu;      /* reflects no flux */

bool is_cluster(uint value)
{
    return value < UNLIT;
}

bool is_lit(vec3 flux)
{
    return any(greaterThan(flux, vec3(0.0)));
}
