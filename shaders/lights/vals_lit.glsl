/* SPDX-License-Identifier: MIT
 *
 * Which of the buffer `vpls` have a VAL.
 */
const uint NO_VAL = 0xffffffffu; /* assignment of the others */

bool is_lit(int l)
{
    return any(greaterThan(vpls[VPL_VECTORS * l + 2].xyz, vec3(0.0)));
}
