#include "backends/gl/gl.h"

#include <string.h>

#include "kernels/dialect/draw/clip.h"

// Row 0 in memory is the target's top row: clip control and viewport flip nothing.
bool gl_draw_begin(struct gl_device *device)
{
    glCreateVertexArrays(1, &device->no_vertices);
    glBindVertexArray(device->no_vertices);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_DITHER);
    glEnable(GL_SCISSOR_TEST);
    glDepthFunc(GL_LESS);
    return gl_check(device, "glClipControl", "device", device->pub.info.name);
}

void gl_draw_end(struct gl_device *device)
{
    gl_framebuffers_forget(device, 0);
    gl_queries_end(device);
    glDeleteVertexArrays(1, &device->no_vertices);
}

static void set_blend(enum rg_blend blend)
{
    if (blend == RG_BLEND_OFF) {
        glDisable(GL_BLEND);
        return;
    }
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, blend == RG_BLEND_ADD ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
}

bool gl_can_blend(const struct rg_device *device, const char **word)
{
    (void)device;
    *word = "GL_EXT_shader_framebuffer_fetch";
    return epoxy_has_gl_extension(*word);
}

static void set_depth(enum rg_depth_mode depth)
{
    if (depth == RG_DEPTH_OFF) {
        glDisable(GL_DEPTH_TEST);
        return;
    }
    glEnable(GL_DEPTH_TEST);
    glDepthMask(depth == RG_DEPTH_WRITE);
}

// shaders/draw.vert assumes this viewport, in which packed primitives lie.
static void set_viewport(bool packed, int width, int height)
{
    if (!packed) {
        glViewport(0, 0, width, height);
        return;
    }
    glViewport(-((RG_VIEWPORT_PX - width) / 2), -((RG_VIEWPORT_PX - height) / 2), RG_VIEWPORT_PX,
               RG_VIEWPORT_PX);
}

// Clockwise for the viewer, to whom row 0 is the top.
static void set_cull(enum rg_cull cull)
{
    if (cull == RG_CULL_NONE) {
        glDisable(GL_CULL_FACE);
        return;
    }
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CW);
    glCullFace(cull == RG_CULL_BACK ? GL_BACK : GL_FRONT);
}

static void set_state(struct gl_draw_state *now, const struct gl_draw_state *wanted)
{
    if (now->width != wanted->width || now->height != wanted->height ||
        now->packed != wanted->packed)
        set_viewport(wanted->packed, wanted->width, wanted->height);
    if (memcmp(now->scissor, wanted->scissor, sizeof(now->scissor)) != 0)
        glScissor(wanted->scissor[0], wanted->scissor[1], wanted->scissor[2], wanted->scissor[3]);
    if (now->blend != wanted->blend)
        set_blend(wanted->blend);
    if (now->depth != wanted->depth)
        set_depth(wanted->depth);
    if (now->cull != wanted->cull)
        set_cull(wanted->cull);
    *now = *wanted;
}

static struct gl_draw_state state_of(const struct gl_device *device, const struct rg_kernel *kernel,
                                     const struct rg_draw *draw,
                                     const struct gl_framebuffer *framebuffer)
{
    const bool packed = kernel->draw && rg_draw_packs(&device->pub, draw);
    struct gl_draw_state state = {
        .packed = packed,
        .width = framebuffer->key.width,
        .height = framebuffer->key.height,
        .scissor = {draw->x0, draw->y0, draw->x1 - draw->x0, draw->y1 - draw->y0},
        .blend = device->pub.blends ? RG_BLEND_OFF : draw->blend,
        .depth = framebuffer->key.depth ? draw->depth_mode : RG_DEPTH_OFF,
        .cull = packed ? RG_CULL_NONE : draw->cull, // packing has culled
    };
    if (!draw->x1) { // the whole target
        state.scissor[2] = state.width;
        state.scissor[3] = state.height;
    }
    return state;
}

static bool draw_packed(struct gl_device *device, const struct rg_kernel *kernel,
                        const struct rg_run *run)
{
    struct gl_bound *bound = &device->bound;
    const struct rg_buf *arguments = run->queries ? run->packed->query_args : run->packed->args;
    gl_bind_arguments(bound, ((const struct gl_buf *)arguments)->id);
    // Vertex shaders read corners from the storage block, fragment shaders read records from a
    // texture of words.
    gl_slot_buffer(bound, RG_SLOT_PRIMS, run->packed->prims);
    if (!gl_slot_words(bound, RG_SLOT_PRIMS, run->packed->prims))
        return false;
    if (run->queries)
        return gl_draw_queries(device, kernel, run);
    glDrawArraysIndirect(GL_TRIANGLES, NULL);
    return true;
}

// shaders/native.vert takes a vertex for each item.
static bool draw_items(struct gl_device *device, const struct rg_kernel *kernel,
                       const struct rg_run *run)
{
    const rg_draw_state *state = run->params; // an rg_draw_call begins with it
    if (run->queries)
        return gl_draw_queries(device, kernel, run);
    glDrawArrays(GL_POINTS, state->item_begin, state->item_end - state->item_begin);
    return true;
}

bool gl_draw(struct gl_device *device, const struct rg_kernel *kernel, const struct rg_run *run)
{
    const struct rg_draw *draw = run->draw;
    const struct gl_framebuffer *framebuffer = gl_framebuffer_of(device, draw);
    if (!framebuffer)
        return false;
    struct gl_bound *bound = &device->bound;
    const struct gl_draw_state state = state_of(device, kernel, draw, framebuffer);
    set_state(&bound->draw, &state);
    gl_bind_framebuffer(bound, framebuffer->id);
    if (kernel->draw) // else the slot is the kernel's own
        gl_bind_texture(bound, RG_SLOT_BEHIND, framebuffer->behind);
    if (rg_draw_counts(draw))
        gl_slot_buffer(bound, RG_SLOT_SAMPLES, draw->samples);
    if (!kernel->draw)
        glDrawArrays(GL_TRIANGLES, 0, 3); // shaders/pass.vert: one triangle over the target
    else if (!(state.packed ? draw_packed : draw_items)(device, kernel, run))
        return false;
    // The next run may overwrite what this run reads, and read its counts.
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    return gl_check_reported(device, state.packed ? "glDrawArraysIndirect" : "glDrawArrays",
                             "kernel", kernel->name);
}
