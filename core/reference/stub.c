/* SPDX-License-Identifier: MIT
 *
 * Stands in for the tracer in a build without Embree.
 */
#include "core/reference/reference.h"

static const char missing[] = "this build has no ray-traced reference: install libembree-dev "
                              "(Embree 3.13) and configure with -Dreference=enabled";

struct irb_tracer *irb_tracer_create(const struct irb_scene *scene, struct irb_error *err)
{
    (void)scene;
    irb_fail(err, IRB_E_USAGE, "%s", missing);
    return NULL;
}

void irb_tracer_destroy(struct irb_tracer *tracer)
{
    (void)tracer;
}

bool irb_reference_render(const struct irb_reference_job *job, struct irb_reference_image *out,
                          struct irb_error *err)
{
    (void)job;
    *out = (struct irb_reference_image){0};
    return irb_fail(err, IRB_E_USAGE, "%s", missing);
}
