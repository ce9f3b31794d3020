/* SPDX-License-Identifier: MIT
 *
 * Cluster map: R32UI of the RSM's size that has the number of each texel's cluster, or one of
 * these, read as int (shaders/lights/cluster_map.glsl). What lit texels without a cluster reflect
 * is uncovered.
 */
#ifndef IRB_LIGHTS_CLUSTER_MAP_H
#define IRB_LIGHTS_CLUSTER_MAP_H

enum irb_cluster_map_value {
    IRB_CLUSTER_UNLIT = -2, /* the texel reflects no flux */
    IRB_CLUSTER_NONE = -1   /* lit, but in no cluster's reach */
};

#endif
