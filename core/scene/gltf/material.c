/* SPDX-License-Identifier: MIT */
#include "core/scene/gltf/load.h"

#include "core/image/imageio.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* OpenGL 4.5 promises 16384 texels a side. */
enum { MAX_TEXTURE_SIDE = 16384 };

static bool image_bytes(const struct irb_gltf *gltf, int index, const unsigned char **data,
                        size_t *size, struct irb_error *err)
{
    const struct irb_gltf_image *image = &gltf->images[index];

    if (image->view >= 0) {
        if (!gltf_view_bytes(gltf, image->view, data, size, err))
            return irb_error_prefix(err, "image %d", index);
        return true;
    }
    if (!image->data)
        return irb_fail(err, IRB_E_INPUT, "texture file '%s' (image %d) is missing or unreadable",
                        image->uri, index);
    *data = image->data;
    *size = image->size;
    return true;
}

static bool load_image(struct gltf_loader *loader, int index, int *out, struct irb_error *err)
{
    const struct irb_gltf_image *image = &loader->gltf->images[index];
    const unsigned char *data;
    unsigned char *rgba;
    size_t size;
    int width, height;
    char name[64];

    if (!image_bytes(loader->gltf, index, &data, &size, err))
        return false;
    if (image->uri[0] || image->name[0])
        snprintf(name, sizeof name, "%s", image->uri[0] ? image->uri : image->name);
    else
        snprintf(name, sizeof name, "image %d", index);
    if (!irb_image_decode(name, data, size, &width, &height, &rgba, err))
        return false;
    if (width > MAX_TEXTURE_SIDE || height > MAX_TEXTURE_SIDE) {
        free(rgba);
        return irb_fail(err, IRB_E_INPUT, "texture '%s' is %d x %d, expected at most %d a side",
                        name, width, height, MAX_TEXTURE_SIDE);
    }
    *out = irb_builder_texture(&loader->builder, name, width, height, rgba);
    return true;
}

static bool load_texture(struct gltf_loader *loader, const struct irb_gltf_material *material,
                         int *out, struct irb_error *err)
{
    const struct irb_gltf *gltf = loader->gltf;
    int texture = material->base_color_texture, image;

    *out = -1;
    if (texture < 0)
        return true;
    if (texture >= gltf->texture_count)
        return irb_fail(err, IRB_E_INPUT, "texture %d does not exist (the file has %d)", texture,
                        gltf->texture_count);
    image = gltf->texture_images[texture];
    if (image < 0 || image >= gltf->image_count)
        return irb_fail(err, IRB_E_INPUT,
                        "texture %d: image %d does not exist or has no supported format", texture,
                        image);
    if (loader->textures[image] < 0 && !load_image(loader, image, &loader->textures[image], err))
        return false;
    *out = loader->textures[image];
    return true;
}

static void warn_about(const struct gltf_loader *loader, const struct irb_gltf_material *material,
                       int index)
{
    const char *name = material->name, *path = loader->path;

    if (material->emissive)
        irb_warn(loader->log,
                 "%s: material %d '%s' is emissive; emission is dropped, the light "
                 "comes from the experiment",
                 path, index, name);
    if (material->transparent)
        irb_warn(loader->log, "%s: material %d '%s' is transparent; it is treated as opaque", path,
                 index, name);
    if (material->transformed)
        irb_warn(loader->log, "%s: material %d '%s': KHR_texture_transform is ignored", path, index,
                 name);
    if (material->specular_glossiness)
        irb_warn(loader->log,
                 "%s: material %d '%s': KHR_materials_pbrSpecularGlossiness is "
                 "ignored, the base colour is used",
                 path, index, name);
}

/* Base colour as reflectance; clamped to [0,1], which glTF promises. */
static bool base_color(const struct gltf_loader *loader, const struct irb_gltf_material *material,
                       int index, float diffuse[3], struct irb_error *err)
{
    bool clamped = false;

    for (int i = 0; i < 3; i++) {
        double value = material->base_color[i], inside = fmin(fmax(value, 0), 1);

        if (!isfinite(value))
            return irb_fail(err, IRB_E_INPUT, "base colour is not finite");
        clamped = clamped || inside != value;
        diffuse[i] = (float)inside;
    }
    if (clamped)
        irb_warn(loader->log, "%s: material %d '%s': base colour is clamped to [0, 1]",
                 loader->path, index, material->name);
    return true;
}

/* Highest Blinn exponent: a lobe of about a degree. Reflectance of a dielectric of index 1.5. */
#define MAX_EXPONENT 1e4
#define DIELECTRIC_F0 0.04

/* The mapping of gltf_load.h. */
static void set_specular(const struct gltf_loader *loader, const struct irb_gltf_material *material,
                         int index, struct irb_material *out)
{
    double m = fmin(fmax(material->metallic, 0), 1), r = fmin(fmax(material->roughness, 0), 1);
    double alpha = fmin(fmax(2 / (r * r * r * r) - 2, 1), MAX_EXPONENT); /* r = 0: infinity */
    double lobe = 8 * (1 - pow(2, -(alpha + 2) / 2)) / (alpha + 2);

    if (!material->specular_given)
        return;
    if (material->metallic_texture) {
        irb_warn(loader->log,
                 "%s: material %d '%s': its metallic-roughness texture is not read, it is Lambert",
                 loader->path, index, material->name);
        return;
    }
    out->exponent = (float)alpha;
    for (int i = 0; i < 3; i++) {
        double base = out->diffuse[i];
        double specular = fmin(DIELECTRIC_F0 + (base - DIELECTRIC_F0) * m, 1 / lobe);

        out->specular[i] = (float)fmin(specular, 1);
        out->diffuse[i] = (float)fmin(base * (1 - m), fmax(0, 1 - lobe * out->specular[i]));
    }
}

/* The texture's alpha that is needed: what the base colour's alpha leaves of the cutoff (glTF 2.0,
 * 3.9.4). Above 1 nothing is left of the surface. */
static float mask_cutoff(const struct irb_gltf_material *material)
{
    double cutoff = fmax(material->alpha_cutoff, 0), alpha = material->base_color[3];

    if (!(cutoff > 0))
        return 0;
    return alpha > 0 ? (float)fmin(cutoff / alpha, 2) : 2;
}

bool gltf_material(struct gltf_loader *loader, int index, int *out, struct irb_error *err)
{
    static const float default_white[3] = {1, 1, 1}; /* glTF 2.0, 3.9.6 */
    const struct irb_gltf *gltf = loader->gltf;
    const struct irb_gltf_material *material;
    float diffuse[3];
    int *slot, texture;

    if (index < -1 || index >= gltf->material_count)
        return irb_fail(err, IRB_E_INPUT, "material %d does not exist (the file has %d)", index,
                        gltf->material_count);
    slot = &loader->materials[index < 0 ? gltf->material_count : index];
    if (*slot < 0 && index < 0) {
        *slot = irb_builder_material(&loader->builder, "default", default_white);
    } else if (*slot < 0) {
        material = &gltf->materials[index];
        warn_about(loader, material, index);
        if (!base_color(loader, material, index, diffuse, err) ||
            !load_texture(loader, material, &texture, err))
            return irb_error_prefix(err, "material %d '%s'", index, material->name);
        *slot = irb_builder_material(&loader->builder, material->name, diffuse);
        if (!loader->builder.failure) {
            struct irb_material *made = &loader->builder.scene->materials[*slot];

            made->diffuse_texture = texture;
            made->alpha_cutoff = mask_cutoff(material);
            set_specular(loader, material, index, made);
        }
    }
    *out = *slot;
    return true;
}
