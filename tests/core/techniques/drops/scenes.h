// Scenes of a few drops and puddles on a small pane, opened alike as drops on a device and as the
// model of the paper's rule: without chance, and where the order of drops does not matter.
#ifndef RG_TESTS_CORE_TECHNIQUES_DROPS_SCENES_H
#define RG_TESTS_CORE_TECHNIQUES_DROPS_SCENES_H

#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/drops/drops.h"

enum { COLUMNS = 72, ROWS = 44, MOST = 8 };

// The IDs below are the scene's own: drops have the first ones.
enum { SCENE_NEXT_ID = 20 };

#define CELL_MM 0.5

// A drop's place is in mm from the pane's upper left corner.
struct start {
    uint32_t parent;
    double mg, x, y, vx, vy;
};

// Water of a drop that is no more: so many cells of one height.
struct puddle {
    uint32_t id;
    int column, row, columns, rows;
    double height;
};

struct scene {
    const char *about, *settings;
    int steps;
    struct start drops[MOST];
    struct puddle puddles[4];
};

// Ends with one without `about`. A scene has as few steps as keep heights further from a threshold
// than rounding moves them.
extern const struct scene scenes[];

// A setting's value in a scene's, or `otherwise`.
double scene_setting(const struct scene *scene, const char *name, double otherwise);
// With `more` settings. The caller closes each.
struct drops *scene_open(struct rg_device *device, const struct scene *scene, const char *more);
void scene_open_model(struct oracle_drops *model, const struct scene *scene);

#endif
