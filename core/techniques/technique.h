// A technique: one paper's simulation and rendering, written once for all backends.
//
// A frame is a step of the simulation, then a drawing. Both run their stages in one order, which is
// the same on all devices.
#ifndef RG_CORE_TECHNIQUES_TECHNIQUE_H
#define RG_CORE_TECHNIQUES_TECHNIQUE_H

#include "core/techniques/stages/assets.h"
#include "core/techniques/stages/frame.h"
#include "core/techniques/stages/instance.h"
#include "core/techniques/stages/layer.h"
#include "core/techniques/params.h"
#include "core/techniques/stages/stages.h"

struct rg_proof;

// A level of a texture as a technique makes it, with the same texels that its kernels sample. It is
// valid during the call.
struct rg_made_texture {
    const char *name; // "splash-steep-1"
    int row, column;  // its place on a sheet with all textures
    int level, side_px;
    bool is_paint;         // premultiplied linear light; if false, grey display values
    const uint32_t *words; // RGBA8, row 0 on top
};

// Receives a texture. False, with one logged line, on failure, which ends the sequence.
typedef bool rg_take_texture(void *user, const struct rg_made_texture *texture);

// The picture that shows a technique best.
struct rg_shown {
    const char *settings; // "key=value key=value"; "": the defaults
    int width, height;    // pixels
    int frame;
    double exposure; // of 8-bit images
};

struct rg_technique {
    const char *name;  // "flow"
    const char *paper; // key of the paper: "stuppacher"; "" for none
    const char *about; // one line
    struct rg_shown shown;
    const struct rg_param_table *params;
    const struct rg_proof *proof; // core/techniques/proof.h
    size_t size;                  // of its instance struct, which begins with struct rg_instance
    size_t settings;              // offset of the copy of the settings in that struct

    // Adds assets and stages to an instance and readies it for its first step. Its struct is zeroed
    // except for settings, device and target. False, with one logged line, on failure;
    // rg_instance_close follows.
    bool (*open)(struct rg_instance *instance);
    // Frees everything that is neither asset nor stage, also after `open` failed at any point.
    // NULL: there is nothing.
    void (*close)(struct rg_instance *instance);
    // Simulates one frame.
    bool (*step)(struct rg_instance *instance);
    // Draws the current state into instance->target.
    bool (*draw)(struct rg_instance *instance);
    // Calls `take` for each level of each generated texture, all levels of one from the finest on,
    // then the next; `raingauge atlas` writes them to files. NULL: there is none. False, with one
    // logged line, on failure.
    bool (*make_textures)(rg_take_texture *take, void *user);
};

// The technique of this name, or NULL; and all techniques, NULL-terminated, which the build
// generates from the list in meson.build.
const struct rg_technique *rg_technique_find(const char *name);
extern const struct rg_technique *const rg_techniques[];

// Opens a technique on a device with a target of width x height pixels, at frame 0. `settings` is
// copied. NULL, with one logged line, on failure; also if it would need more memory than is allowed
// (core/base/memory.h), and then it has taken none.
struct rg_instance *rg_instance_open(const struct rg_technique *technique, struct rg_device *device,
                                     const void *settings, int width, int height);
// The bytes of buffers and images that an instance takes on the device after its first frame, found
// by opening, stepping and drawing with objects that are only counted. If the technique fails on
// contents of zeroes, the result is the bytes asked for until then.
int64_t rg_instance_bytes(const struct rg_technique *technique, struct rg_device *device,
                          const void *settings, int width, int height);
// Frees the instance with its assets and stages; NULL is accepted.
void rg_instance_close(struct rg_instance *instance);

// Settings with all defaults; the caller frees them. NULL, with one logged line, when memory runs
// out.
void *rg_settings_create(const struct rg_technique *technique);
// A copy of settings with the assignments "key=value key=value" applied; the caller frees it. NULL,
// with one logged line, where one is refused.
void *rg_settings_copy(const struct rg_technique *technique, const void *settings,
                       const char *assignments);

#endif
