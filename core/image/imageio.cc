/* SPDX-License-Identifier: MIT
 *
 * The thin C++ side of imageio.h. No exception leaves it.
 */
extern "C" {
#include "core/base/fs.h"
#include "core/image/imageio.h"
}

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace
{

/* Larger textures than this are taken for damaged files; 4 bytes each stay below 1 GiB. */
constexpr int max_side = 32768;
constexpr long long max_pixels = 1LL << 28;

/* OpenImageIO's messages may span lines; ours are one. */
std::string one_line(std::string text)
{
    for (char &c : text)
        if (c == '\n' || c == '\r')
            c = ' ';
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text.empty() ? std::string("unknown cause") : text;
}

/* Runs `body`, which returns bool, and turns any exception into an error about `name`. */
template <class Body>
bool guarded(const char *name, struct irb_error *err, Body body)
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
    } catch (const std::exception &e) {
        return irb_fail(err, IRB_E_INPUT, "%s: %s", name, one_line(e.what()).c_str());
    } catch (...) {
        return irb_fail(err, IRB_E_INTERNAL, "%s: unknown failure in OpenImageIO", name);
    }
}

std::vector<unsigned char> quantise(const struct irb_image &image)
{
    std::vector<unsigned char> bytes(irb_image_pixels(&image) * (size_t)image.channels);
    for (size_t i = 0; i < bytes.size(); i++) {
        float v = image.data[i];
        /* The negated test takes NaN to 0. */
        bytes[i] = !(v > 0) ? 0 : v >= 1 ? 255 : (unsigned char)std::lrintf(255 * v);
    }
    return bytes;
}

/* An 8-bit file of `format` in memory; `settings` are the format's own. */
bool encode(const char *format, const OIIO::ParamValueList &settings, const struct irb_image &image,
            std::vector<unsigned char> &file, std::string &cause)
{
    OIIO::Filesystem::IOVecOutput sink(file);
    OIIO::Filesystem::IOProxy *proxy = &sink;
    auto out = OIIO::ImageOutput::create(format, proxy);
    if (!out) {
        cause = OIIO::geterror();
        return false;
    }
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    for (const OIIO::ParamValue &setting : settings)
        spec.extra_attribs.add_or_replace(setting);
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    std::vector<unsigned char> bytes = quantise(image);
    bool ok = out->open(format, spec) && out->write_image(OIIO::TypeUInt8, bytes.data());
    if (!ok)
        cause = out->geterror();
    if (!out->close() && ok) {
        cause = out->geterror();
        ok = false;
    }
    return ok;
}

/* Encodes in memory, so that a full disk is met by irb_fs_write, which can say so. */
bool write_file(const char *path, const char *format, const OIIO::ParamValueList &settings,
                const struct irb_image &image, struct irb_error *err)
{
    if (image.channels != 1 && image.channels != 3)
        return irb_fail(err, IRB_E_INTERNAL, "%s: a %s file takes 1 or 3 channels, found %d", path,
                        format, image.channels);
    std::vector<unsigned char> file;
    std::string cause;
    if (!encode(format, settings, image, file, cause))
        return irb_fail(err, IRB_E_IO, "%s: cannot write: %s", path, one_line(cause).c_str());
    return irb_fs_write(path, file.data(), file.size(), err);
}

bool encode_png(const char *name, const unsigned char *rgba, int width, int height,
                std::vector<unsigned char> &file, struct irb_error *err)
{
    size_t pixels = (size_t)width * (size_t)height;
    bool opaque = true;
    for (size_t i = 0; i < pixels; i++)
        opaque = opaque && rgba[4 * i + 3] == 255;
    OIIO::Filesystem::IOVecOutput sink(file);
    OIIO::Filesystem::IOProxy *proxy = &sink;
    auto out = OIIO::ImageOutput::create("png", proxy);
    if (!out)
        return irb_fail(err, IRB_E_INTERNAL, "%s: %s", name, one_line(OIIO::geterror()).c_str());
    OIIO::ImageSpec spec(width, height, opaque ? 3 : 4, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1); /* as stored, not premultiplied */
    spec.attribute("png:compressionLevel", 5);
    spec.attribute("DateTime", "2000:01:01 00:00:00");
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (!out->open(name, spec) || !out->write_image(OIIO::TypeUInt8, rgba, 4) || !out->close())
        return irb_fail(err, IRB_E_INTERNAL, "%s: cannot encode as PNG: %s", name,
                        one_line(out->geterror()).c_str());
    return true;
}

/* A name with the ending that belongs to the content: OpenImageIO picks the reader by it. */
std::string name_by_content(const char *name, const unsigned char *data, size_t size)
{
    if (size >= 8 && !std::memcmp(data, "\x89PNG\r\n\x1a\n", 8))
        return "image.png";
    if (size >= 3 && !std::memcmp(data, "\xff\xd8\xff", 3))
        return "image.jpg";
    if (size >= 12 && !std::memcmp(data, "RIFF", 4) && !std::memcmp(data + 8, "WEBP", 4))
        return "image.webp";
    return name;
}

bool check_size(const char *name, const OIIO::ImageSpec &spec, struct irb_error *err)
{
    if (spec.width > 0 && spec.height > 0 && spec.width <= max_side && spec.height <= max_side &&
        (long long)spec.width * spec.height <= max_pixels && spec.depth <= 1 && spec.nchannels > 0)
        return true;
    return irb_fail(err, IRB_E_INPUT, "%s: expected at most %d x %d pixels, found %d x %d", name,
                    max_side, max_side, spec.width, spec.height);
}

