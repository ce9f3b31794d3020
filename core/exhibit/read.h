/* SPDX-License-Identifier: MIT
 *
 * The parts of the reader of `exhibit:`, one file each. For core/exhibit only.
 *
 * Each reader gets the node of its own key, appends to the exhibit, and each destroys what it
 * reads.
 */
#ifndef IRB_EXHIBIT_READ_H
#define IRB_EXHIBIT_READ_H

#include "core/config/yaml_tree.h"
#include "core/exhibit/exhibit.h"

/* `tables:` (read_tables.c) */
bool irb_exhibit_read_tables(struct irb_exhibit *exhibit, struct irb_yaml *yaml, irb_yaml_node list,
                             struct irb_error *err);
void irb_exhibit_destroy_tables(struct irb_exhibit *exhibit);
/* `images:` (read_images.c) */
bool irb_exhibit_read_grids(struct irb_exhibit *exhibit, struct irb_yaml *yaml, irb_yaml_node list,
                            struct irb_error *err);
void irb_exhibit_destroy_grids(struct irb_exhibit *exhibit);
/* `layouts:` (read_layouts.c) */
bool irb_exhibit_read_layouts(struct irb_exhibit *exhibit, struct irb_yaml *yaml,
                              irb_yaml_node list, struct irb_error *err);
void irb_exhibit_destroy_layouts(struct irb_exhibit *exhibit);
/* `claims:` (read_claims.c); tables have been read before, and rows and columns are named by their
 * titles */
bool irb_exhibit_read_claims(struct irb_exhibit *exhibit, struct irb_yaml *yaml, irb_yaml_node list,
                             struct irb_error *err);
void irb_exhibit_destroy_claims(struct irb_exhibit *exhibit);

/* ---- what they share (read.c) ---- */

/* A text at `key` of the map: a copy, or one of `otherwise` where it is not there (NULL gives
 * NULL). */
bool irb_exhibit_text(struct irb_yaml *yaml, irb_yaml_node map, const char *key,
                      const char *otherwise, char **out, struct irb_error *err);
/* A number at `key`; *out is left alone where it is not there. */
bool irb_exhibit_number(struct irb_yaml *yaml, irb_yaml_node map, const char *key, double min,
                        double max, double *out, struct irb_error *err);
/* Likewise whole. */
bool irb_exhibit_int(struct irb_yaml *yaml, irb_yaml_node map, const char *key, int min, int max,
                     int *out, struct irb_error *err);
/* true or false. */
bool irb_exhibit_flag(struct irb_yaml *yaml, irb_yaml_node map, const char *key, bool *out,
                      struct irb_error *err);
/* calloc of count elements for a list at `node`, which must be a list of at least one item;
 * *count is set. NULL with a message. */
void *irb_exhibit_array(struct irb_yaml *yaml, irb_yaml_node node, const char *what, size_t size,
                        int *count, struct irb_error *err);

#endif
