// SPDX-License-Identifier: MIT
//
// The only C++ of this folder: tinygltf behind core/scene/gltf/gltf.h.
#include "core/scene/gltf/gltf.h"

extern "C" {
#include "core/base/error.h"
#include "core/base/fs.h"
}

#include <cstdlib>
#include <exception>
#include <map>
#include <string>
#include <sys/stat.h>
#include <tiny_gltf.h>
#include <vector>

namespace
{

// The model, and the C structs that point into it.
struct Parsed : irb_gltf {
    tinygltf::Model model;
    std::vector<irb_gltf_buffer> buffer_list;
    std::vector<irb_gltf_view> view_list;
    std::vector<irb_gltf_accessor> accessor_list;
    std::vector<std::vector<irb_gltf_target>> target_lists;
    std::vector<std::vector<irb_gltf_primitive>> primitive_lists;
    std::vector<irb_gltf_mesh> mesh_list;
    std::vector<irb_gltf_node> node_list;
    std::vector<irb_gltf_skin> skin_list;
    std::vector<irb_gltf_material> material_list;
    std::vector<irb_gltf_image> image_list;
    std::vector<irb_gltf_light> light_list;
    std::vector<irb_gltf_camera> camera_list;
    std::vector<irb_gltf_channel> channel_list;
    std::vector<std::string> falloff_names;
    std::vector<int> texture_list, root_list;
    std::vector<const char *> required_list, used_list;
    std::string remark_text;

