// An independent model of water on a pane, in double precision and whole droplets.
//
// Written from the equations of Stuppacher & Supan (2007) and the rules of docs/flow.md, without
// anything of kernels/ or core/techniques/. It pushes water where the kernels pull it, has no
// margins, counts droplets in integers, and turns the pane by rotating vectors. Both share only
// inputs: the maps' values and the list of drops.
#ifndef RG_TESTS_ORACLE_FLOW_FLOW_H
#define RG_TESTS_ORACLE_FLOW_FLOW_H

#include <stdbool.h>
#include <stdint.h>

// Droplets a unit of height.
#define ORACLE_DROPLETS 65536

struct oracle_settings {
    int size;         // texels along a side of the pane
    double threshold; // L
    double fast;      // M
    double far_share; // r
    double capacity;
    bool split;   // between two directions, or all into the nearest
    bool keeps;   // texels keep their own directions, split likewise
    double sweep; // the neighbours' share in these directions
    double pitch_deg, yaw_deg, roll_deg;
    const float *remainder; // borrowed: for heights evenly spaced from 0 to remainder_max_height
    int remainder_entries;
    double remainder_max_height;
    const float *noise; // borrowed: noise_size x noise_size
    int noise_size;
    double noise_window, noise_scroll_x, noise_scroll_y;
};

struct oracle {
    struct oracle_settings settings;
    int64_t *water;           // size x size, droplets
    int *kept;                // a texel's own way, in 2048ths of a turn; -1: it did not move
    int64_t sourced, drained; // droplets since the start
    int64_t frame;
};

// Opens a dry pane at frame 0. The caller calls oracle_close.
void oracle_open(struct oracle *oracle, const struct oracle_settings *settings);
void oracle_close(struct oracle *oracle);

// Lands a drop: a cap whose profile is a half ellipse, centre and radius in texels.
void oracle_land(struct oracle *oracle, double x, double y, double radius, double height);

// Moves the water by one frame.
void oracle_step(struct oracle *oracle);

// The pane's tangent (right), binormal (down) and normal in the world.
void oracle_frame(const struct oracle_settings *settings, double frame[3][3]);

#endif
