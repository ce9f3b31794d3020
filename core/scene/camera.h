/* SPDX-License-Identifier: MIT
 *
 * For this folder: the camera's axes, from which its view matrix and its glTF node are made.
 */
#ifndef IRB_SCENE_CAMERA_H
#define IRB_SCENE_CAMERA_H

#include "core/scene/light.h"

/* Unit vectors, in double: single precision loses the eye position of scenes that lie far from the
 * origin. */
void camera_axes(const struct irb_camera *camera, double right[3], double up[3], double forward[3]);

#endif
