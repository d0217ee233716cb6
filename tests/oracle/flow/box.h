// An independent model of the box: the places of its panes in the world, and where water that
// crosses an edge comes out. Written from docs/flow.md in double precision, without anything of
// kernels/ or core/techniques/: points in space, not tables of neighbours.
//
// The box is a cube of half side 1 about the origin; x runs right, y up, z towards the viewer.
#ifndef RG_TESTS_ORACLE_FLOW_BOX_H
#define RG_TESTS_ORACLE_FLOW_BOX_H

#include <stdbool.h>

enum { BOX_FRONT, BOX_BACK, BOX_RIGHT, BOX_LEFT, BOX_TOP, BOX_BOTTOM, BOX_PANES };

struct box_oracle {
    // right, down and out of each pane, for a viewer before it
    double frames[BOX_PANES][3][3];
};

// Turns the box: clockwise about the front's normal, then its front up, then to the right.
void box_oracle_turn(struct box_oracle *box, double pitch_deg, double yaw_deg, double roll_deg);

// A texel of a pane of `size` texels a side.
struct box_texel {
    int pane, x, y;
};

// The texel (dx, dy) from another, over an edge if needed, as if the two panes there were one
// plane. Over a corner the way leads over the end of the upper or lower edge. False if the pane
// beyond the edge faces down by 30 degrees or more, so that water falls off.
bool box_oracle_walk(const struct box_oracle *box, int size, struct box_texel from, int dx, int dy,
                     struct box_texel *to);

// The centre of a texel in the world.
void box_oracle_centre(const struct box_oracle *box, int size, struct box_texel texel,
                       double point[3]);

#endif
