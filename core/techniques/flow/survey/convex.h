// How nearly a shape is convex: surface tension leaves a drop at rest no dents.
#ifndef RG_CORE_TECHNIQUES_FLOW_SURVEY_CONVEX_H
#define RG_CORE_TECHNIQUES_FLOW_SURVEY_CONVEX_H

// Points of `room` for each row of texels that a shape covers.
enum { FLOW_CONVEX_ROOM = 6 };

// The number of a shape's texels over that of the texels whose middles lie in the convex hull of
// its middles. Texels are indices in a map with rows of `row`; there is one at least, and one in
// each row from the first to the last.
double flow_convexity(const int *texels, int count, int row, double (*room)[2]);

#endif
