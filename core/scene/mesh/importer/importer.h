// The parts of raingauge_importer: a file's bytes, its header's claims, its scene as arrays.
//
// The program handles one file and then exits, so it frees no memory.
#ifndef RG_CORE_SCENE_MESH_IMPORTER_IMPORTER_H
#define RG_CORE_SCENE_MESH_IMPORTER_IMPORTER_H

#include <assimp/cfileio.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/scene/mesh/reply.h"

// A file that the mesh's file refers to.
enum { IMPORT_MAX_BUFFERS = 32 };
struct import_buffer {
    char *path; // as Assimp asks for it, undecoded
    unsigned char *bytes;
    size_t size;
};

struct import {
    const char *name;      // as Assimp sees it: the path, or the archive's member
    const char *extension; // of the name, without its dot; "" for none
    unsigned char *bytes;  // `size` of them, with one more byte allocated
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

// Sets the reply's error, without the file's name, and returns false.
bool import_refuse(struct import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Sets the name and the extension.
void import_name(struct import *import, const char *name);
// Reads the file and its buffers, or opens the archive if `member` is not NULL, before the cage is
// shut. Parses nothing.
bool import_open(struct import *import, const char *path, const char *member);
// Reads a whole regular file of at most RG_IMPORT_MAX_FILE_BYTES, and allocates one more byte.
// NULL, and errno, on failure.
unsigned char *import_read_whole(const char *path, size_t *size);
// Reads the buffer files of a glTF file while files can still be opened. Assimp will report missing
// ones.
void import_read_buffers(struct import *import);
// Reads the archive's member, if one is asked for.
bool import_read_member(struct import *import);

// Parses the file's bytes into the arrays and the reply's counts.
bool import_load(struct import *import);

// Assimp's files: the mesh's own from memory, and glTF's buffers that were read before. No others:
// no materials, no textures, nothing to write.
struct aiFileIO import_files(struct import *import);

// Rewrites an OFF file as OBJ.
bool import_off_as_obj(struct import *import);

// Refuses more than a mesh may hold, before memory is taken, and a mesh without faces.
bool import_check_count(struct import *import, int64_t vertices, int64_t faces);
// The same for a file's own claims: the headers of PLY and binary STL, the lines of OBJ. `faces`
// gets the header's number, -1 where a format has none.
bool import_check_claim(struct import *import, int64_t *faces);

// The faces of all meshes of a scene, where a polygon counts once.
int64_t import_count_polygons(const struct aiScene *scene);

// Whether every coordinate is finite, every index within its mesh, every node's mesh present, and
// the whole within a mesh's limits.
bool import_check_scene(struct import *import, const struct aiScene *scene);
// Fills the arrays with a checked scene's triangles, placed by its nodes.
bool import_gather(struct import *import, const struct aiScene *scene);

#endif
