/* SPDX-License-Identifier: MIT
 *
 * The OpenGL 4.5 core entry points that irbench may call: one table, from which the struct and the
 * loader are made. Core 4.5 functions only, no extensions, so that every backend gives every one;
 * a new call needs a line here. Types and enumerants are those of <GL/glcorearb.h>.
 */
#ifndef IRB_GL_API_H
#define IRB_GL_API_H

#include "core/base/error.h"

#include <GL/glcorearb.h>

/* type, name without the gl prefix */
/* clang-format off */
#define IRB_GL_FUNCTIONS(X)                                                                        \
    /* State */                                                                                    \
    X(PFNGLENABLEPROC, Enable)                                                                     \
    X(PFNGLDISABLEPROC, Disable)                                                                   \
    X(PFNGLISENABLEDPROC, IsEnabled)                                                               \
    X(PFNGLENABLEIPROC, Enablei)                                                                   \
    X(PFNGLDISABLEIPROC, Disablei)                                                                 \
    X(PFNGLGETERRORPROC, GetError)                                                                 \
    X(PFNGLGETSTRINGPROC, GetString)                                                               \
    X(PFNGLGETSTRINGIPROC, GetStringi)                                                             \
    X(PFNGLGETBOOLEANVPROC, GetBooleanv)                                                           \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                           \
    X(PFNGLGETINTEGER64VPROC, GetInteger64v)                                                       \
    X(PFNGLGETFLOATVPROC, GetFloatv)                                                               \
    X(PFNGLGETINTEGERI_VPROC, GetIntegeri_v)                                                       \
    X(PFNGLFINISHPROC, Finish)                                                                     \
    X(PFNGLFLUSHPROC, Flush)                                                                       \
    X(PFNGLHINTPROC, Hint)                                                                         \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                           \
    /* Rasteriser and framebuffer operations */                                                    \
    X(PFNGLVIEWPORTPROC, Viewport)                                                                 \
    X(PFNGLVIEWPORTINDEXEDFPROC, ViewportIndexedf)                                                 \
    X(PFNGLVIEWPORTARRAYVPROC, ViewportArrayv)                                                     \
    X(PFNGLSCISSORPROC, Scissor)                                                                   \
    X(PFNGLSCISSORINDEXEDPROC, ScissorIndexed)                                                     \
    X(PFNGLDEPTHRANGEPROC, DepthRange)                                                             \
    X(PFNGLDEPTHRANGEFPROC, DepthRangef)                                                           \
    X(PFNGLDEPTHRANGEINDEXEDPROC, DepthRangeIndexed)                                               \
    X(PFNGLCLIPCONTROLPROC, ClipControl)                                                           \
    X(PFNGLCULLFACEPROC, CullFace)                                                                 \
    X(PFNGLFRONTFACEPROC, FrontFace)                                                               \
    X(PFNGLPOLYGONMODEPROC, PolygonMode)                                                           \
    X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                                                       \
    X(PFNGLPOINTSIZEPROC, PointSize)                                                               \
    X(PFNGLLINEWIDTHPROC, LineWidth)                                                               \
    X(PFNGLPOINTPARAMETERIPROC, PointParameteri)                                                   \
    X(PFNGLDEPTHFUNCPROC, DepthFunc)                                                               \
    X(PFNGLDEPTHMASKPROC, DepthMask)                                                               \
    X(PFNGLCOLORMASKPROC, ColorMask)                                                               \
    X(PFNGLCOLORMASKIPROC, ColorMaski)                                                             \
    X(PFNGLSTENCILFUNCPROC, StencilFunc)                                                           \
    X(PFNGLSTENCILFUNCSEPARATEPROC, StencilFuncSeparate)                                           \
    X(PFNGLSTENCILMASKPROC, StencilMask)                                                           \
    X(PFNGLSTENCILOPPROC, StencilOp)                                                               \
    X(PFNGLSTENCILOPSEPARATEPROC, StencilOpSeparate)                                               \
    X(PFNGLBLENDFUNCPROC, BlendFunc)                                                               \
    X(PFNGLBLENDFUNCIPROC, BlendFunci)                                                             \
    X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                               \
    X(PFNGLBLENDFUNCSEPARATEIPROC, BlendFuncSeparatei)                                             \
    X(PFNGLBLENDEQUATIONPROC, BlendEquation)                                                       \
    X(PFNGLBLENDEQUATIONIPROC, BlendEquationi)                                                     \
    X(PFNGLBLENDEQUATIONSEPARATEPROC, BlendEquationSeparate)                                       \
    X(PFNGLBLENDCOLORPROC, BlendColor)                                                             \
    X(PFNGLLOGICOPPROC, LogicOp)                                                                   \
    X(PFNGLSAMPLEMASKIPROC, SampleMaski)                                                           \
    X(PFNGLMINSAMPLESHADINGPROC, MinSampleShading)                                                 \
    X(PFNGLPROVOKINGVERTEXPROC, ProvokingVertex)                                                   \
    X(PFNGLPRIMITIVERESTARTINDEXPROC, PrimitiveRestartIndex)                                       \
    X(PFNGLCLEARPROC, Clear)                                                                       \
    X(PFNGLCLEARCOLORPROC, ClearColor)                                                             \
    X(PFNGLCLEARDEPTHPROC, ClearDepth)                                                             \
    X(PFNGLCLEARDEPTHFPROC, ClearDepthf)                                                           \
    X(PFNGLCLEARSTENCILPROC, ClearStencil)                                                         \
    X(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                                                       \
    X(PFNGLCLEARBUFFERIVPROC, ClearBufferiv)                                                       \
    X(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                                                     \
    X(PFNGLCLEARBUFFERFIPROC, ClearBufferfi)                                                       \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                                             \
    X(PFNGLREADBUFFERPROC, ReadBuffer)                                                             \
    X(PFNGLDRAWBUFFERPROC, DrawBuffer)                                                             \
    X(PFNGLDRAWBUFFERSPROC, DrawBuffers)                                                           \
    /* Framebuffers */                                                                             \
    X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                                             \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                             \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                   \
    X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)                                   \
    X(PFNGLNAMEDFRAMEBUFFERTEXTURELAYERPROC, NamedFramebufferTextureLayer)                         \
    X(PFNGLNAMEDFRAMEBUFFERRENDERBUFFERPROC, NamedFramebufferRenderbuffer)                         \
    X(PFNGLNAMEDFRAMEBUFFERPARAMETERIPROC, NamedFramebufferParameteri)                             \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC, NamedFramebufferDrawBuffer)                             \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers)                           \
    X(PFNGLNAMEDFRAMEBUFFERREADBUFFERPROC, NamedFramebufferReadBuffer)                             \
    X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)                           \
    X(PFNGLBLITNAMEDFRAMEBUFFERPROC, BlitNamedFramebuffer)                                         \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)                                   \
    X(PFNGLCLEARNAMEDFRAMEBUFFERIVPROC, ClearNamedFramebufferiv)                                   \
    X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)                                 \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFIPROC, ClearNamedFramebufferfi)                                   \
    X(PFNGLINVALIDATENAMEDFRAMEBUFFERDATAPROC, InvalidateNamedFramebufferData)                     \
    X(PFNGLCREATERENDERBUFFERSPROC, CreateRenderbuffers)                                           \
    X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                           \
    X(PFNGLNAMEDRENDERBUFFERSTORAGEPROC, NamedRenderbufferStorage)                                 \
    X(PFNGLNAMEDRENDERBUFFERSTORAGEMULTISAMPLEPROC, NamedRenderbufferStorageMultisample)           \
    /* Textures */                                                                                 \
    X(PFNGLCREATETEXTURESPROC, CreateTextures)                                                     \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                     \
    X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                       \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                                           \
    X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                                                   \
    X(PFNGLBINDTEXTURESPROC, BindTextures)                                                         \
    X(PFNGLBINDIMAGETEXTUREPROC, BindImageTexture)                                                 \
    X(PFNGLBINDIMAGETEXTURESPROC, BindImageTextures)                                               \
    X(PFNGLTEXTURESTORAGE1DPROC, TextureStorage1D)                                                 \
    X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                                                 \
    X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                                                 \
    X(PFNGLTEXTURESTORAGE2DMULTISAMPLEPROC, TextureStorage2DMultisample)                           \
    X(PFNGLTEXTURESUBIMAGE1DPROC, TextureSubImage1D)                                               \
    X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                                               \
    X(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)                                               \
    X(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                                               \
    X(PFNGLTEXTUREPARAMETERFPROC, TextureParameterf)                                               \
    X(PFNGLTEXTUREPARAMETERIVPROC, TextureParameteriv)                                             \
    X(PFNGLTEXTUREPARAMETERFVPROC, TextureParameterfv)                                             \
    X(PFNGLTEXTUREBUFFERPROC, TextureBuffer)                                                       \
    X(PFNGLTEXTUREBUFFERRANGEPROC, TextureBufferRange)                                             \
    X(PFNGLTEXTUREVIEWPROC, TextureView)                                                           \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                                           \
    X(PFNGLGENERATETEXTUREMIPMAPPROC, GenerateTextureMipmap)                                       \
    X(PFNGLCOPYIMAGESUBDATAPROC, CopyImageSubData)                                                 \
    X(PFNGLCLEARTEXIMAGEPROC, ClearTexImage)                                                       \
    X(PFNGLCLEARTEXSUBIMAGEPROC, ClearTexSubImage)                                                 \
    X(PFNGLGETTEXTUREIMAGEPROC, GetTextureImage)                                                   \
    X(PFNGLGETTEXTURESUBIMAGEPROC, GetTextureSubImage)                                             \
    X(PFNGLGETTEXTURELEVELPARAMETERIVPROC, GetTextureLevelParameteriv)                             \
    X(PFNGLGETTEXTUREPARAMETERIVPROC, GetTextureParameteriv)                                       \
    X(PFNGLGETINTERNALFORMATIVPROC, GetInternalformativ)                                           \
    X(PFNGLGETINTERNALFORMATI64VPROC, GetInternalformati64v)                                       \
    X(PFNGLCREATESAMPLERSPROC, CreateSamplers)                                                     \
    X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                                                     \
    X(PFNGLBINDSAMPLERPROC, BindSampler)                                                           \
    X(PFNGLBINDSAMPLERSPROC, BindSamplers)                                                         \
    X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)                                               \
    X(PFNGLSAMPLERPARAMETERFPROC, SamplerParameterf)                                               \
    X(PFNGLSAMPLERPARAMETERFVPROC, SamplerParameterfv)                                             \
    /* Buffers */                                                                                  \
    X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                                                       \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                       \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                                             \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                     \
    X(PFNGLBINDBUFFERRANGEPROC, BindBufferRange)                                                   \
    X(PFNGLBINDBUFFERSBASEPROC, BindBuffersBase)                                                   \
    X(PFNGLBINDBUFFERSRANGEPROC, BindBuffersRange)                                                 \
    X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                                             \
    X(PFNGLNAMEDBUFFERDATAPROC, NamedBufferData)                                                   \
    X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                                             \
    X(PFNGLCLEARNAMEDBUFFERDATAPROC, ClearNamedBufferData)                                         \
    X(PFNGLCLEARNAMEDBUFFERSUBDATAPROC, ClearNamedBufferSubData)                                   \
    X(PFNGLCOPYNAMEDBUFFERSUBDATAPROC, CopyNamedBufferSubData)                                     \
    X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)                                       \
    X(PFNGLGETNAMEDBUFFERPARAMETERIVPROC, GetNamedBufferParameteriv)                               \
    X(PFNGLGETNAMEDBUFFERPARAMETERI64VPROC, GetNamedBufferParameteri64v)                           \
    X(PFNGLMAPNAMEDBUFFERPROC, MapNamedBuffer)                                                     \
    X(PFNGLMAPNAMEDBUFFERRANGEPROC, MapNamedBufferRange)                                           \
    X(PFNGLUNMAPNAMEDBUFFERPROC, UnmapNamedBuffer)                                                 \
    X(PFNGLFLUSHMAPPEDNAMEDBUFFERRANGEPROC, FlushMappedNamedBufferRange)                           \
    X(PFNGLINVALIDATEBUFFERDATAPROC, InvalidateBufferData)                                         \
    X(PFNGLINVALIDATEBUFFERSUBDATAPROC, InvalidateBufferSubData)                                   \
    /* Vertex arrays */                                                                            \
    X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                                             \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                             \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                   \
    X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib)                                   \
    X(PFNGLDISABLEVERTEXARRAYATTRIBPROC, DisableVertexArrayAttrib)                                 \
    X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer)                                   \
    X(PFNGLVERTEXARRAYVERTEXBUFFERSPROC, VertexArrayVertexBuffers)                                 \
    X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer)                                 \
    X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat)                                   \
    X(PFNGLVERTEXARRAYATTRIBIFORMATPROC, VertexArrayAttribIFormat)                                 \
    X(PFNGLVERTEXARRAYATTRIBLFORMATPROC, VertexArrayAttribLFormat)                                 \
    X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding)                                 \
    X(PFNGLVERTEXARRAYBINDINGDIVISORPROC, VertexArrayBindingDivisor)                               \
    X(PFNGLVERTEXATTRIB1FPROC, VertexAttrib1f)                                                     \
    X(PFNGLVERTEXATTRIB4FPROC, VertexAttrib4f)                                                     \
    X(PFNGLVERTEXATTRIB4FVPROC, VertexAttrib4fv)                                                   \
    X(PFNGLVERTEXATTRIBI4UIPROC, VertexAttribI4ui)                                                 \
    /* Draws and dispatches */                                                                     \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                             \
    X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                                           \
    X(PFNGLDRAWARRAYSINSTANCEDBASEINSTANCEPROC, DrawArraysInstancedBaseInstance)                   \
    X(PFNGLDRAWARRAYSINDIRECTPROC, DrawArraysIndirect)                                             \
    X(PFNGLMULTIDRAWARRAYSPROC, MultiDrawArrays)                                                   \
    X(PFNGLMULTIDRAWARRAYSINDIRECTPROC, MultiDrawArraysIndirect)                                   \
    X(PFNGLDRAWELEMENTSPROC, DrawElements)                                                         \
    X(PFNGLDRAWELEMENTSBASEVERTEXPROC, DrawElementsBaseVertex)                                     \
    X(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)                                       \
    X(PFNGLDRAWELEMENTSINSTANCEDBASEINSTANCEPROC, DrawElementsInstancedBaseInstance)               \
    X(PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXPROC, DrawElementsInstancedBaseVertex)                   \
    X(PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCEPROC,                                        \
      DrawElementsInstancedBaseVertexBaseInstance)                                                 \
    X(PFNGLDRAWELEMENTSINDIRECTPROC, DrawElementsIndirect)                                         \
    X(PFNGLDRAWRANGEELEMENTSPROC, DrawRangeElements)                                               \
    X(PFNGLMULTIDRAWELEMENTSPROC, MultiDrawElements)                                               \
    X(PFNGLMULTIDRAWELEMENTSBASEVERTEXPROC, MultiDrawElementsBaseVertex)                           \
    X(PFNGLMULTIDRAWELEMENTSINDIRECTPROC, MultiDrawElementsIndirect)                               \
    X(PFNGLPATCHPARAMETERIPROC, PatchParameteri)                                                   \
    X(PFNGLPATCHPARAMETERFVPROC, PatchParameterfv)                                                 \
    X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                                                   \
    X(PFNGLDISPATCHCOMPUTEINDIRECTPROC, DispatchComputeIndirect)                                   \
    X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                                                       \
    X(PFNGLMEMORYBARRIERBYREGIONPROC, MemoryBarrierByRegion)                                       \
    X(PFNGLTEXTUREBARRIERPROC, TextureBarrier)                                                     \
    X(PFNGLBEGINCONDITIONALRENDERPROC, BeginConditionalRender)                                     \
    X(PFNGLENDCONDITIONALRENDERPROC, EndConditionalRender)                                         \
    X(PFNGLCREATETRANSFORMFEEDBACKSPROC, CreateTransformFeedbacks)                                 \
    X(PFNGLDELETETRANSFORMFEEDBACKSPROC, DeleteTransformFeedbacks)                                 \
    X(PFNGLBINDTRANSFORMFEEDBACKPROC, BindTransformFeedback)                                       \
    X(PFNGLTRANSFORMFEEDBACKBUFFERBASEPROC, TransformFeedbackBufferBase)                           \
    X(PFNGLTRANSFORMFEEDBACKBUFFERRANGEPROC, TransformFeedbackBufferRange)                         \
    X(PFNGLTRANSFORMFEEDBACKVARYINGSPROC, TransformFeedbackVaryings)                               \
    X(PFNGLBEGINTRANSFORMFEEDBACKPROC, BeginTransformFeedback)                                     \
    X(PFNGLENDTRANSFORMFEEDBACKPROC, EndTransformFeedback)                                         \
    /* Shaders and programs */                                                                     \
    X(PFNGLCREATESHADERPROC, CreateShader)                                                         \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                                         \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                         \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                                       \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                           \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                 \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                       \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                       \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                                         \
    X(PFNGLDETACHSHADERPROC, DetachShader)                                                         \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                           \
    X(PFNGLVALIDATEPROGRAMPROC, ValidateProgram)                                                   \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                             \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                         \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                               \
    X(PFNGLPROGRAMPARAMETERIPROC, ProgramParameteri)                                               \
    X(PFNGLGETPROGRAMBINARYPROC, GetProgramBinary)                                                 \
    X(PFNGLPROGRAMBINARYPROC, ProgramBinary)                                                       \
    X(PFNGLBINDATTRIBLOCATIONPROC, BindAttribLocation)                                             \
    X(PFNGLBINDFRAGDATALOCATIONPROC, BindFragDataLocation)                                         \
    X(PFNGLGETATTRIBLOCATIONPROC, GetAttribLocation)                                               \
    X(PFNGLGETFRAGDATALOCATIONPROC, GetFragDataLocation)                                           \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                             \
    X(PFNGLGETUNIFORMBLOCKINDEXPROC, GetUniformBlockIndex)                                         \
    X(PFNGLUNIFORMBLOCKBINDINGPROC, UniformBlockBinding)                                           \
    X(PFNGLSHADERSTORAGEBLOCKBINDINGPROC, ShaderStorageBlockBinding)                               \
    X(PFNGLGETACTIVEUNIFORMPROC, GetActiveUniform)                                                 \
    X(PFNGLGETACTIVEUNIFORMBLOCKIVPROC, GetActiveUniformBlockiv)                                   \
    X(PFNGLGETACTIVEUNIFORMSIVPROC, GetActiveUniformsiv)                                           \
    X(PFNGLGETPROGRAMINTERFACEIVPROC, GetProgramInterfaceiv)                                       \
    X(PFNGLGETPROGRAMRESOURCEINDEXPROC, GetProgramResourceIndex)                                   \
    X(PFNGLGETPROGRAMRESOURCELOCATIONPROC, GetProgramResourceLocation)                             \
    X(PFNGLGETPROGRAMRESOURCENAMEPROC, GetProgramResourceName)                                     \
    X(PFNGLGETPROGRAMRESOURCEIVPROC, GetProgramResourceiv)                                         \
    X(PFNGLGETPROGRAMSTAGEIVPROC, GetProgramStageiv)                                               \
    X(PFNGLUNIFORMSUBROUTINESUIVPROC, UniformSubroutinesuiv)                                       \
    X(PFNGLGETSUBROUTINEINDEXPROC, GetSubroutineIndex)                                             \
    /* Uniforms */                                                                                 \
    X(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                                                 \
    X(PFNGLPROGRAMUNIFORM2IPROC, ProgramUniform2i)                                                 \
    X(PFNGLPROGRAMUNIFORM3IPROC, ProgramUniform3i)                                                 \
    X(PFNGLPROGRAMUNIFORM4IPROC, ProgramUniform4i)                                                 \
    X(PFNGLPROGRAMUNIFORM1UIPROC, ProgramUniform1ui)                                               \
    X(PFNGLPROGRAMUNIFORM2UIPROC, ProgramUniform2ui)                                               \
    X(PFNGLPROGRAMUNIFORM3UIPROC, ProgramUniform3ui)                                               \
    X(PFNGLPROGRAMUNIFORM4UIPROC, ProgramUniform4ui)                                               \
    X(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                                                 \
    X(PFNGLPROGRAMUNIFORM2FPROC, ProgramUniform2f)                                                 \
    X(PFNGLPROGRAMUNIFORM3FPROC, ProgramUniform3f)                                                 \
    X(PFNGLPROGRAMUNIFORM4FPROC, ProgramUniform4f)                                                 \
    X(PFNGLPROGRAMUNIFORM1IVPROC, ProgramUniform1iv)                                               \
    X(PFNGLPROGRAMUNIFORM2IVPROC, ProgramUniform2iv)                                               \
    X(PFNGLPROGRAMUNIFORM3IVPROC, ProgramUniform3iv)                                               \
    X(PFNGLPROGRAMUNIFORM4IVPROC, ProgramUniform4iv)                                               \
    X(PFNGLPROGRAMUNIFORM1UIVPROC, ProgramUniform1uiv)                                             \
    X(PFNGLPROGRAMUNIFORM2UIVPROC, ProgramUniform2uiv)                                             \
    X(PFNGLPROGRAMUNIFORM3UIVPROC, ProgramUniform3uiv)                                             \
    X(PFNGLPROGRAMUNIFORM4UIVPROC, ProgramUniform4uiv)                                             \
    X(PFNGLPROGRAMUNIFORM1FVPROC, ProgramUniform1fv)                                               \
    X(PFNGLPROGRAMUNIFORM2FVPROC, ProgramUniform2fv)                                               \
    X(PFNGLPROGRAMUNIFORM3FVPROC, ProgramUniform3fv)                                               \
    X(PFNGLPROGRAMUNIFORM4FVPROC, ProgramUniform4fv)                                               \
    X(PFNGLPROGRAMUNIFORMMATRIX2FVPROC, ProgramUniformMatrix2fv)                                   \
    X(PFNGLPROGRAMUNIFORMMATRIX3FVPROC, ProgramUniformMatrix3fv)                                   \
    X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)                                   \
    X(PFNGLPROGRAMUNIFORMMATRIX3X4FVPROC, ProgramUniformMatrix3x4fv)                               \
    X(PFNGLPROGRAMUNIFORMMATRIX4X3FVPROC, ProgramUniformMatrix4x3fv)                               \
    X(PFNGLGETUNIFORMFVPROC, GetUniformfv)                                                         \
    X(PFNGLGETUNIFORMIVPROC, GetUniformiv)                                                         \
    /* Queries, fences, debug output */                                                            \
    X(PFNGLCREATEQUERIESPROC, CreateQueries)                                                       \
    X(PFNGLDELETEQUERIESPROC, DeleteQueries)                                                       \
    X(PFNGLBEGINQUERYPROC, BeginQuery)                                                             \
    X(PFNGLENDQUERYPROC, EndQuery)                                                                 \
    X(PFNGLBEGINQUERYINDEXEDPROC, BeginQueryIndexed)                                               \
    X(PFNGLENDQUERYINDEXEDPROC, EndQueryIndexed)                                                   \
    X(PFNGLQUERYCOUNTERPROC, QueryCounter)                                                         \
    X(PFNGLGETQUERYIVPROC, GetQueryiv)                                                             \
    X(PFNGLGETQUERYOBJECTIVPROC, GetQueryObjectiv)                                                 \
    X(PFNGLGETQUERYOBJECTUIVPROC, GetQueryObjectuiv)                                               \
    X(PFNGLGETQUERYOBJECTI64VPROC, GetQueryObjecti64v)                                             \
    X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                                           \
    X(PFNGLFENCESYNCPROC, FenceSync)                                                               \
    X(PFNGLDELETESYNCPROC, DeleteSync)                                                             \
    X(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                                                     \
    X(PFNGLWAITSYNCPROC, WaitSync)                                                                 \
    X(PFNGLGETSYNCIVPROC, GetSynciv)                                                               \
    X(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)                                         \
    X(PFNGLDEBUGMESSAGECONTROLPROC, DebugMessageControl)                                           \
    X(PFNGLDEBUGMESSAGEINSERTPROC, DebugMessageInsert)                                             \
    X(PFNGLOBJECTLABELPROC, ObjectLabel)                                                           \
    X(PFNGLGETOBJECTLABELPROC, GetObjectLabel)                                                     \
    X(PFNGLPUSHDEBUGGROUPPROC, PushDebugGroup)                                                     \
    X(PFNGLPOPDEBUGGROUPPROC, PopDebugGroup)                                                       \
    X(PFNGLGETGRAPHICSRESETSTATUSPROC, GetGraphicsResetStatus)
/* clang-format on */

struct irb_gl_api {
#define X(type, name) type name;
    IRB_GL_FUNCTIONS(X)
#undef X
};

typedef void (*irb_gl_proc)(void);
typedef irb_gl_proc (*irb_gl_get_proc)(const char *name);

/* Fills every member through the backend's look-up. IRB_E_BACKEND names the first entry point that
 * is missing and how many are. A context must be current. */
bool irb_gl_api_load(struct irb_gl_api *api, irb_gl_get_proc get_proc, struct irb_error *err);

#endif
