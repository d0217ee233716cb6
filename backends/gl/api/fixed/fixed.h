// Draws of fixed functions by OpenGL, in a context of their own: no state of theirs reaches what
// raingauge draws otherwise. A draw sets all state that any of them uses.
#ifndef RG_BACKENDS_GL_API_FIXED_FIXED_H
#define RG_BACKENDS_GL_API_FIXED_FIXED_H

#include "backends/gl/gl.h"
#include "shaders/fixed/fixed.h"

enum gl_fixed_buffer {
    GL_FIXED_PARAMS,
    GL_FIXED_VERTICES,
    GL_FIXED_FORMATS,
    GL_FIXED_OFFSETS,
    GL_FIXED_INDICES,
    GL_FIXED_ARGUMENTS,
    GL_FIXED_COUNTS,
    GL_FIXED_FEEDBACK,
    GL_FIXED_BUFFERS
};

enum { GL_FIXED_QUERIES = 1 + RG_FIXED_STATISTICS };

// A draw and its objects; 0 stands for one that it does not need.
struct gl_fixed_job {
    struct gl_device *device; // of the own context
    const struct rg_fixed_state *state;
    const char *feature;
    struct rg_fixed_picture *picture;
    struct rg_fixed_vertices vertices;
    GLuint program, vertex_array;
    GLuint buffers[GL_FIXED_BUFFERS];
    GLuint texture, sampler, stores[RG_FIXED_STORES];
    GLuint colours[RG_FIXED_EQUATIONS], depth, framebuffer;
    GLuint copy, copied; // a framebuffer and its image, which has the resolved or smaller target
    GLuint queries[GL_FIXED_QUERIES];
};

// The context beside a device's, with what its errors are told by.
struct gl_fixed {
    struct gl_device own;
};

// program.c: false, and one logged line, on failure.
bool gl_fixed_program(struct gl_fixed_job *draw);

// texture.c: makes the texture and its sampler.
void gl_fixed_texture(struct gl_fixed_job *draw);

// target.c
void gl_fixed_targets(struct gl_fixed_job *draw);
// Adds all that the draw left to its picture. False, and one logged line, if there is no room. The
// caller checks the calls.
bool gl_fixed_read(struct gl_fixed_job *draw);

// state.c
void gl_fixed_state(const struct rg_fixed_state *state);
GLenum gl_fixed_compare(int compare);

#endif
