/* SPDX-License-Identifier: MIT */
#include "core/gl/format.h"

#include <GL/glcorearb.h>

#define FORMAT(name, bytes, kind)                                                                  \
    {                                                                                              \
        GL_##name, "GL_" #name, bytes, IRB_FORMAT_##kind                                           \
    }

/* OpenGL 4.5 core, tables 8.12 and 8.13 (sized internal formats) */
static const struct irb_format formats[] = {
    FORMAT(R8, 1, COLOUR),
    FORMAT(RG8, 2, COLOUR),
    FORMAT(RGBA8, 4, COLOUR),
    FORMAT(SRGB8_ALPHA8, 4, COLOUR),
    FORMAT(R16, 2, COLOUR),
    FORMAT(RG16, 4, COLOUR),
    FORMAT(RGBA16, 8, COLOUR),
    FORMAT(R8_SNORM, 1, COLOUR),
    FORMAT(RG8_SNORM, 2, COLOUR),
    FORMAT(RGBA8_SNORM, 4, COLOUR),
    FORMAT(R16_SNORM, 2, COLOUR),
    FORMAT(RG16_SNORM, 4, COLOUR),
    FORMAT(RGBA16_SNORM, 8, COLOUR),
    FORMAT(R16F, 2, COLOUR),
    FORMAT(RG16F, 4, COLOUR),
    FORMAT(RGBA16F, 8, COLOUR),
    FORMAT(R32F, 4, COLOUR),
    FORMAT(RG32F, 8, COLOUR),
    FORMAT(RGB32F, 12, COLOUR),
    FORMAT(RGBA32F, 16, COLOUR),
    FORMAT(R11F_G11F_B10F, 4, COLOUR),
    FORMAT(RGB10_A2, 4, COLOUR),
    FORMAT(RGB9_E5, 4, COLOUR),
    FORMAT(R8UI, 1, INTEGER),
    FORMAT(RG8UI, 2, INTEGER),
    FORMAT(RGBA8UI, 4, INTEGER),
    FORMAT(R8I, 1, INTEGER),
    FORMAT(RG8I, 2, INTEGER),
    FORMAT(RGBA8I, 4, INTEGER),
    FORMAT(R16UI, 2, INTEGER),
    FORMAT(RG16UI, 4, INTEGER),
    FORMAT(RGBA16UI, 8, INTEGER),
    FORMAT(R16I, 2, INTEGER),
    FORMAT(RG16I, 4, INTEGER),
    FORMAT(RGBA16I, 8, INTEGER),
    FORMAT(R32UI, 4, INTEGER),
    FORMAT(RG32UI, 8, INTEGER),
    FORMAT(RGBA32UI, 16, INTEGER),
    FORMAT(R32I, 4, INTEGER),
    FORMAT(RG32I, 8, INTEGER),
    FORMAT(RGBA32I, 16, INTEGER),
    FORMAT(RGB10_A2UI, 4, INTEGER),
    FORMAT(DEPTH_COMPONENT16, 2, DEPTH),
    FORMAT(DEPTH_COMPONENT24, 4, DEPTH),
    FORMAT(DEPTH_COMPONENT32F, 4, DEPTH),
    FORMAT(DEPTH24_STENCIL8, 4, DEPTH_STENCIL),
    FORMAT(DEPTH32F_STENCIL8, 8, DEPTH_STENCIL),
};

const struct irb_format *irb_format_find(unsigned format)
{
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (formats[i].format == format)
            return &formats[i];
    return NULL;
}
