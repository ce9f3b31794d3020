/* SPDX-License-Identifier: MIT
 *
 * A parsed glTF 2.0 file as plain C structs. The C++ behind it (gltf.cc) only calls tinygltf and
 * copies; nothing is checked here but that the JSON has the shape that tinygltf wants. Indices may
 * be out of range, lengths may lie: gltf_load.c validates before it reads.
 */
#ifndef IRB_SCENE_GLTF_H
#define IRB_SCENE_GLTF_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct irb_error;

enum { IRB_GLTF_TEXCOORD_SETS = 4, IRB_GLTF_JOINT_SETS = 4 };

/* glTF's componentType and mode numbers. */
enum irb_gltf_component {
    IRB_GLTF_BYTE = 5120,
    IRB_GLTF_UNSIGNED_BYTE = 5121,
    IRB_GLTF_SHORT = 5122,
    IRB_GLTF_UNSIGNED_SHORT = 5123,
    IRB_GLTF_UNSIGNED_INT = 5125,
    IRB_GLTF_FLOAT = 5126,
};
enum irb_gltf_mode {
    IRB_GLTF_TRIANGLES = 4,
    IRB_GLTF_TRIANGLE_STRIP = 5,
    IRB_GLTF_TRIANGLE_FAN = 6
};

/* Indices into the other arrays are -1 where the file gives none. Strings are never NULL. */
struct irb_gltf_buffer {
    const unsigned char *data;
    size_t size;
};

struct irb_gltf_view {
    int buffer;
    size_t offset, length, stride; /* stride 0: tightly packed */
};

struct irb_gltf_accessor {
    int view;
    size_t offset, count;
    int component;  /* enum irb_gltf_component, or a number that is none */
    int components; /* 1..4 for SCALAR..VEC4, 16 for MAT4, else 0 */
    bool normalized, sparse;
};

/* A morph target; accessors. */
struct irb_gltf_target {
    int position, normal;
};

struct irb_gltf_primitive {
    int position, normal, indices, material; /* accessors; material */
    int texcoord[IRB_GLTF_TEXCOORD_SETS];
    int mode;
    bool compressed; /* KHR_draco_mesh_compression */
    const struct irb_gltf_target *targets;
    int target_count;
    int joints[IRB_GLTF_JOINT_SETS], shares[IRB_GLTF_JOINT_SETS]; /* JOINTS_n, WEIGHTS_n */
};

struct irb_gltf_mesh {
    const char *name;
    const struct irb_gltf_primitive *primitives;
    int primitive_count;
    const double *weights; /* of the morph targets */
    int weight_count;      /* 0: the file gives none */
};

struct irb_gltf_node {
    const char *name;
    int mesh, skin, light, camera; /* light: KHR_lights_punctual */
    const int *children;
    int child_count;
    bool has_matrix;
    double matrix[16];                            /* column-major, where has_matrix */
    double translation[3], rotation[4], scale[3]; /* else; rotation is a quaternion xyzw */
    const double *weights;                        /* of the mesh's morph targets */
    int weight_count;                             /* 0: as the mesh has them */
};

struct irb_gltf_skin {
    int inverse_bind; /* accessor */
    const int *joints;
    int joint_count;
};

struct irb_gltf_material {
    const char *name;
    double base_color[4];
    int base_color_texture, base_color_texcoord;
    bool transformed; /* the texture has KHR_texture_transform */
    bool emissive;
    bool transparent;    /* alphaMode is BLEND */
    double alpha_cutoff; /* alphaMode MASK, else 0 */
    double metallic, roughness;
    bool specular_given;      /* the file states metallic > 0 or roughness < 1 itself */
    bool metallic_texture;    /* there is a metallic-roughness texture */
    bool specular_glossiness; /* KHR_materials_pbrSpecularGlossiness: its colours are not read */
};

struct irb_gltf_image {
    const char *name, *uri;    /* uri "" for embedded images */
    int view;                  /* of an embedded image, else -1 */
    const unsigned char *data; /* the file's bytes, undecoded; NULL if it could not be read */
    size_t size;
};

struct irb_gltf_light {
    const char *name, *type;
    double color[3], intensity;
    double inner, outer; /* spot, radians */
    const char *falloff; /* our own extras: a falloff's name, "" for none */
    double half_width;   /* our own extras: of a directional beam, 0 for none */
};

struct irb_gltf_camera {
    const char *name;
    bool perspective;
    double yfov, znear, zfar; /* radians, metres; zfar 0: infinite */
};

/* A channel of the first animation. */
struct irb_gltf_channel {
    int node, input, output;          /* node; accessors */
    const char *path, *interpolation; /* "translation", ...; "LINEAR", "STEP", "CUBICSPLINE" */
};

struct irb_gltf {
    const char *version; /* of the asset: "2.0" */
    const char *remark;  /* first line of what tinygltf complained about and went on, or "" */
    const struct irb_gltf_buffer *buffers;
    const struct irb_gltf_view *views;
    const struct irb_gltf_accessor *accessors;
    const struct irb_gltf_mesh *meshes;
    const struct irb_gltf_node *nodes;
    const struct irb_gltf_skin *skins;
    const struct irb_gltf_material *materials;
    const struct irb_gltf_image *images;
    const struct irb_gltf_light *lights;
    const struct irb_gltf_camera *cameras;
    const struct irb_gltf_channel *channels; /* of the first animation */
    const int *texture_images;               /* image of each texture */
    const int *roots;                        /* nodes of the scene that is shown */
    const char *const *required;             /* extensionsRequired */
    const char *const *used;                 /* extensionsUsed */
    int buffer_count, view_count, accessor_count, mesh_count, node_count, material_count;
    int image_count, light_count, texture_count, root_count, required_count, used_count;
    int camera_count, animation_count, channel_count, skin_count;
};

/* Parses the contents of a .gltf (binary false) or .glb file. External files are looked for in
 * `folder` only. NULL and IRB_E_INPUT with tinygltf's first line; in a build without tinygltf
 * IRB_E_USAGE. No exception leaves. */
const struct irb_gltf *irb_gltf_parse(const void *data, size_t size, bool binary,
                                      const char *folder, struct irb_error *err);
void irb_gltf_destroy(const struct irb_gltf *gltf);

#ifdef __cplusplus
}
#endif

#endif
