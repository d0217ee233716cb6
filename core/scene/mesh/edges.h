// The edges of a mesh, for outlines: with the normals of the faces that meet in them.
#ifndef RG_CORE_SCENE_MESH_EDGES_H
#define RG_CORE_SCENE_MESH_EDGES_H

#include "core/scene/mesh/mesh.h"

// Words of an edge.
enum { RG_EDGE_ENDS = 0, RG_EDGE_NORMALS = 6, RG_EDGE_WORDS = 12 };

// Vertices that lie together are one, so that an edge between faces of several normals is one too.
struct rg_edges {
    int count;
    // A word of all edges, then the next of all: x, y, z of both ends, then the normals of both
    // faces, of unit length and on the outer side of the first. A boundary's second normal is 0.
    float *words;
};

// Where more than two faces meet in an edge, they are taken in pairs, and one that is left over is
// a boundary. Faces without area have no edges. False, and one logged line, without memory; freed
// in either case.
bool rg_mesh_edges(const struct rg_mesh *mesh, struct rg_edges *edges);
void rg_edges_free(struct rg_edges *edges);

#endif
