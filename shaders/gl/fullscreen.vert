// SPDX-License-Identifier: MIT
// One triangle that covers the viewport, without vertex buffers. `uv` is 0..1 over it, y up.
out vec2 uv;

void main()
{
    uv = vec2(float((gl_VertexID & 1) << 1), float(gl_VertexID & 2));
    gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
