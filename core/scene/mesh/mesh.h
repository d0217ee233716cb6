// Triangle meshes in memory, from files or by name, resized to a wanted number of faces.
#ifndef RG_CORE_SCENE_MESH_MESH_H
#define RG_CORE_SCENE_MESH_MESH_H

#include <stdbool.h>
#include <stdint.h>

// Limits of a mesh: each array then takes at most 120 MB, and fits into a buffer of 128 MiB, the
// most that some drivers bind.
enum { RG_MESH_MAX_VERTICES = 10000000, RG_MESH_MAX_FACES = 10000000, RG_MESH_NAME_SIZE = 160 };

// The largest absolute coordinate: squares and products of three stay within a float.
#define RG_MESH_FARTHEST 1e12f

// Three tight arrays, as kernels read them. Faces keep the file's order, in which devices blend
// them. Vertices are numbered in the order of first use, and no two have bitwise equal position and
// normal.
struct rg_mesh {
    char name[RG_MESH_NAME_SIZE]; // a description for people and records: "bunny.obj"
    int vertex_count, face_count; // both at least 1
    float *positions;             // x, y, z of each vertex, in the file's unit
    float *normals;               // x, y, z of each vertex, of length 1
    uint32_t *indices;            // three of each face, counter-clockwise seen from outside
    float low[3], high[3];        // bounds of the positions; never a single point
    uint64_t hash; // XXH3 of the positions, then the indices, each word as little-endian bytes
};

// A model by name, or any file, as core/scene/mesh/models.h says. NULL, and one logged line that
// names it, the fault and the mend, on failure; so do all functions below that return a mesh. The
// caller destroys it.
struct rg_mesh *rg_mesh_load(const char *name);

// The same with this many faces (rg_mesh_resize); 0: as many as it has.
struct rg_mesh *rg_mesh_load_faces(const char *name, int faces);

// The mesh of a file that Assimp reads (OBJ, PLY, STL, glTF, GLB, 3DS, OFF and others); `member`
// names a file inside a tar archive, or is NULL. All meshes of the file's scene become one, placed
// as its nodes say. Polygons are triangulated; points, lines, materials and textures are ignored,
// so that a missing texture is no error. Normals come from the file; for STL, which has one for
// each facet, and where they are missing, they are made as by rg_mesh_smooth.
//
// Another process, `raingauge_importer`, does the work within limits of time and memory, so that a
// file on which Assimp crashes or hangs is refused like any other bad file.
struct rg_mesh *rg_mesh_read(const char *path, const char *member);

// A mesh of copies of these arrays (`normals` may be NULL, and a normal without direction counts as
// missing). Joins equal vertices, drops unused ones, makes missing normals. Refuses an index out of
// range, a coordinate that is NaN or beyond RG_MESH_FARTHEST, counts out of range and a mesh
// without extent.
struct rg_mesh *rg_mesh_create(const char *name, int vertex_count, int face_count,
                               const float *positions, const float *normals,
                               const uint32_t *indices);
void rg_mesh_destroy(struct rg_mesh *mesh);

// The normals packed to one word each, as kernels read them (kernels/dialect/mesh/normal.h); the
// caller frees them. NULL, and one logged line, when memory runs out.
uint32_t *rg_mesh_pack_normals(const struct rg_mesh *mesh);

// The same surface with smooth edges: one normal for each position, the mean of its faces' normals
// weighted by area, or straight up if these faces have no area.
struct rg_mesh *rg_mesh_smooth(const struct rg_mesh *mesh);

// A coarser mesh with smooth normals, of at most `faces` faces: mostly `faces` or one less, since a
// collapsing edge removes two faces. If the topology forbids so few, parts of the surface are
// merged. The same on every machine. The new name describes the change.
struct rg_mesh *rg_mesh_decimate(const struct rg_mesh *mesh, int faces);

// A finer mesh of the same shape: the longest edges are halved until there are `faces` faces, or
// one less. A halved edge adds a face on each of its sides, so that only a surface with a border
// reaches odd numbers from even ones. Normals are smooth.
struct rg_mesh *rg_mesh_refine(const struct rg_mesh *mesh, int faces);

// Exactly `faces` faces, or as near as rg_mesh_refine comes: decimates, then refines as needed.
struct rg_mesh *rg_mesh_resize(const struct rg_mesh *mesh, int faces);

#endif