    Parsed() : irb_gltf()
    {
    }
};

// ---- What tinygltf may do outside ----

// External files may be this large; a .glb is bounded by its 32-bit length anyway.
constexpr size_t max_file_size = size_t(1) << 32;

// tinygltf also tries the current folder, where a file of the same name would be picked up
// silently: only paths below the asset's folder are let through.
bool file_exists(const std::string &path, void *user)
{
    const std::string &folder = *static_cast<const std::string *>(user);
    struct stat info;

    return path.compare(0, folder.size(), folder) == 0 && stat(path.c_str(), &info) == 0 &&
           S_ISREG(info.st_mode);
}

// tinygltf's own function hands the path to wordexp(), which runs $(commands).
std::string same_path(const std::string &path, void *)
{
    return path;
}

bool read_file(std::vector<unsigned char> *out, std::string *message, const std::string &path,
               void *)
{
    irb_error error = {};
    char *data = nullptr;
    size_t size = 0;

    if (!irb_fs_read(path.c_str(), max_file_size, &data, &size, &error)) {
        if (message)
            *message = error.message;
        return false;
    }
    try {
        out->assign(data, data + size);
    } catch (...) {
        std::free(data);
        throw;
    }
    std::free(data);
    return true;
}

// Keeps an external image's bytes as they are. Images in a buffer are left alone: tinygltf does not
// check their bounds, gltf_load.c does.
bool keep_image(tinygltf::Image *image, const int, std::string *, std::string *, int, int,
                const unsigned char *bytes, int size, void *)
{
    image->as_is = true;
    if (image->bufferView < 0 && size > 0)
        image->image.assign(bytes, bytes + size);
    return true;
}

// ---- Copies ----

void copy_buffers(Parsed &parsed)
{
    for (const tinygltf::Buffer &buffer : parsed.model.buffers)
        parsed.buffer_list.push_back({buffer.data.data(), buffer.data.size()});
    for (const tinygltf::BufferView &view : parsed.model.bufferViews)
        parsed.view_list.push_back(
            {view.buffer, view.byteOffset, view.byteLength, view.byteStride});
    for (const tinygltf::Accessor &accessor : parsed.model.accessors) {
        int components = accessor.type == TINYGLTF_TYPE_SCALAR ? 1
                         : accessor.type == TINYGLTF_TYPE_VEC2 ? 2
                         : accessor.type == TINYGLTF_TYPE_VEC3 ? 3
                         : accessor.type == TINYGLTF_TYPE_VEC4 ? 4
                         : accessor.type == TINYGLTF_TYPE_MAT4 ? 16
                                                               : 0;

        parsed.accessor_list.push_back({accessor.bufferView, accessor.byteOffset, accessor.count,
                                        accessor.componentType, components, accessor.normalized,
                                        accessor.sparse.isSparse});
    }
}

int attribute(const std::map<std::string, int> &attributes, const std::string &name)
{
    auto found = attributes.find(name);

    return found == attributes.end() ? -1 : found->second;
}

irb_gltf_primitive copy_primitive(Parsed &parsed, const tinygltf::Primitive &primitive)
{
    std::vector<irb_gltf_target> targets;
    irb_gltf_primitive copy = {};

    copy.position = attribute(primitive.attributes, "POSITION");
    copy.normal = attribute(primitive.attributes, "NORMAL");
    for (int set = 0; set < IRB_GLTF_TEXCOORD_SETS; set++)
        copy.texcoord[set] = attribute(primitive.attributes, "TEXCOORD_" + std::to_string(set));
    for (int set = 0; set < IRB_GLTF_JOINT_SETS; set++) {
        copy.joints[set] = attribute(primitive.attributes, "JOINTS_" + std::to_string(set));
        copy.shares[set] = attribute(primitive.attributes, "WEIGHTS_" + std::to_string(set));
    }
    copy.indices = primitive.indices;
    copy.material = primitive.material;
    copy.mode = primitive.mode;
    copy.compressed = primitive.extensions.count("KHR_draco_mesh_compression") > 0;
    for (const std::map<std::string, int> &target : primitive.targets)
        targets.push_back({attribute(target, "POSITION"), attribute(target, "NORMAL")});
    parsed.target_lists.push_back(std::move(targets));
    copy.targets = parsed.target_lists.back().data();
    copy.target_count = int(parsed.target_lists.back().size());
    return copy;
}

void copy_meshes(Parsed &parsed)
{
    for (const tinygltf::Mesh &mesh : parsed.model.meshes) {
        std::vector<irb_gltf_primitive> list;

        for (const tinygltf::Primitive &primitive : mesh.primitives)
            list.push_back(copy_primitive(parsed, primitive));
        parsed.primitive_lists.push_back(std::move(list));
    }
    for (size_t i = 0; i < parsed.model.meshes.size(); i++)
        parsed.mesh_list.push_back(
            {parsed.model.meshes[i].name.c_str(), parsed.primitive_lists[i].data(),
             int(parsed.primitive_lists[i].size()), parsed.model.meshes[i].weights.data(),
             int(parsed.model.meshes[i].weights.size())});
}

// A vector of another length than glTF's leaves the default and is reported.
bool copy_numbers(const std::vector<double> &from, double *to, size_t count, size_t node,
                  const char *what, irb_error *err)
{
    if (from.empty())
        return true;
    if (from.size() != count)
        return irb_fail(err, IRB_E_INPUT, "node %zu: '%s' has %zu numbers, expected %zu", node,
                        what, from.size(), count);
    std::copy(from.begin(), from.end(), to);
    return true;
}

int light_of(const tinygltf::Node &node)
{
    auto found = node.extensions.find("KHR_lights_punctual");

    if (found == node.extensions.end() || !found->second.Has("light"))
        return -1;
    return found->second.Get("light").GetNumberAsInt();
}

bool copy_nodes(Parsed &parsed, irb_error *err)
{
    for (const tinygltf::Node &node : parsed.model.nodes) {
        irb_gltf_node copy = {};
        size_t i = parsed.node_list.size();

        copy.name = node.name.c_str();
        copy.mesh = node.mesh;
        copy.skin = node.skin;
        copy.camera = node.camera;
        copy.light = light_of(node);
        copy.children = node.children.data();
        copy.child_count = int(node.children.size());
        copy.has_matrix = !node.matrix.empty();
        copy.weights = node.weights.data();
        copy.weight_count = int(node.weights.size());
        copy.rotation[3] = 1;
        copy.scale[0] = copy.scale[1] = copy.scale[2] = 1;
        if (!copy_numbers(node.matrix, copy.matrix, 16, i, "matrix", err) ||
            !copy_numbers(node.translation, copy.translation, 3, i, "translation", err) ||
            !copy_numbers(node.rotation, copy.rotation, 4, i, "rotation", err) ||
            !copy_numbers(node.scale, copy.scale, 3, i, "scale", err))
            return false;
        parsed.node_list.push_back(copy);
    }
    return true;
}

void copy_skins(Parsed &parsed)
{
    for (const tinygltf::Skin &skin : parsed.model.skins)
        parsed.skin_list.push_back(
            {skin.inverseBindMatrices, skin.joints.data(), int(skin.joints.size())});
}

void copy_materials(Parsed &parsed)
{
    for (const tinygltf::Material &material : parsed.model.materials) {
        const tinygltf::PbrMetallicRoughness &pbr = material.pbrMetallicRoughness;
        irb_gltf_material copy = {};

        copy.name = material.name.c_str();
        for (size_t i = 0; i < 4; i++)
            copy.base_color[i] = i < pbr.baseColorFactor.size() ? pbr.baseColorFactor[i] : 1;
        copy.base_color_texture = pbr.baseColorTexture.index;
        copy.base_color_texcoord = pbr.baseColorTexture.texCoord;
        copy.transformed = pbr.baseColorTexture.extensions.count("KHR_texture_transform") > 0;
        for (double channel : material.emissiveFactor)
            copy.emissive = copy.emissive || channel > 0;
        copy.transparent = material.alphaMode == "BLEND";
        copy.alpha_cutoff = material.alphaMode == "MASK" ? material.alphaCutoff : 0;
        copy.metallic = pbr.metallicFactor;
        copy.roughness = pbr.roughnessFactor;
        copy.specular_given = (material.values.count("metallicFactor") && copy.metallic > 0) ||
                              (material.values.count("roughnessFactor") && copy.roughness < 1);
        copy.metallic_texture = pbr.metallicRoughnessTexture.index >= 0;
        copy.specular_glossiness =
            material.extensions.count("KHR_materials_pbrSpecularGlossiness") > 0;
        parsed.material_list.push_back(copy);
    }
    for (const tinygltf::Texture &texture : parsed.model.textures)
        parsed.texture_list.push_back(texture.source);
    for (const tinygltf::Image &image : parsed.model.images)
        parsed.image_list.push_back({image.name.c_str(), image.uri.c_str(), image.bufferView,
                                     image.image.empty() ? nullptr : image.image.data(),
                                     image.image.size()});
}

// The default scene, else the first; without scenes every node that is no other's child.
void copy_roots(Parsed &parsed)
{
    const tinygltf::Model &model = parsed.model;

    if (!model.scenes.empty()) {
        int scene = model.defaultScene;

        if (scene < 0 || size_t(scene) >= model.scenes.size())
            scene = 0;
        parsed.root_list = model.scenes[size_t(scene)].nodes;
        return;
    }
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node &node : model.nodes)
        for (int child : node.children)
            if (child >= 0 && size_t(child) < is_child.size())
                is_child[size_t(child)] = true;
    for (size_t i = 0; i < is_child.size(); i++)
        if (!is_child[i])
            parsed.root_list.push_back(int(i));
}

