/* SPDX-License-Identifier: MIT
 *
 * The thesis's splatter (5.3.2), geometry stage: projects a point into its s_f maps. MOST_MAPS is
 * ceil(s_f).
 */
layout(points) in;
layout(points, max_vertices = MOST_MAPS) out;
#include "lights/ism_splat.glsl"

in vec3 position[];
in vec3 share_of_point[];
flat in uint index[];
flat in uint random[];

flat out float distance_to_light; /* m */
flat out ivec2 origin;            /* of the map in the atlas, texels */

void main()
{
    int maps = map_count(random[0]);
    for (int j = 0; j < maps; j++) {
        int map = int((index[0] + uint(j)) % uint(light_count));
        map_light light = fetch_light(map);
        splat s = project(position[0], share_of_point[0], light);
        if (light.dark || !s.visible)
            continue;
        origin = map_origin(map);
        distance_to_light = s.distance;
        /* The square's edges fall between texel centres: any rasteriser covers the same texels. Its
         * centre lies in the map, since the horizon is left out. */
        vec2 centre = vec2(origin + s.corner) + 0.5 * float(s.side);
        gl_PointSize = float(s.side);
        /* Distances below 2^60 m keep all their bits in a float depth buffer. */
        gl_Position = vec4(centre * (2.0 / float(map_size * maps_a_row)) - 1.0,
                           s.distance * exp2(-60.0), 1.0);
        EmitVertex();
        EndPrimitive();
    }
}
