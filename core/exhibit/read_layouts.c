/* SPDX-License-Identifier: MIT */
#include "core/exhibit/read.h"

bool irb_exhibit_read_layouts(struct irb_exhibit *exhibit, struct irb_yaml *yaml,
                              irb_yaml_node list, struct irb_error *err)
{
    (void)exhibit;
    return irb_yaml_fail(yaml, list, err, "layouts: not read yet");
}

void irb_exhibit_destroy_layouts(struct irb_exhibit *exhibit)
{
    (void)exhibit;
}