void copy_lights(Parsed &parsed)
{
    for (const tinygltf::Light &light : parsed.model.lights) {
        const tinygltf::Value &extras = light.extras;
        bool named = extras.Has("falloff") && extras.Get("falloff").IsString();

        parsed.falloff_names.push_back(named ? extras.Get("falloff").Get<std::string>() : "");
    }
    for (size_t i = 0; i < parsed.model.lights.size(); i++) {
        const tinygltf::Light &light = parsed.model.lights[i];
        irb_gltf_light copy = {};

        copy.name = light.name.c_str();
        copy.type = light.type.c_str();
        for (size_t c = 0; c < 3; c++)
            copy.color[c] = c < light.color.size() ? light.color[c] : 1;
        copy.intensity = light.intensity;
        copy.inner = light.spot.innerConeAngle;
        copy.outer = light.spot.outerConeAngle;
        copy.falloff = parsed.falloff_names[i].c_str();
        if (light.extras.Has("half_width"))
            copy.half_width = light.extras.Get("half_width").GetNumberAsDouble();
        parsed.light_list.push_back(copy);
    }
}

void copy_cameras_and_channels(Parsed &parsed)
{
    for (const tinygltf::Camera &camera : parsed.model.cameras)
        parsed.camera_list.push_back({camera.name.c_str(), camera.type == "perspective",
                                      camera.perspective.yfov, camera.perspective.znear,
                                      camera.perspective.zfar});
    if (parsed.model.animations.empty())
        return;
    const tinygltf::Animation &animation = parsed.model.animations[0];
    for (const tinygltf::AnimationChannel &channel : animation.channels) {
        if (channel.sampler < 0 || size_t(channel.sampler) >= animation.samplers.size())
            continue;
        const tinygltf::AnimationSampler &sampler = animation.samplers[size_t(channel.sampler)];
        parsed.channel_list.push_back({channel.target_node, sampler.input, sampler.output,
                                       channel.target_path.c_str(), sampler.interpolation.c_str()});
    }
}

