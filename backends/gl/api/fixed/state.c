// Sets all state that a draw of fixed functions may use, so that none is left from the one before.
#include "backends/gl/api/fixed/fixed.h"

static void enable(GLenum what, bool on)
{
    if (on)
        glEnable(what);
    else
        glDisable(what);
}

GLenum gl_fixed_compare(int compare)
{
    static const GLenum all[] = {GL_ALWAYS, GL_LESS, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_ALWAYS};
    return all[compare];
}

static void set_blend(const struct rg_fixed_state *state)
{
    static const GLenum equations[RG_FIXED_EQUATIONS] = {GL_FUNC_ADD, GL_FUNC_SUBTRACT,
                                                         GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
    static const GLenum factors[][2] = {
        [RG_FIXED_BLEND_OFF] = {GL_ONE, GL_ZERO},
        [RG_FIXED_BLEND_OVER] = {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA},
        [RG_FIXED_BLEND_EQUATIONS] = {GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA},
        [RG_FIXED_BLEND_SRC1_COLOUR] = {GL_SRC1_COLOR, GL_ONE_MINUS_SRC1_COLOR},
        [RG_FIXED_BLEND_SRC1_ALPHA] = {GL_SRC1_ALPHA, GL_ONE_MINUS_SRC1_ALPHA}};
    const GLenum *factor = factors[state->blend];
    const int off = state->write_off;
    enable(GL_BLEND, state->blend);
    for (GLuint i = 0; i <= (GLuint)state->more_targets; i++) {
        glBlendFunci(i, factor[0], factor[1]);
        glBlendEquationi(i, equations[state->blend == RG_FIXED_BLEND_EQUATIONS ? i : 0]);
    }
    glColorMask(!(off & 1), !(off & 2), !(off & 4), !(off & 8));
}

static void set_depth(const struct rg_fixed_state *state)
{
    static const GLenum operations[] = {GL_KEEP, GL_INCR_WRAP, GL_DECR_WRAP, GL_INVERT};
    enable(GL_DEPTH_TEST, state->depth_test);
    glDepthFunc(gl_fixed_compare(state->depth_test));
    enable(GL_STENCIL_TEST, state->stencil_front || state->stencil_back);
    glStencilFunc(GL_ALWAYS, 0, 0xff);
    glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, operations[state->stencil_front]);
    glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, operations[state->stencil_back]);
    enable(GL_POLYGON_OFFSET_FILL, state->offset_units || state->offset_slope_16);
    glPolygonOffset((float)state->offset_slope_16 / 16, (float)state->offset_units);
    enable(GL_DEPTH_CLAMP, state->depth_clamp);
}

static void set_places(const struct rg_fixed_state *state)
{
    int box[4];
    for (int i = 0; i < RG_FIXED_LAYERS; i++) {
        rg_fixed_viewport(state, i, box);
        glViewportIndexedf((GLuint)i, (float)box[0], (float)box[1], (float)box[2], (float)box[3]);
        rg_fixed_scissor(state, i, box);
        glScissorIndexedv((GLuint)i, box);
    }
    enable(GL_SCISSOR_TEST, state->scissor);
}

void gl_fixed_state(const struct rg_fixed_state *state)
{
    set_blend(state);
    set_depth(state);
    set_places(state);
    enable(GL_CULL_FACE, state->cull);
    glCullFace(state->cull == RG_FIXED_CULL_FRONT ? GL_FRONT : GL_BACK);
    glProvokingVertex(state->provokes_last ? GL_LAST_VERTEX_CONVENTION
                                           : GL_FIRST_VERTEX_CONVENTION);
    enable(GL_CLIP_DISTANCE0, state->vertex == RG_FIXED_VERTEX_CLIPPED);
    enable(GL_SAMPLE_ALPHA_TO_COVERAGE, state->alpha_to_coverage);
    enable(GL_SAMPLE_MASK, state->samples_off);
    glSampleMaski(0, ~(GLbitfield)state->samples_off);
    enable(GL_PRIMITIVE_RESTART_FIXED_INDEX, state->indexed);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); // as in Vulkan
    glPatchParameteri(GL_PATCH_VERTICES, 3);
}