void expand_to_rgba(const unsigned char *in, int channels, size_t pixels, unsigned char *out)
{
    for (size_t i = 0; i < pixels; i++, in += channels, out += 4) {
        bool grey = channels < 3;
        out[0] = in[0];
        out[1] = grey ? in[0] : in[1];
        out[2] = grey ? in[0] : in[2];
        out[3] = channels == 2 ? in[1] : channels >= 4 ? in[3] : 255;
    }
}

bool decode(const char *name, const void *data, size_t size, int *width, int *height,
            unsigned char **rgba, struct irb_error *err)
{
    OIIO::Filesystem::IOMemReader reader(const_cast<void *>(data), size);
    OIIO::Filesystem::IOProxy *proxy = &reader;
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1); /* as stored, not premultiplied */
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    std::string hint = name_by_content(name, static_cast<const unsigned char *>(data), size);
    auto in = OIIO::ImageInput::open(hint, &config, proxy);
    if (!in)
        return irb_fail(err, IRB_E_INPUT, "%s: cannot decode the image: %s", name,
                        one_line(OIIO::geterror()).c_str());
    const OIIO::ImageSpec &spec = in->spec();
    if (!check_size(name, spec, err))
        return false;
    size_t pixels = (size_t)spec.width * (size_t)spec.height;
    std::vector<unsigned char> bytes(pixels * (size_t)spec.nchannels);
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt8, bytes.data()))
        return irb_fail(err, IRB_E_INPUT, "%s: cannot decode the image: %s", name,
                        one_line(in->geterror()).c_str());
    auto *out = static_cast<unsigned char *>(std::malloc(pixels * 4));
    if (!out)
        return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
    expand_to_rgba(bytes.data(), spec.nchannels, pixels, out);
    *width = spec.width;
    *height = spec.height;
    *rgba = out;
    return true;
}

/* IEC 61966-2-1. */
float srgb_to_linear(float v)
{
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/* Where R, G and B are: by name where all three exist, else the first channels. */
void find_rgb(const OIIO::ImageSpec &spec, int index[3])
{
    const char *names[3] = {"R", "G", "B"};
    bool named = true;
    for (int c = 0; c < 3; c++) {
        index[c] = spec.channelindex(names[c]);
        named = named && index[c] >= 0;
    }
    for (int c = 0; c < 3 && !named; c++)
        index[c] = spec.nchannels >= 3 ? c : 0;
}

bool read_rgb(const char *path, struct irb_image *image, struct irb_error *err)
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    auto in = OIIO::ImageInput::open(path, &config);
    if (!in)
        return irb_fail(err, IRB_E_INPUT, "%s: cannot read the image: %s", path,
                        one_line(OIIO::geterror()).c_str());
    const OIIO::ImageSpec &spec = in->spec();
    if (!check_size(path, spec, err))
        return false;
    size_t pixels = (size_t)spec.width * (size_t)spec.height;
    std::vector<float> values(pixels * (size_t)spec.nchannels);
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, values.data()))
        return irb_fail(err, IRB_E_INPUT, "%s: cannot read the image: %s", path,
                        one_line(in->geterror()).c_str());
    bool srgb = spec.get_string_attribute("oiio:ColorSpace") == "sRGB";
    int index[3];
    find_rgb(spec, index);
    if (!irb_image_create(image, spec.width, spec.height, 3, err))
        return irb_error_prefix(err, "%s", path);
    for (size_t i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++) {
            float v = values[i * (size_t)spec.nchannels + (size_t)index[c]];
            image->data[3 * i + (size_t)c] = srgb ? srgb_to_linear(v) : v;
        }
    return true;
}

} // namespace

bool irb_png_write(const char *path, const struct irb_image *image, struct irb_error *err)
{
    return guarded(path, err, [&] {
        OIIO::ParamValueList settings;
        settings.attribute("png:compressionLevel", 5);
        /* Without this, the time of writing goes into the file and no two files are equal. */
        settings.attribute("DateTime", "2000:01:01 00:00:00");
        return write_file(path, "png", settings, *image, err);
    });
}

bool irb_jpeg_write(const char *path, const struct irb_image *image, int quality,
                    struct irb_error *err)
{
    return guarded(path, err, [&] {
        OIIO::ParamValueList settings;
        settings.attribute("Compression", "jpeg:" + std::to_string(quality));
        settings.attribute("jpeg:subsampling", "4:4:4");
        return write_file(path, "jpeg", settings, *image, err);
    });
}

bool irb_png_encode(const char *name, const unsigned char *rgba, int width, int height,
                    unsigned char **data, size_t *size, struct irb_error *err)
{
    return guarded(name, err, [&] {
        std::vector<unsigned char> file;
        if (!encode_png(name, rgba, width, height, file, err))
            return false;
        *data = static_cast<unsigned char *>(std::malloc(file.size()));
        if (!*data)
            return irb_fail(err, IRB_E_MEMORY, "%s: out of memory", name);
        std::memcpy(*data, file.data(), file.size());
        *size = file.size();
        return true;
    });
}

bool irb_image_decode(const char *name, const void *data, size_t size, int *width, int *height,
                      unsigned char **rgba, struct irb_error *err)
{
    return guarded(name, err, [&] { return decode(name, data, size, width, height, rgba, err); });
}

bool irb_image_read_rgb(const char *path, struct irb_image *image, struct irb_error *err)
{
    *image = irb_image{};
    if (!irb_fs_exists(path))
        return irb_fail(err, IRB_E_INPUT, "%s: no such file", path);
    return guarded(path, err, [&] { return read_rgb(path, image, err); });
}