void publish(Parsed &parsed)
{
    const tinygltf::Model &model = parsed.model;

    copy_lights(parsed);
    copy_cameras_and_channels(parsed);
    for (const std::string &name : model.extensionsRequired)
        parsed.required_list.push_back(name.c_str());
    for (const std::string &name : model.extensionsUsed)
        parsed.used_list.push_back(name.c_str());
    parsed.version = model.asset.version.c_str();
    parsed.remark = parsed.remark_text.c_str();
    parsed.animation_count = int(model.animations.size());
#define PUBLISH(field, count, list)                                                                \
    do {                                                                                           \
        parsed.field = parsed.list.data();                                                         \
        parsed.count = int(parsed.list.size());                                                    \
    } while (0)
    PUBLISH(buffers, buffer_count, buffer_list);
    PUBLISH(views, view_count, view_list);
    PUBLISH(accessors, accessor_count, accessor_list);
    PUBLISH(meshes, mesh_count, mesh_list);
    PUBLISH(skins, skin_count, skin_list);
    PUBLISH(nodes, node_count, node_list);
    PUBLISH(materials, material_count, material_list);
    PUBLISH(images, image_count, image_list);
    PUBLISH(lights, light_count, light_list);
    PUBLISH(cameras, camera_count, camera_list);
    PUBLISH(channels, channel_count, channel_list);
    PUBLISH(texture_images, texture_count, texture_list);
    PUBLISH(roots, root_count, root_list);
    PUBLISH(required, required_count, required_list);
    PUBLISH(used, used_count, used_list);
#undef PUBLISH
}

std::string first_line(const std::string &text)
{
    return text.substr(0, text.find_first_of("\r\n"));
}

// A required extension is the likeliest cause of a failure (Draco's accessors have no data).
bool fail_parse(const Parsed &parsed, const std::string &message, irb_error *err)
{
    const std::vector<std::string> &required = parsed.model.extensionsRequired;

    irb_fail(err, IRB_E_INPUT, "%s",
             message.empty() ? "not a valid glTF 2.0 file" : first_line(message).c_str());
    if (required.empty())
        return false;
    return irb_error_prefix(err, "requires the extension %s", required[0].c_str());
}

bool load(Parsed &parsed, const void *data, size_t size, bool binary, const std::string &folder,
          irb_error *err)
{
    const std::string prefix = folder + "/";
    const tinygltf::FsCallbacks files = {file_exists, same_path, read_file, nullptr,
                                         const_cast<std::string *>(&prefix)};
    tinygltf::TinyGLTF loader;
    std::string message, warning;
    bool ok;

    loader.SetImageLoader(keep_image, nullptr);
    loader.SetFsCallbacks(files);
    if (binary)
        ok = loader.LoadBinaryFromMemory(&parsed.model, &message, &warning,
                                         static_cast<const unsigned char *>(data),
                                         static_cast<unsigned>(size), folder);
    else
        ok = loader.LoadASCIIFromString(&parsed.model, &message, &warning,
                                        static_cast<const char *>(data),
                                        static_cast<unsigned>(size), folder);
    if (!ok)
        return fail_parse(parsed, message, err);
    parsed.remark_text = first_line(message);
    copy_buffers(parsed);
    copy_meshes(parsed);
    copy_skins(parsed);
    copy_materials(parsed);
    copy_roots(parsed);
    publish(parsed);
    if (!copy_nodes(parsed, err))
        return false;
    parsed.nodes = parsed.node_list.data();
    parsed.node_count = int(parsed.node_list.size());
    return true;
}

} // namespace

extern "C" const struct irb_gltf *irb_gltf_parse(const void *data, size_t size, bool binary,
                                                 const char *folder, struct irb_error *err)
{
    Parsed *parsed = nullptr;

    try {
        parsed = new Parsed;
        if (load(*parsed, data, size, binary, folder, err))
            return parsed;
    } catch (const std::bad_alloc &) {
        irb_fail(err, IRB_E_MEMORY, "out of memory while reading glTF");
    } catch (const std::exception &problem) {
        irb_fail(err, IRB_E_INPUT, "not a valid glTF 2.0 file: %s",
                 first_line(problem.what()).c_str());
    } catch (...) {
        irb_fail(err, IRB_E_INPUT, "not a valid glTF 2.0 file");
    }
    delete parsed;
    return nullptr;
}

extern "C" void irb_gltf_destroy(const struct irb_gltf *gltf)
{
    delete static_cast<const Parsed *>(gltf);
}
