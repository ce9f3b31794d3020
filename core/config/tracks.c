/* SPDX-License-Identifier: MIT
 *
 * Parameters with keys over the sequence: read from a config's map or from the text of a trial's
 * name, "32@0+64@4" (steps) or "32@0..64@4" (straight lines between keys), and evaluated. The text
 * holds no comma: it stands in lists of trials and in tables.
 */
#include "core/base/str.h"
#include "core/config/keys.h"
#include "core/config/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FRAMES = 1000000, MOST_KEYS = 256 };

const char *const irb_track_interpolation_names[] = {"step", "linear", NULL};
/* Between two keys of a text. */
static const char *const separators[] = {"+", ".."};

struct key_time {
    int frame;
};
static const struct irb_option time_options[] = {
    IRB_OPTION_INT(struct key_time, frame, 0, 0, MOST_FRAMES, "", "time of a key", "ours"),
    IRB_OPTION_END,
};

/* ---- tracks of a trial ---- */

static const struct irb_track *find_track(const struct irb_trial *trial,
                                          const struct irb_option *option)
{
    for (int i = 0; i < trial->track_count; i++)
        if (trial->tracks[i].option == option)
            return &trial->tracks[i];
    return NULL;
}

bool irb_trial_has_track(const struct irb_trial *trial, const struct irb_option *option)
{
    return find_track(trial, option) != NULL;
}

void irb_trial_drop_track(struct irb_trial *trial, const struct irb_option *option)
{
    int kept = 0;
    for (int i = 0; i < trial->track_count; i++) {
        if (trial->tracks[i].option == option)
            free(trial->tracks[i].keys);
        else
            trial->tracks[kept++] = trial->tracks[i];
    }
    trial->track_count = kept;
}

void irb_trial_destroy_tracks(struct irb_trial *trial)
{
    for (int i = 0; i < trial->track_count; i++)
        free(trial->tracks[i].keys);
    free(trial->tracks);
    trial->tracks = NULL;
    trial->track_count = 0;
}

static bool is_constant(const struct irb_track *track)
{
    for (int i = 1; i < track->key_count; i++)
        if (track->keys[i].value != track->keys[0].value)
            return false;
    return true;
}

/* Takes over the track's keys. Keys that all say the same are that one value. */
static void take_track(struct irb_trial *trial, struct irb_track *track)
{
    irb_trial_drop_track(trial, track->option);
    irb_option_store(track->option, trial->params, track->keys[0].value);
    if (is_constant(track)) {
        free(track->keys);
        return;
    }
    size_t count = (size_t)trial->track_count + 1;
    struct irb_track *tracks = realloc(trial->tracks, count * sizeof *tracks);
    if (!tracks)
        abort(); /* a few bytes */
    tracks[trial->track_count++] = *track;
    trial->tracks = tracks;
}

/* ---- one key ---- */

/* The value as the option's own reader takes it: range and choices. */
static bool read_value(const struct irb_trial *trial, const struct irb_option *option,
                       const char *text, double *value, struct irb_error *err)
{
    void *scratch = calloc(1, trial->method->params_size);
    bool ok = scratch
                  ? irb_option_set(trial->method->params, scratch, option->name, text, err)
                  : irb_fail(err, IRB_E_MEMORY, "out of memory for a key of '%s'", option->name);
    if (ok)
        *value = irb_option_value(option, scratch);
    free(scratch);
    return ok;
}

static bool read_frame(const struct irb_track *track, const char *text, int *frame,
                       struct irb_error *err)
{
    struct key_time time;
    if (!irb_option_set(time_options, &time, "frame", text, err))
        return false;
    int before = track->key_count ? track->keys[track->key_count - 1].frame : -1;
    if (time.frame <= before)
        return irb_fail(err, IRB_E_INPUT, "frame: expected above %d, the key before it, found %d",
                        before, time.frame);
    *frame = time.frame;
    return true;
}

static bool add_key(struct irb_track *track, int frame, double value, struct irb_error *err)
{
    if (track->key_count == MOST_KEYS)
        return irb_fail(err, IRB_E_INPUT, "%s: expected at most %d keys, found more",
                        track->option->name, MOST_KEYS);
    if (!track->keys && !(track->keys = calloc(MOST_KEYS, sizeof *track->keys)))
        return irb_fail(err, IRB_E_MEMORY, "out of memory for the keys of '%s'",
                        track->option->name);
    track->keys[track->key_count++] = (struct irb_track_key){frame, value};
    return true;
}

