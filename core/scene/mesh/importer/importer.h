// The parts of raingauge_importer: a file's bytes, what its header claims, its scene as arrays.
//
// It runs alone in its process, so it leaves memory to the end of the process.
#ifndef RG_CORE_SCENE_MESH_IMPORTER_IMPORTER_H
#define RG_CORE_SCENE_MESH_IMPORTER_IMPORTER_H

#include <assimp/cfileio.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/scene/mesh/reply.h"

// A file that the mesh's file names.
enum { IMPORT_MAX_BUFFERS = 32 };
struct import_buffer {
    char *path; // as Assimp asks for it, which decodes nothing
    unsigned char *bytes;
    size_t size;
};

struct import {
    const char *name;      // as Assimp is told it: the path, or the archive's member
    const char *extension; // of the name, without its dot; "" for none
    unsigned char *bytes;  // `size` of them, in memory of a byte more
    size_t size;
    int archive;        // the descriptor that `member` is read from
    const char *member; // NULL: none
    struct import_buffer buffers[IMPORT_MAX_BUFFERS];
    int buffer_count;
    const struct aiScene *scene;
    struct rg_import_reply reply;
    float *positions, *normals;
    uint32_t *indices;
};

// Sets the reply's error, without the file's name; false.
bool import_refuse(struct import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Sets the name and the extension.
void import_name(struct import *import, const char *name);
// Before the cage is shut: reads the file and the buffers that it names, or opens the archive whose
// `member` is not NULL. Nothing is parsed.
bool import_open(struct import *import, const char *path, const char *member);
// All of a regular file of at most RG_IMPORT_MAX_FILE_BYTES, in memory of a byte more. NULL, and
// errno, on failure.
unsigned char *import_read_whole(const char *path, size_t *size);
// The files that a glTF file names as its buffers, while files can still be opened. What is absent
// is left for Assimp to miss.
void import_read_buffers(struct import *import);
// The archive's member, if one is asked for.
bool import_read_member(struct import *import);

// From the file's bytes to the arrays and their counts in the reply.
bool import_load(struct import *import);

// Files for Assimp: the one that was read, out of memory, and glTF's buffers beside it.
// These were read beforehand. Nothing else is: no materials, no textures, nothing to write.
struct aiFileIO import_files(struct import *import);

// Rewrites an OFF file as OBJ.
bool import_off_as_obj(struct import *import);

// Refuses more than a mesh may hold, before memory is taken for it, and a mesh without faces.
bool import_check_count(struct import *import, int64_t vertices, int64_t faces);
// The same for what a file says of itself: the headers of PLY and binary STL, the lines of OBJ.
// `faces` is what the header promises, -1 where a format promises nothing.
bool import_check_claim(struct import *import, int64_t *faces);

// The faces of all meshes of a scene, polygons counted once.
int64_t import_count_polygons(const struct aiScene *scene);

// Is every coordinate a number, every index within its mesh, every mesh of a node there, and the
// whole within a mesh's limits?
bool import_check_scene(struct import *import, const struct aiScene *scene);
// Fills the arrays with a checked scene's triangles, placed by its nodes.
bool import_gather(struct import *import, const struct aiScene *scene);

#endif
