// Triangle meshes in memory, from files, by name, and brought to a wanted number of faces.
#ifndef RG_CORE_SCENE_MESH_MESH_H
#define RG_CORE_SCENE_MESH_MESH_H

#include <stdbool.h>
#include <stdint.h>

// What a mesh may hold at most: each of its arrays then takes 120 MB, and fits into a buffer of 128
// MiB, which is the most that some drivers bind.
enum { RG_MESH_MAX_VERTICES = 10000000, RG_MESH_MAX_FACES = 10000000, RG_MESH_NAME_SIZE = 160 };

// No coordinate is further from 0: squares and products of three stay within a float.
#define RG_MESH_FARTHEST 1e12f

// Three tight arrays, as kernels read them. Faces keep the order of the file, which is the order in
// which devices blend them; vertices are numbered in the order in which faces first use them, and
// no two have the same position and normal, bit for bit.
struct rg_mesh {
    char name[RG_MESH_NAME_SIZE]; // what it is, for people and records: "bunny.obj"
    int vertex_count, face_count; // both at least 1
    float *positions;             // x, y, z a vertex, in the file's unit
    float *normals;               // x, y, z a vertex, of length 1
    uint32_t *indices;            // three vertices a face, counter-clockwise seen from outside
    float low[3], high[3];        // bounds of the positions; not all of them equal
    uint64_t hash; // XXH3 of the positions, then the indices, each word as little-endian bytes
};

// A model by name, or any file, as core/scene/mesh/models.h says. NULL, and one logged line that
// names it, the fault and the mend, on failure; so do all functions below that return a mesh. The
// caller destroys it.
struct rg_mesh *rg_mesh_load(const char *name);

// The same with so many faces, as rg_mesh_resize; 0: as many as it has.
struct rg_mesh *rg_mesh_load_faces(const char *name, int faces);

// The mesh of a file that Assimp reads (OBJ, PLY, STL, glTF, GLB, 3DS, OFF and others); `member`
// names a file inside a tar archive, or is NULL. All meshes of the file's scene become one, moved
// to where its nodes place them. Polygons are triangulated; points, lines, materials and textures
// are left out, so that a missing texture is no fault. Normals are the file's, but for STL, whose
// normals belong to facets; where there are none they are made as by rg_mesh_smooth.
//
// The work is done in another process, `raingauge_importer`, within bounds of time and memory:
// a file on which Assimp crashes or hangs is refused like any other.
struct rg_mesh *rg_mesh_read(const char *path, const char *member);

// A mesh of copies of these arrays (`normals` may be NULL, and a normal that is no direction counts
// as absent). Joins equal vertices, drops those without a face, makes absent normals. Refuses an
// index out of range, a coordinate that is no number or beyond RG_MESH_FARTHEST, counts out of
// range and a mesh without extent.
struct rg_mesh *rg_mesh_create(const char *name, int vertex_count, int face_count,
                               const float *positions, const float *normals,
                               const uint32_t *indices);
void rg_mesh_destroy(struct rg_mesh *mesh);

// The normals as kernels read them, a word each (kernels/dialect/mesh/normal.h); the caller frees
// them. NULL, and one logged line, without memory.
uint32_t *rg_mesh_pack_normals(const struct rg_mesh *mesh);

// The same surface with one normal a position: the mean of its faces' normals, each as its area.
// Edges become smooth. Straight up where the faces around a vertex have no area.
struct rg_mesh *rg_mesh_smooth(const struct rg_mesh *mesh);

// A coarser mesh with smooth normals, of the most faces up to `faces` that meshoptimizer reaches:
// mostly the number itself or one less, since an edge takes two faces with it when it collapses.
// Where the topology forbids so few, parts of the surface are merged. The name says what was done.
struct rg_mesh *rg_mesh_decimate(const struct rg_mesh *mesh, int faces);

// A finer mesh of the same shape: the longest edges are halved until there are `faces` faces. One
// less where the number cannot be reached: an edge that is halved adds a face on each of its sides,
// so only a surface with a border reaches odd numbers from even ones. Normals are smooth.
struct rg_mesh *rg_mesh_refine(const struct rg_mesh *mesh, int faces);

// Exactly `faces` faces, or what rg_mesh_refine reaches: decimated, then refined as far as needed.
struct rg_mesh *rg_mesh_resize(const struct rg_mesh *mesh, int faces);

#endif