/* Between choices there is nothing. */
static bool can_be_linear(const struct irb_option *option)
{
    return option->type == IRB_TYPE_INT || option->type == IRB_TYPE_FLOAT;
}

static bool refuse_linear(const struct irb_option *option, struct irb_error *err)
{
    return irb_fail(err, IRB_E_INPUT, "%s: expected steps between its values, found linear",
                    option->name);
}

/* ---- "32@0+64@4" ---- */

bool irb_track_is_text(const char *text)
{
    return strchr(text, '@') != NULL;
}

/* Cuts off what stands behind the key that begins at `text`. *rest is NULL at the end. */
static bool cut_key(const struct irb_option *option, char *text, char **frame, int *separator,
                    char **rest, struct irb_error *err)
{
    char *at = strchr(text, '@');
    *rest = NULL;
    *separator = -1;
    if (!at)
        return irb_fail(err, IRB_E_INPUT, "%s: expected VALUE@FRAME, found '%.64s'", option->name,
                        text);
    *at = 0;
    *frame = at + 1;
    char *end = *frame + strspn(*frame, "0123456789");
    for (int i = 0; *end && i < 2; i++) {
        size_t length = strlen(separators[i]);
        if (strncmp(end, separators[i], length))
            continue;
        *end = 0;
        *separator = i;
        *rest = end + length;
        return true;
    }
    return true; /* or something else behind the frame, which then is none */
}

static bool parse_keys(const struct irb_trial *trial, struct irb_track *track, char *text,
                       struct irb_error *err)
{
    int first_separator = -1;
    while (text) {
        char *frame_text = NULL, *rest;
        int separator, frame = 0;
        double value = 0;
        if (!cut_key(track->option, text, &frame_text, &separator, &rest, err))
            return false;
        if (rest && first_separator >= 0 && separator != first_separator)
            return irb_fail(err, IRB_E_INPUT,
                            "%s: expected '+' (steps) or '..' (linear) between all keys, found "
                            "both",
                            track->option->name);
        if (!read_value(trial, track->option, text, &value, err))
            return false;
        if (!read_frame(track, frame_text, &frame, err))
            return irb_error_prefix(err, "%s", track->option->name);
        if (!add_key(track, frame, value, err))
            return false;
        first_separator = rest ? separator : first_separator;
        text = rest;
    }
    track->interpolation = first_separator == IRB_TRACK_LINEAR ? IRB_TRACK_LINEAR : IRB_TRACK_STEP;
    return track->interpolation == IRB_TRACK_STEP || can_be_linear(track->option) ||
           refuse_linear(track->option, err);
}

bool irb_trial_parse_track(struct irb_trial *trial, const struct irb_option *option,
                           const char *text, struct irb_error *err)
{
    struct irb_track track = {.option = option};
    char *copy = irb_strdup(text);
    bool ok = parse_keys(trial, &track, copy, err);
    free(copy);
    if (ok)
        take_track(trial, &track);
    else
        free(track.keys);
    return ok;
}

static const void *settings_of(const struct irb_trial *trial, const struct irb_option *option)
{
    return irb_trial_option_is_core(option) ? (const void *)&trial->core : trial->params;
}

void irb_trial_print(const struct irb_trial *trial, const struct irb_option *option,
                     struct irb_str *out)
{
    const struct irb_track *track = find_track(trial, option);
    if (!track)
        irb_option_print(option, settings_of(trial, option), out);
    for (int i = 0; track && i < track->key_count; i++) {
        irb_str_printf(out, "%s", i ? separators[track->interpolation] : "");
        irb_option_print_value(option, track->keys[i].value, out);
        irb_str_printf(out, "@%d", track->keys[i].frame);
    }
}

bool irb_trial_is_default(const struct irb_trial *trial, const struct irb_option *option)
{
    return !find_track(trial, option) && irb_option_is_default(option, settings_of(trial, option));
}

void irb_trial_hash_tracks(const struct irb_trial *trial, struct irb_hash *hash)
{
    for (const struct irb_option *o = trial->method->params; o->name; o++) {
        struct irb_str text = {0};
        if (!find_track(trial, o))
            continue;
        irb_str_printf(&text, "%s=", o->name);
        irb_trial_print(trial, o, &text);
        irb_hash_string(hash, irb_str_text(&text));
        irb_str_free(&text);
    }
}

/* ---- {keys: [[0, 32], [4, 64]], interpolation: step} ---- */

