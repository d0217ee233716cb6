// Draws figures, and writes a page with them.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/tables/figures/figures.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/output.h"

enum { PATH_SIZE = 1024 };

static double exposure_of(const struct rg_figure *figure)
{
    return figure->exposure > 0 ? figure->exposure : 1;
}

// --- one figure ---

static bool find_path(const struct rg_figure_run *run, const struct rg_figure *figure,
                      const char *ending, char path[PATH_SIZE])
{
    if (snprintf(path, PATH_SIZE, "%s/%s%s", run->folder, figure->id, ending) < PATH_SIZE)
        return true;
    return rg_error("%.80s...: its name is too long; name a folder of at most %d bytes",
                    run->folder, PATH_SIZE - 80);
}

static bool write_greys(const char *path, const struct rg_figure *figure)
{
    struct rg_picture picture;
    if (!rg_picture_create(&picture, figure->side_px, figure->side_px, 1, path))
        return false;
    memcpy(picture.texels, figure->greys, (size_t)rg_picture_values(&picture) * sizeof(float));
    const bool written =
        rg_picture_write(path, &picture, &(struct rg_write_options){.exposure = 1});
    rg_picture_destroy(&picture);
    return written;
}

// Writes the file that a figure needs, and sets its parameter.
static bool set_file(const struct rg_figure_run *run, const struct rg_figure *figure,
                     const struct rg_technique *technique, void *settings)
{
    char name[RG_PATH_SIZE], path[PATH_SIZE], assignment[PATH_SIZE + 80];
    if (!figure->parameter)
        return true;
    snprintf(name, sizeof(name), "%s%s", figure->id, figure->ending);
    if (!find_path(run, figure, figure->ending, path) ||
        !(figure->text ? rg_output_write(run->folder, name, figure->text)
                       : rg_output_folder(run->folder) && write_greys(path, figure)))
        return false;
    snprintf(assignment, sizeof(assignment), "%s=%s", figure->parameter, path);
    return rg_params_set(technique->params, settings, assignment);
}

// Draws a figure and returns its session; NULL, and one logged line, on failure.
static struct rg_session *draw(const struct rg_figure_run *run, const struct rg_figure *figure)
{
    const struct rg_technique *technique = rg_technique_find(figure->technique);
    void *settings = technique ? rg_settings_create(technique) : NULL;
    struct rg_session *session = NULL;
    if (settings && rg_params_set_all(technique->params, settings, figure->settings) &&
        set_file(run, figure, technique, settings)) {
        const struct rg_subject subject = {technique, settings, run->width, run->height};
        session = rg_session_run(run->device, &subject, figure->frame);
    }
    free(settings);
    return session;
}

// --- the page ---

static void print_command(FILE *page, const struct rg_figure_run *run,
                          const struct rg_figure *figure)
{
    char settings[2048];
    snprintf(settings, sizeof(settings), "%s", figure->settings);
    fprintf(page, "    raingauge render %s --frame %d --size %dx%d", figure->technique,
            figure->frame, run->width, run->height);
    for (char *word = strtok(settings, " "); word; word = strtok(NULL, " "))
        fprintf(page, " --set %s", word);
    if (figure->parameter)
        fprintf(page, " --set %s=%s%s", figure->parameter, figure->id, figure->ending);
    if (figure->exposure > 0)
        fprintf(page, " --exposure %g", figure->exposure);
    fprintf(page, " -o %s.png\n", figure->id);
}

static bool write_page(const struct rg_figure_run *run)
{
    char *text = NULL;
    size_t size;
    FILE *page = open_memstream(&text, &size);
    if (!page)
        return rg_harness_error("figures.md: out of memory; draw fewer figures at once");
    fprintf(page,
            "# Figures\n\nDrawn by raingauge on %s. The scenes are not the papers'. "
            "Below each figure stand what is to be seen, and the paper's caption.\n",
            run->device->info.name);
    for (int i = 0; i < run->count; i++) {
        const struct rg_figure *figure = run->figures[i];
        fprintf(page, "\n![%s](%s.png)\n\n**%s.** %s\n\n> %s\n\n", figure->id, figure->id,
                figure->id, figure->caption, figure->printed);
        print_command(page, run, figure);
    }
    const bool written = fclose(page) == 0 && rg_output_write(run->folder, "figures.md", text);
    free(text);
    return written;
}

// --- all of them ---

// Draws and writes a figure, making the folder if needed, and only then closes the session before,
// so that shared assets are made once.
static bool next(const struct rg_figure_run *run, const struct rg_figure *figure,
                 struct rg_session **last)
{
    char path[PATH_SIZE];
    struct rg_session *session = find_path(run, figure, ".png", path) ? draw(run, figure) : NULL;
    rg_session_close(*last);
    *last = session;
    return session && rg_output_folder(run->folder) &&
           rg_frame_write(session, path, exposure_of(figure));
}

static bool has_room(const struct rg_figure_run *run)
{
    const int64_t pixels = (int64_t)run->width * run->height * run->count;
    return rg_output_can_be_written(run->folder, rg_picture_file_bytes(".png", pixels));
}

bool rg_figures_draw(const struct rg_figure_run *run)
{
    struct rg_progress progress;
    struct rg_session *last = NULL;
    bool good = has_room(run);
    rg_interrupt_watch();
    rg_progress_start(&progress, run->count);
    for (int i = 0; good && !rg_interrupted() && i < run->count; i++) {
        rg_progress_label(&progress, "%s", run->figures[i]->id);
        good = next(run, run->figures[i], &last);
        rg_progress_add(&progress, 1);
    }
    rg_progress_end(&progress);
    rg_session_close(last);
    return good && !rg_interrupted() && write_page(run);
}
