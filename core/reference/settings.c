/* SPDX-License-Identifier: MIT */
#include "core/reference/reference.h"

/* Counted up whenever the tracer may give other bits for the same inputs. */
enum { TRACER_VERSION = 1 };

const struct irb_option irb_reference_options[] = {
    IRB_OPTION_INT(struct irb_reference_settings, min_samples, 64, 1, 1 << 20, "samples/pixel",
                   "samples a pixel before the noise target is looked at", "ours"),
    IRB_OPTION_INT(struct irb_reference_settings, max_samples, 1024, 1, 1 << 20, "samples/pixel",
                   "the budget; samples are added in powers of two", "ours"),
    IRB_OPTION_FLOAT(struct irb_reference_settings, noise, 0.01, 0, 1, "",
                     "target: RMS standard error of bounce 1 relative to its mean; 0 = none",
                     "ours"),
    IRB_OPTION_INT(struct irb_reference_settings, bounces, 16, 1, 16, "",
                   "last bounce of the full solution", "design section 8.12"),
    IRB_OPTION_BOOL(struct irb_reference_settings, unoccluded, 0,
                    "also render bounce 1 without visibility between bounce point and receiver",
                    "spec reference-and-scoring"),
    IRB_OPTION_INT(struct irb_reference_settings, seed, 1, 0, 2147483647, "",
                   "of the samples; another seed gives independent noise", "ours"),
    IRB_OPTION_END,
};

struct irb_key irb_reference_key(const struct irb_key *scene, const struct irb_light *light,
                                 const struct irb_camera *camera, const struct irb_key *gbuffer,
                                 const struct irb_reference_settings *settings)
{
    struct irb_hash *hash = irb_hash_create();
    irb_hash_string(hash, "irbench reference");
    irb_hash_u64(hash, TRACER_VERSION);
    irb_hash_string(hash, scene->hex);
    irb_light_hash(light, hash);
    irb_camera_hash(camera, hash);
    irb_hash_string(hash, gbuffer->hex);
    irb_options_hash(irb_reference_options, settings, hash);
    return irb_hash_finish(hash);
}
