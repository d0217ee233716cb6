// Draws with the device cpu, or compares pictures, in one process without workers, so that
// ThreadSanitizer or valgrind can watch everything. If they find something, they end the process
// with a status of their own.
//
//     watched TECHNIQUE SIDE FRAMES 'KEY=VALUE KEY=VALUE'...    once for each of these settings
//     watched pictures
//     watched planted [NAME right|wrong]                        lists races; runs one, or the value
//                                                               that nobody has set
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/files/io.h"
#include "core/techniques/technique.h"
#include "tests/backends/watched/annotate.h"
#include "tests/backends/watched/planted.h"

// How often a thread has joined another's work so far. Without ThreadSanitizer nobody counts.
static int helpers(void)
{
#ifdef __SANITIZE_THREAD__
    return annotated_helpers();
#else
    static int uncounted;
    return uncounted++;
#endif
}

// Steps and draws with buffers, passes and images, as a command does.
static bool run_frames(const struct rg_technique *technique, struct rg_device *device,
                       const void *settings, int side, int frames)
{
    struct rg_picture picture = {0};
    struct rg_instance *instance = rg_instance_open(technique, device, settings, side, side);
    bool ok = instance;
    for (int i = 0; ok && i < frames; i++)
        ok = technique->step(instance) && technique->draw(instance);
    ok = ok && rg_frame_read_picture(instance, &picture);
    rg_picture_destroy(&picture);
    rg_instance_close(instance);
    return ok;
}

static bool draw(const char *name, int side, int frames, char **sets)
{
    const struct rg_technique *technique = rg_technique_find(name);
    struct rg_device *device = rg_device_open("cpu");
    void *defaults = technique ? rg_settings_create(technique) : NULL;
    bool ok = device && defaults;
    for (; ok && *sets; sets++) {
        void *settings = rg_settings_copy(technique, defaults, *sets);
        const int before = helpers();
        ok = settings && run_frames(technique, device, settings, side, frames);
        free(settings);
        if (ok && helpers() == before)
            ok = rg_error("%s: no two threads worked side by side: nothing was watched", *sets);
    }
    free(defaults);
    return ok && rg_device_close(device);
}

// Two pictures with a light of 40 times white; the second is slightly off.
static bool make_pictures(struct rg_picture pictures[2])
{
    for (int k = 0; k < 2; k++) {
        if (!rg_picture_create(&pictures[k], 300, 200, 4, "a picture"))
            return false;
        for (int i = 0; i < 300 * 200 * 4; i++)
            pictures[k].texels[i] = i % 4 == 3 ? 1 : i == 8 ? 40 : (float)(i % 1009 + k) / 1009;
    }
    return true;
}

static bool write_and_read(struct rg_picture pictures[2], const char *ending)
{
    char folder[] = "watched-XXXXXX", paths[2][32];
    const char *names[2] = {paths[0], paths[1]};
    struct rg_picture read[2] = {{0}};
    bool ok = mkdtemp(folder);
    for (int k = 0; ok && k < 2; k++) {
        snprintf(paths[k], sizeof(paths[k]), "%s/%d.%s", folder, k, ending);
        ok = rg_picture_write(paths[k], &pictures[k], &(struct rg_write_options){0});
    }
    ok = ok && rg_pictures_read(names, read, 2);
    for (int k = 0; k < 2; k++) {
        unlink(names[k]);
        rg_picture_destroy(&read[k]);
    }
    return !rmdir(folder) && ok;
}

static bool compare_pictures(void)
{
    struct rg_picture pictures[2] = {{0}};
    struct rg_comparison comparison = {0};
    const bool ok = make_pictures(pictures) &&
                    rg_compare(&pictures[0], "one", &pictures[1], "two", NULL,
                               &(struct rg_compare_options){.hdr_flip = true}, &comparison) &&
                    write_and_read(pictures, "exr") && write_and_read(pictures, "png");
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&pictures[0]);
    rg_picture_destroy(&pictures[1]);
    return ok;
}

static bool list_planted(void)
{
    for (int i = 0; planted_races[i].name; i++)
        puts(planted_races[i].name);
    return true;
}

static bool run_planted(const char *name, bool is_right)
{
    const struct planted *found = planted_races;
    while (found->name && strcmp(found->name, name) != 0)
        found++;
    if (!found->name && strcmp(planted_values.name, name) != 0)
        return false;
    (found->name ? found : &planted_values)->run(is_right);
    return true;
}

int main(int count, char **words)
{
    bool ok = false;
    if (count == 2 && strcmp(words[1], "pictures") == 0)
        ok = compare_pictures();
    else if (count == 2 && strcmp(words[1], "planted") == 0)
        ok = list_planted();
    else if (count == 4 && strcmp(words[1], "planted") == 0)
        ok = run_planted(words[2], strcmp(words[3], "right") == 0);
    else if (count > 4)
        ok = draw(words[1], atoi(words[2]), atoi(words[3]), words + 4);
    return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}
