// A ray caster of flow's box and of its one pane, in double precision: it makes the pictures that
// cpu:reference has to draw. Written from docs/flow.md without anything of kernels/ or
// core/techniques/.
#ifndef RG_TESTS_ORACLE_FLOW_PICTURE_H
#define RG_TESTS_ORACLE_FLOW_PICTURE_H

#include "tests/oracle/flow/box.h"
#include "tests/oracle/flow/light.h"

// The fault of a mutant of the oracle.
enum picture_mutation {
    PICTURE_RIGHT,
    PICTURE_FAR_OVER_NEAR, // draws the far pane last
    PICTURE_NO_FAR,        // or not at all
    PICTURE_BULGING,       // drops on far panes bulge towards the viewer
    PICTURE_NO_DEPTH,      // far panes are drawn before the model
    PICTURE_NO_MASK,       // drops on far panes show the model, though it is nearer
};

struct picture_oracle {
    struct box_oracle box;
    struct light_surface panes[BOX_PANES];
    bool one_pane, mirror; // one_pane: the front fills the view; else the whole box
    // The camera looks at the middle; its distance in half sides of the box.
    double azimuth_deg, elevation_deg, distance, view_angle_deg;
    double bar; // width of the bars along the edges, in sides of a pane
    struct light_fresnel fresnel;
    double refraction_strength, reflectivity;
    // A sphere in the middle; radius 0: none.
    double radius, grey;
    double lamp, lamp_azimuth_deg, lamp_elevation_deg, drop_shadow;
    struct light_cube environment, reflection, ambient;
    enum picture_mutation mutation;
};

// width x height x 3 values of linear light, row 0 on top.
void picture_oracle_draw(const struct picture_oracle *picture, int width, int height,
                         double *light);

// The place of a point of the world in the picture, in pixels from the upper left corner.
void picture_oracle_project(const struct picture_oracle *picture, int width, int height,
                            const double point[3], double pixel[2]);

#endif
