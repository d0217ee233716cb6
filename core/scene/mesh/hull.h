// Convex hulls in the plane.
#ifndef RG_CORE_SCENE_MESH_HULL_H
#define RG_CORE_SCENE_MESH_HULL_H

// Writes the corners of the convex hull of `count` points, one or more, to `hull`, counterclockwise
// where y runs up, and returns how many there are. Sorts the points by x and y, which takes time in
// proportion to them if they nearly are. `hull` has room for twice as many.
int rg_hull(double (*points)[2], int count, double (*hull)[2]);

#endif
