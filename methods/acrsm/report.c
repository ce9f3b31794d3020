/* SPDX-License-Identifier: MIT
 *
 * What a frame's report says of the clusters, and their pictures.
 */
#include "methods/acrsm/clusters.h"

#include <math.h>

struct light {
    float position[4], normal[4], flux[4];
};

static double mean3(const float v[3])
{
    return ((double)v[0] + v[1] + v[2]) / 3;
}

/* Standard deviation over mean; 0 for none. */
static double variation(const double *values, int count)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < count; i++)
        sum += values[i];
    const double mean = count ? sum / count : 0;
    for (int i = 0; i < count; i++)
        squares += (values[i] - mean) * (values[i] - mean);
    return mean > 0 ? sqrt(squares / count) / mean : 0;
}

static void measure(const struct acrsm_cluster *clusters, int active, struct acrsm_report *out)
{
    double deltas[ACRSM_CLUSTERS_MOST], counts[ACRSM_CLUSTERS_MOST], most = 0;
    for (int i = 0; i < active; i++)
        if (clusters[i].count > 0)
            most = fmax(most, clusters[i].area);
    for (int i = 0; i < active; i++) {
        if (clusters[i].count <= 0)
            continue;
        deltas[out->in_use] = most > 0 ? clusters[i].area / most * clusters[i].importance : 0;
        counts[out->in_use++] = clusters[i].count;
    }
    out->spread = variation(deltas, out->in_use);
    out->count_spread = variation(counts, out->in_use);
}

bool acrsm_clusters_report(struct acrsm_clusters *c, const struct irb_rsm *rsm,
                           struct acrsm_report *out, struct irb_error *err)
{
    struct acrsm_cluster clusters[ACRSM_CLUSTERS_MOST];
    struct light lights[ACRSM_CLUSTERS_MOST];
    uint32_t lists[3];
    struct irb_cluster_census texels;
    double emitted = 0, mapped = 0;

    *out = (struct acrsm_report){0};
    if (!irb_cluster_count(&c->counter, rsm, c->map, &texels, err) ||
        !irb_buffer_read(c->state, 0, sizeof clusters, clusters, err) ||
        !irb_buffer_read(c->lights, 0, sizeof lights, lights, err) ||
        !irb_buffer_read(c->lists, ACRSM_MERGED_OFFSET, sizeof lists, lists, err))
        return false;
    measure(clusters, c->active, out);
    for (int i = 0; i < c->active; i++) {
        emitted += mean3(lights[i].flux);
        mapped += clusters[i].count > 0 ? mean3(clusters[i].flux) : 0;
    }
    out->merged = (int)lists[0];
    out->split = (int)lists[1];
    out->seeded = (int)lists[2];
    out->uncovered = texels.flux > 0 ? texels.uncovered_flux / texels.flux : 0;
    out->gain = texels.flux > 0 ? (emitted - mapped) / texels.flux : 0;
    return true;
}

bool acrsm_clusters_picture(struct acrsm_clusters *c, enum acrsm_picture kind,
                            const struct irb_texture *picture, struct irb_error *err)
{
    const struct irb_gl_api *api = &c->gl->api;
    const struct irb_program *program =
        acrsm_program(c, (enum acrsm_program)(ACRSM_PICTURE + kind), err);
    const unsigned groups = (unsigned)(c->resolution + 7) / 8;
    if (!program)
        return false;
    irb_program_use(program);
    api->BindTextureUnit(0, c->map->id);
    irb_program_int(program, "cluster_map", 0);
    api->BindImageTexture(0, picture->id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    api->DispatchCompute(groups, groups, 1);
    acrsm_barrier(c);
    return irb_gl_check(c->gl, "acrsm: picture", err);
}
