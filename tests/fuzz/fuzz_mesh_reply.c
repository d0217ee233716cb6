// The importer's reply, however wrong, and meshes of any topology with other numbers of faces. The
// first two bytes are the wanted number; the rest is the reply.
#include <stdlib.h>
#include <string.h>

#include "core/scene/mesh/reply.h"
#include "core/scene/mesh/read.h"
#include "tests/fuzz/fuzz.h"

// Mostly makes the counts fit the reply's size; otherwise nothing else would be tried.
static void mend_header(uint8_t *reply, size_t size)
{
    struct rg_import_reply header;
    memcpy(&header, reply, sizeof(header));
    if (header.reserved % 4 == 0)
        return;
    const uint32_t words = (uint32_t)((size - sizeof(header)) / 4);
    header.magic = RG_REPLY_MAGIC;
    header.error[0] = 0;
    header.vertex_count = header.vertex_count % (words / 6 + 1);
    header.face_count = (words - 6 * header.vertex_count) / 3;
    memcpy(reply, &header, sizeof(header));
}

static uint32_t *find_indices(uint8_t *reply, const struct rg_import_reply *header)
{
    return (uint32_t *)(void *)(reply + sizeof(*header) + 24 * (size_t)header->vertex_count);
}

// Mostly keeps indices within range, for the same reason.
static void mend_indices(uint8_t *reply)
{
    struct rg_import_reply header;
    memcpy(&header, reply, sizeof(header));
    if (header.reserved % 8 < 2 || !header.vertex_count)
        return;
    uint32_t *indices = find_indices(reply, &header);
    for (size_t i = 0; i < 3 * (size_t)header.face_count; i++)
        indices[i] %= header.vertex_count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2 + sizeof(struct rg_import_reply))
        return 0;
    const int faces = data[0] + 256 * (data[1] % 2);
    size_t bytes = (size - 2) / 4 * 4;
    uint8_t *reply = malloc(bytes);
    if (!reply)
        return 0;
    memcpy(reply, data + 2, bytes);
    struct rg_import_reply header;
    mend_header(reply, bytes);
    memcpy(&header, reply, sizeof(header));
    if (header.reserved % 4) {
        bytes = sizeof(header) + 24 * (size_t)header.vertex_count + 12 * (size_t)header.face_count;
        mend_indices(reply);
    }
    fuzz_listen();
    struct rg_mesh *mesh = rg_mesh_from_reply("fuzz", reply, bytes);
    struct rg_mesh *resized = mesh ? rg_mesh_resize(mesh, faces) : NULL;
    if (mesh)
        fuzz_judge(resized);
    fuzz_listen();
    if (mesh)
        fuzz_judge(mesh);
    free(reply);
    return 0;
}
