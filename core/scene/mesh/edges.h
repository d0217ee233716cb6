// The edges of a mesh, for outlines, with the normals of the faces on both sides.
#ifndef RG_CORE_SCENE_MESH_EDGES_H
#define RG_CORE_SCENE_MESH_EDGES_H

#include "core/scene/mesh/mesh.h"

// The words of an edge.
enum { RG_EDGE_ENDS = 0, RG_EDGE_NORMALS = 6, RG_EDGE_WORDS = 12 };

// Vertices at the same place are merged, so that faces with different normals share their edge.
struct rg_edges {
    int count;
    // Word by word, each for all edges: x, y, z of both ends, then the unit normals of both faces,
    // on the outer side of the first. A boundary's second normal is 0.
    float *words;
};

// Makes the edges. If more than two faces share one, they are taken in pairs, and a left-over one
// is a boundary. Faces without area have no edges. False, and one logged line, when memory runs
// out; call rg_edges_free in either case.
bool rg_mesh_edges(const struct rg_mesh *mesh, struct rg_edges *edges);
void rg_edges_free(struct rg_edges *edges);

#endif
