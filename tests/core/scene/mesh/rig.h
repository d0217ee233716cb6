// For tests of meshes: one box in every format, and a check of any mesh.
#ifndef RG_TESTS_CORE_SCENE_MESH_RIG_H
#define RG_TESTS_CORE_SCENE_MESH_RIG_H

#include "core/scene/mesh/mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

// A box from (-1, -2, -3) to (2, 4, 8): 8 corners, 12 triangles, counter-clockwise from outside.
enum { BOX_VERTICES = 8, BOX_FACES = 12 };
extern const float box_positions[3 * BOX_VERTICES];
extern const uint32_t box_indices[3 * BOX_FACES];

// A file in memory.
struct bytes {
    size_t size;
    unsigned char data[8192];
};

// The box in a format. `extension` is the ending that the file's name needs.
struct box_format {
    const char *name, *extension;
    void (*write)(struct bytes *file);
};
extern const struct box_format box_formats[];
extern const int box_format_count;

void put_text(struct bytes *file, const char *format, ...) __attribute__((format(printf, 2, 3)));
void put_bytes(struct bytes *file, const void *data, size_t size);

// A folder for a test program's files, made and removed by cmocka's group fixtures.
int make_folder(void **state);
int remove_folder(void **state);
extern char folder[];
const char *in_folder(const char *name); // valid until the next call
void write_file(const char *path, const void *data, size_t size);

// The lines logged since the last listen_now.
struct lines {
    int count;
    char last[1024];
};
extern struct lines lines;
void listen_now(void);

// Loading must return NULL with exactly one line, which names the file and holds `why`.
void expect_refused(const char *path, const char *why);
void expect_bytes_refused(const char *name, const struct bytes *file, const char *why);
void expect_text_refused(const char *name, const char *text, const char *why);

// Loads a sound file, without a line.
struct rg_mesh *load_bytes(const char *name, const struct bytes *file);
struct rg_mesh *load_text(const char *name, const char *text);

// Checks what mesh.h promises of every mesh.
void check_mesh(const struct rg_mesh *mesh);

#endif
