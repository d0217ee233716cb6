// Papers' figures, to be redrawn: what each shows, and the settings for it. The scenes are ours, so
// that a figure shows the same subject as the paper's, not the same picture.
#ifndef RG_HARNESS_TABLES_FIGURES_FIGURES_H
#define RG_HARNESS_TABLES_FIGURES_FIGURES_H

#include "harness/devices/frames/session.h"

struct rg_figure {
    const char *id; // the paper and the figure's number: "creus-4.14"; a letter marks a part
    const char *technique;
    const char *settings; // as for --set, separated by spaces
    int frame;
    double exposure; // as --exposure; 0: 1
    // A file for a parameter, whose name is the figure's id and `ending`, in the picture's folder.
    // It has `text`, or else a grey picture of side_px x side_px linear values. NULL: none.
    const char *parameter, *ending, *text;
    const float *greys;
    int side_px;
    const char *caption; // our own
    const char *printed; // the paper's own; a long one's short form, as its list of figures has it
};

// All figures, grouped by paper; a row without an id ends them.
const struct rg_figure *rg_figure_at(int index);        // NULL after the last
const struct rg_figure *rg_figure_find(const char *id); // NULL: none

// The figures to draw, and how.
struct rg_figure_run {
    struct rg_device *device;
    int width, height; // pixels
    const char *folder;
    const struct rg_figure *const *figures;
    int count;
};

// Draws each figure into FOLDER/ID.png, with the file that it needs. Then writes a Markdown page in
// that folder, with captions and the commands that draw them. The last part of the folder's path is
// made if missing. Shows a progress bar. False, and one logged line, on failure or interruption
// (harness/console/interrupt.h); complete files stay.
bool rg_figures_draw(const struct rg_figure_run *run);

#endif