static bool read_key(struct irb_yaml *yaml, const struct irb_trial *trial, struct irb_track *track,
                     irb_yaml_node item, struct irb_error *err)
{
    const char *name = track->option->name, *frame_text, *text;
    int frame = 0;
    double value = 0;
    if (irb_yaml_count(item) != 2)
        return irb_yaml_fail(yaml, item, err, "%s: keys: expected [frame, value], found %s", name,
                             item->type == YAML_SEQUENCE_NODE ? "another list"
                                                              : irb_yaml_kind(item));
    irb_yaml_node time = irb_yaml_item(yaml, item, 0), node = irb_yaml_item(yaml, item, 1);
    if (!(frame_text = irb_yaml_text(yaml, time, "frame", err)) ||
        !(text = irb_yaml_text(yaml, node, name, err)))
        return false;
    if (!read_frame(track, frame_text, &frame, err)) {
        irb_error_prefix(err, "%s", name);
        return irb_yaml_prefix(yaml, time, err);
    }
    if (!read_value(trial, track->option, text, &value, err)) {
        irb_error_prefix(err, "%s", trial->method->name);
        return irb_yaml_prefix(yaml, node, err);
    }
    return add_key(track, frame, value, err) || irb_yaml_prefix(yaml, item, err);
}

static bool read_interpolation(struct irb_yaml *yaml, struct irb_track *track, irb_yaml_node map,
                               struct irb_error *err)
{
    irb_yaml_node node = irb_yaml_find(yaml, map, "interpolation");
    if (!node)
        return true;
    const char *text = irb_yaml_text(yaml, node, "interpolation", err);
    if (!text)
        return false;
    for (int i = 0; irb_track_interpolation_names[i]; i++) {
        if (strcmp(text, irb_track_interpolation_names[i]))
            continue;
        track->interpolation = (enum irb_track_interpolation)i;
        return track->interpolation == IRB_TRACK_STEP || can_be_linear(track->option) ||
               refuse_linear(track->option, err) || irb_yaml_prefix(yaml, node, err);
    }
    return irb_yaml_fail(yaml, node, err,
                         "%s: interpolation: expected one of step, linear; found '%.64s'",
                         track->option->name, text);
}

static bool read_keys(struct irb_yaml *yaml, const struct irb_trial *trial, struct irb_track *track,
                      irb_yaml_node map, struct irb_error *err)
{
    irb_yaml_node list = irb_yaml_find(yaml, map, "keys");
    int count = irb_yaml_count(list);
    if (!count)
        return irb_yaml_fail(
            yaml, list ? list : map, err, "%s: keys: expected a list of [frame, value], found %s",
            track->option->name,
            list && list->type == YAML_SEQUENCE_NODE ? "an empty one" : irb_yaml_kind(list));
    for (int i = 0; i < count; i++)
        if (!read_key(yaml, trial, track, irb_yaml_item(yaml, list, i), err))
            return false;
    return true;
}

bool irb_trial_read_track(struct irb_trial *trial, const struct irb_option *option,
                          struct irb_yaml *yaml, irb_yaml_node map, struct irb_error *err)
{
    static const char *const allowed[] = {IRB_CONFIG_TRACK_KEYS(IRB_CONFIG_KEY_NAME) NULL};
    if (irb_trial_option_is_core(option)) {
        irb_trial_refuse_track(option, err);
        return irb_yaml_prefix(yaml, map, err);
    }
    struct irb_track track = {.option = option};
    bool ok = irb_yaml_check_map(yaml, map, option->name, allowed, err) &&
              read_interpolation(yaml, &track, map, err) &&
              read_keys(yaml, trial, &track, map, err);
    if (ok)
        take_track(trial, &track);
    else
        free(track.keys);
    return ok;
}

/* ---- evaluation ---- */

static double track_value(const struct irb_track *track, int frame)
{
    const struct irb_track_key *keys = track->keys;
    int i = 0; /* the last key that has begun; before the first one that */
    while (i + 1 < track->key_count && keys[i + 1].frame <= frame)
        i++;
    if (track->interpolation == IRB_TRACK_STEP || i + 1 == track->key_count ||
        frame <= keys[i].frame)
        return keys[i].value;
    double s = (double)(frame - keys[i].frame) / (keys[i + 1].frame - keys[i].frame);
    double value = keys[i].value + s * (keys[i + 1].value - keys[i].value);
    return track->option->type == IRB_TYPE_INT ? round(value) : value;
}

void irb_trial_params(const struct irb_trial *trial, int frame, void *out)
{
    memcpy(out, trial->params, trial->method->params_size);
    for (int i = 0; i < trial->track_count; i++)
        irb_option_store(trial->tracks[i].option, out,
                         track_value(&trial->tracks[i], frame < 0 ? 0 : frame));
}
