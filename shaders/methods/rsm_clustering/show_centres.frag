/* SPDX-License-Identifier: MIT */
layout(location = 0) out vec4 colour;

void main()
{
    colour = vec4(1.0, 0.2, 0.1, 1.0);
}
