// Draws whose visible samples are counted by the API's occlusion queries.
#include "backends/gl/gl.h"

#include <stdlib.h>

#include "core/base/alloc.h"

static bool make_queries(struct gl_queries *queries, int count)
{
    if (queries->count >= count)
        return true;
    GLuint *ids = rg_alloc((size_t)count, sizeof(*ids), "occlusion queries");
    if (!ids)
        return false;
    glDeleteQueries(queries->count, queries->ids);
    free(queries->ids);
    glCreateQueries(GL_SAMPLES_PASSED, count, ids);
    *queries = (struct gl_queries){ids, count};
    return true;
}

// An offset into the bound buffer, as the pointer that calls take.
static void *at_byte(size_t offset)
{
    return (void *)(uintptr_t)offset;
}

// The driver writes results when it has them, so that nobody waits.
static void answer(const struct gl_queries *queries, const struct rg_run *run)
{
    glMemoryBarrier(GL_QUERY_BUFFER_BARRIER_BIT);
    glBindBuffer(GL_QUERY_BUFFER, ((const struct gl_buf *)run->draw->samples)->id);
    for (int i = 0; i < run->queries; i++)
        glGetQueryObjectuiv(queries->ids[i], GL_QUERY_RESULT,
                            at_byte(4 * ((size_t)run->first_query + (size_t)i)));
    glBindBuffer(GL_QUERY_BUFFER, 0);
}

static void draw_query(const struct rg_run *run, int query)
{
    const struct rg_items items = rg_query_items(run, query);
    if (run->packed)
        glDrawArraysIndirect(GL_TRIANGLES, at_byte(16 * (size_t)query));
    else
        glDrawArrays(GL_POINTS, items.first, items.count);
}

bool gl_draw_queries(struct gl_device *device, const struct rg_kernel *kernel,
                     const struct rg_run *run)
{
    if (!make_queries(&device->queries, run->queries))
        return false;
    for (int i = 0; i < run->queries; i++) {
        glBeginQuery(GL_SAMPLES_PASSED, device->queries.ids[i]);
        draw_query(run, i);
        glEndQuery(GL_SAMPLES_PASSED);
    }
    answer(&device->queries, run);
    return gl_check_reported(device, "glGetQueryObjectuiv", "kernel", kernel->name);
}

void gl_queries_end(struct gl_device *device)
{
    glDeleteQueries(device->queries.count, device->queries.ids);
    free(device->queries.ids);
}
