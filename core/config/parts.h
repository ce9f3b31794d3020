/* SPDX-License-Identifier: MIT
 *
 * The parts of the config reader; each reads one section of the file. For config*.c and trial.c
 * only.
 */
#ifndef IRB_CONFIG_PARTS_H
#define IRB_CONFIG_PARTS_H

#include "core/config/config.h"
#include "core/config/yaml_tree.h"

/* Names become file names and table keys. */
enum { IRB_LONGEST_NAME = 64 };

/* Whether `name` is 1..IRB_LONGEST_NAME letters, digits, '.', '_', '-' and begins with no '.'. */
bool irb_config_name_is_valid(const char *name);
/* The file name of `path` without folder and extension, other characters replaced by '-'. */
char *irb_config_stem(const char *path);

/* `scenes:`, or `scene:` with `camera:` and `light:` at the top (config_scenes.c). */
bool irb_config_read_scenes(struct irb_config *config, struct irb_yaml *yaml,
                            struct irb_error *err);

/* `camera:` and `light:` of `scene` (config_script.c). entry->animation holds a built-in's view, or
 * is empty but for its defaults where the scene is a file. */
bool irb_config_read_script(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                            irb_yaml_node scene, bool builtin, struct irb_error *err);

/* `animation:` and `objects:` of `scene` (config_objects.c). `still`: it is a built-in that has no
 * animation. */
bool irb_config_read_poses(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                           irb_yaml_node scene, bool still, struct irb_error *err);
void irb_config_hash_poses(const struct irb_poses *poses, struct irb_hash *hash);

/* `regions:` of `scene` (config_regions.c). The boxes are checked against the resolution later,
 * once
 * --set has had its say. */
bool irb_config_read_regions(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                             irb_yaml_node scene, struct irb_error *err);
bool irb_config_check_regions(const struct irb_config *config, struct irb_error *err);
void irb_config_hash_regions(const struct irb_scene_entry *entry, struct irb_hash *hash);
void irb_config_destroy_regions(struct irb_scene_entry *entry);

/* `profile:` of `scene` (profile.c). The row is checked against the resolution later too. */
bool irb_config_read_profile(struct irb_scene_entry *entry, struct irb_yaml *yaml,
                             irb_yaml_node scene, struct irb_error *err);
bool irb_config_check_profiles(const struct irb_config *config, struct irb_error *err);

/* `seed:`, `seeds:` and `repeats:` (seeds.c): where nothing is said; the file's node; the texts of
 * --set; and what the seeds after the first add to the config's key. */
void irb_config_usual_seeds(struct irb_config *config);
bool irb_config_read_seeds(struct irb_config *config, struct irb_yaml *yaml, irb_yaml_node node,
                           struct irb_error *err);
bool irb_config_set_seed(struct irb_config *config, const char *text, struct irb_error *err);
bool irb_config_set_seeds(struct irb_config *config, const char *text, struct irb_error *err);
bool irb_config_set_repeats(struct irb_config *config, const char *text, struct irb_error *err);
void irb_config_hash_seeds(const struct irb_config *config, struct irb_hash *hash);

/* `trials:` (config_trials.c). */
bool irb_config_read_trials(struct irb_config *config, struct irb_yaml *yaml,
                            const struct irb_registry *registry, struct irb_error *err);

/* Whether the parameters of all frames go together, each trial's with themselves and with the
 * sizes, once --set has had its say (trial_frames.c). */
bool irb_config_check_trials(const struct irb_config *config, struct irb_error *err);

/* A trial of `method` with default parameters; and its name from its parameters (trial.c). */
bool irb_trial_begin(struct irb_trial *trial, const struct irb_method *method,
                     struct irb_error *err);
void irb_trial_rename(struct irb_trial *trial);
/* What parameters of the core add to the config's key, where they are set. */
void irb_trial_hash_core(const struct irb_trial *trial, struct irb_hash *hash);
/* That a parameter has no keys over the sequence. */
bool irb_trial_refuse_track(const struct irb_option *option, struct irb_error *err);
/* irb_option_set() on its parameters; `text` may hold keys. */
bool irb_trial_set(struct irb_trial *trial, const char *name, const char *text,
                   struct irb_error *err);

/* Parameters with keys (tracks.c): from text, from a config's map; the parameter has one value
 * again; what they add to the config's key. */
bool irb_track_is_text(const char *text);
bool irb_trial_parse_track(struct irb_trial *trial, const struct irb_option *option,
                           const char *text, struct irb_error *err);
bool irb_trial_read_track(struct irb_trial *trial, const struct irb_option *option,
                          struct irb_yaml *yaml, irb_yaml_node map, struct irb_error *err);
void irb_trial_drop_track(struct irb_trial *trial, const struct irb_option *option);
void irb_trial_destroy_tracks(struct irb_trial *trial);
void irb_trial_hash_tracks(const struct irb_trial *trial, struct irb_hash *hash);

#endif
