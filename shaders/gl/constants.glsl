/* SPDX-License-Identifier: MIT */
const float PI = 3.14159265358979324;
const float INV_PI = 0.318309886183790672;
const float TAU = 6.28318530717958648;
