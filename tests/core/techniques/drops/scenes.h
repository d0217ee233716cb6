// Scenes of a few drops and puddles on a small pane, for drops on a device and for a model of the
// paper's rule. They have no chance, and the order of drops does not matter.
#ifndef RG_TESTS_CORE_TECHNIQUES_DROPS_SCENES_H
#define RG_TESTS_CORE_TECHNIQUES_DROPS_SCENES_H

#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/drops/drops.h"

enum { COLUMNS = 72, ROWS = 44, MOST = 8 };

// IDs below are the scene's own; drops have the first ones.
enum { SCENE_NEXT_ID = 20 };

#define CELL_MM 0.5

// A drop's place is in mm from the pane's upper left corner.
struct start {
    uint32_t parent;
    double mg, x, y, vx, vy;
};

// Water of a drop that no longer exists: a rectangle of cells of one height.
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

// The last scene has no `about`. A scene has so few steps that heights stay further from any
// threshold than rounding moves them.
extern const struct scene scenes[];

// The value of a setting in a scene, or `otherwise`.
double scene_setting(const struct scene *scene, const char *name, double otherwise);
// Adds the settings `more`. The caller closes both.
struct drops *scene_open(struct rg_device *device, const struct scene *scene, const char *more);
void scene_open_model(struct oracle_drops *model, const struct scene *scene);

#endif
