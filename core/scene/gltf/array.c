/* SPDX-License-Identifier: MIT */
#include "core/scene/gltf/load.h"

#include <string.h>

bool gltf_view_bytes(const struct irb_gltf *gltf, int view, const unsigned char **data,
                     size_t *size, struct irb_error *err)
{
    const struct irb_gltf_view *v;
    size_t buffer_size;

    if (view < 0 || view >= gltf->view_count)
        return irb_fail(err, IRB_E_INPUT, "buffer view %d does not exist (the file has %d)", view,
                        gltf->view_count);
    v = &gltf->views[view];
    if (v->buffer < 0 || v->buffer >= gltf->buffer_count)
        return irb_fail(err, IRB_E_INPUT,
                        "buffer view %d: buffer %d does not exist (the file has %d)", view,
                        v->buffer, gltf->buffer_count);
    buffer_size = gltf->buffers[v->buffer].size;
    if (v->offset > buffer_size || v->length > buffer_size - v->offset)
        return irb_fail(err, IRB_E_INPUT,
                        "buffer view %d: bytes %zu + %zu lie outside buffer %d of %zu bytes", view,
                        v->offset, v->length, v->buffer, buffer_size);
    *data = gltf->buffers[v->buffer].data + v->offset;
    *size = v->length;
    return true;
}

static size_t component_size(int component)
{
    switch (component) {
    case IRB_GLTF_BYTE:
    case IRB_GLTF_UNSIGNED_BYTE:
        return 1;
    case IRB_GLTF_SHORT:
    case IRB_GLTF_UNSIGNED_SHORT:
        return 2;
    case IRB_GLTF_UNSIGNED_INT:
    case IRB_GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

static bool check_accessor(const struct irb_gltf *gltf, int index, const char *what, int components,
                           struct irb_error *err)
{
    const struct irb_gltf_accessor *accessor;

    if (index < 0 || index >= gltf->accessor_count)
        return irb_fail(err, IRB_E_INPUT, "%s: accessor %d does not exist (the file has %d)", what,
                        index, gltf->accessor_count);
    accessor = &gltf->accessors[index];
    if (accessor->sparse)
        return irb_fail(err, IRB_E_INPUT, "%s: accessor %d is sparse, which is not supported", what,
                        index);
    if (accessor->view < 0)
        return irb_fail(err, IRB_E_INPUT, "%s: accessor %d has no buffer view", what, index);
    if (accessor->components != components)
        return irb_fail(err, IRB_E_INPUT, "%s: accessor %d has %d components, expected %d", what,
                        index, accessor->components, components);
    if (component_size(accessor->component) == 0)
        return irb_fail(err, IRB_E_INPUT, "%s: accessor %d has the unknown component type %d", what,
                        index, accessor->component);
    return true;
}

bool gltf_array_open(const struct irb_gltf *gltf, int index, const char *what, int components,
                     struct gltf_array *array, struct irb_error *err)
{
    const struct irb_gltf_accessor *accessor;
    size_t size, element, stride;

    if (!check_accessor(gltf, index, what, components, err))
        return false;
    accessor = &gltf->accessors[index];
    if (!gltf_view_bytes(gltf, accessor->view, &array->data, &size, err))
        return irb_error_prefix(err, "%s: accessor %d", what, index);
    element = component_size(accessor->component) * (size_t)components;
    stride = gltf->views[accessor->view].stride;
    if (stride == 0)
        stride = element;
    if (stride < element)
        return irb_fail(err, IRB_E_INPUT,
                        "%s: accessor %d: stride %zu is below the element size %zu", what, index,
                        stride, element);
    /* offset + (count - 1) stride + element <= size, without overflow */
    if (accessor->count > 0 && (accessor->offset > size || element > size - accessor->offset ||
                                accessor->count - 1 > (size - accessor->offset - element) / stride))
        return irb_fail(err, IRB_E_INPUT,
                        "%s: accessor %d: %zu elements of %zu bytes at offset %zu lie outside "
                        "buffer view %d of %zu bytes",
                        what, index, accessor->count, stride, accessor->offset, accessor->view,
                        size);
    if (accessor->count > 0)
        array->data += accessor->offset;
    array->count = accessor->count;
    array->stride = stride;
    array->component = accessor->component;
    array->components = components;
    array->normalized = accessor->normalized;
    return true;
}

/* Little-endian, wherever it is aligned. */
static uint32_t unsigned_at(const unsigned char *p, size_t size)
{
    uint32_t value = 0;

    for (size_t i = 0; i < size; i++)
        value |= (uint32_t)p[i] << (8 * i);
    return value;
}

uint32_t gltf_array_index(const struct gltf_array *array, size_t i)
{
    return unsigned_at(array->data + i * array->stride, component_size(array->component));
}

/* glTF 2.0, 3.6.2.2: c/255, max(c/127, -1), ... */
static double normalized_value(double value, double maximum, bool normalized)
{
    if (!normalized)
        return value;
    value /= maximum;
    return value < -1 ? -1 : value;
}

double gltf_array_get(const struct gltf_array *array, size_t i, int c)
{
    size_t size = component_size(array->component);
    const unsigned char *p = array->data + i * array->stride + (size_t)c * size;
    uint32_t bits = unsigned_at(p, size);
    float value;

    switch (array->component) {
    case IRB_GLTF_BYTE:
        return normalized_value((int8_t)bits, 127, array->normalized);
    case IRB_GLTF_UNSIGNED_BYTE:
        return normalized_value(bits, 255, array->normalized);
    case IRB_GLTF_SHORT:
        return normalized_value((int16_t)bits, 32767, array->normalized);
    case IRB_GLTF_UNSIGNED_SHORT:
        return normalized_value(bits, 65535, array->normalized);
    case IRB_GLTF_UNSIGNED_INT:
        return normalized_value(bits, 4294967295.0, array->normalized);
    default:
        memcpy(&value, &bits, sizeof value);
        return value;
    }
}
