// An independent model of sliding drops, in double precision and millimetres, written from
// docs/flow.md. Here, water is not counted in whole droplets.
#ifndef RG_TESTS_ORACLE_FLOW_SLIDE_H
#define RG_TESTS_ORACLE_FLOW_SLIDE_H

struct slide_oracle {
    int n, cells; // texels and cells of the lattice along a side; n is a multiple of cells
    double pane_mm, cell_mm, run_s;
    double cos_alpha, down_x, down_y; // the way down the pane, of unit length
    double slide_above_mm3, slide_gain_mm_s, slide_most_mm_s;
    double levelling_mm_s, cohesion, contact_slope, drying_mm2_s;
    int ways[8][2];         // of the next run, in texels, by pace
    const double *beads_mm; // the water that clings to each texel
    double *mm;             // the water's height
};

// One run: water dries, levels, and slides.
void slide_oracle_run(struct slide_oracle *oracle);

#endif
