// Papers' figures as they can be drawn anew: what is to be seen on each, and the settings that show
// it. Scenes are ours, so that a figure shows what the paper's shows, not the same picture.
#ifndef RG_HARNESS_FRAMES_FIGURES_FIGURES_H
#define RG_HARNESS_FRAMES_FIGURES_FIGURES_H

#include "harness/frames/session.h"

struct rg_figure {
    const char *id; // the paper and the figure's number there: "creus-4.14"; a letter for a part
    const char *technique;
    const char *settings; // what --set takes, with spaces between
    int frame;
    double exposure; // as --exposure; 0: 1
    // A file that a setting names: it is written beside the picture, under the figure's id and this
    // ending. It is a text, or else a grey picture of side_px x side_px linear values. NULL: none.
    const char *parameter, *ending, *text;
    const float *greys;
    int side_px;
    const char *caption; // our own
};

// All figures, paper by paper; a row without an id ends them.
const struct rg_figure *rg_figure_at(int index);        // NULL behind the last
const struct rg_figure *rg_figure_find(const char *id); // NULL: none

// Which figures are drawn, and how.
struct rg_figure_run {
    struct rg_device *device;
    int width, height; // pixels
    const char *folder;
    const struct rg_figure *const *figures;
    int count;
};

// Draws each figure into FOLDER/ID.png, with the file that it needs, and then writes a page in
// Markdown beside them, with their captions and the commands that draw them. The folder is made if
// only its last part is missing. A bar shows progress. False, and one logged line, on failure, or
// when the user interrupts (harness/console/interrupt.h), which it watches for; what is written
// stays, each file of it whole.
bool rg_figures_draw(const struct rg_figure_run *run);

#endif
