// A technique: one paper's simulation and rendering, written once for all backends.
//
// A frame is a step of the simulation and a drawing of it. Both run their stages in one order, the
// same on all devices.
#ifndef RG_CORE_TECHNIQUES_TECHNIQUE_H
#define RG_CORE_TECHNIQUES_TECHNIQUE_H

#include "core/techniques/stages/assets.h"
#include "core/techniques/stages/frame.h"
#include "core/techniques/stages/instance.h"
#include "core/techniques/params.h"
#include "core/techniques/stages/stages.h"

struct rg_proof;

// A level of a texture as a technique makes it: the very texels that its kernels sample. They last
// for the call.
struct rg_made_texture {
    const char *name; // "splash-steep-1"
    int row, column;  // its place on a sheet of all
    int level, side_px;
    bool is_paint;         // premultiplied linear light; else grey of display values
    const uint32_t *words; // RGBA8, row 0 on top
};

// Takes a texture. False, with one logged line, where it cannot; no other follows then.
typedef bool rg_take_texture(void *user, const struct rg_made_texture *texture);

struct rg_technique {
    const char *name;  // "flow"
    const char *paper; // key of the paper: "stuppacher"; "" for none
    const char *about; // one line
    const struct rg_param_table *params;
    const struct rg_proof *proof; // core/techniques/proof.h
    size_t size;                  // of its struct, which begins with struct rg_instance
    size_t settings;              // where in it a copy of the settings lies

    // Adds assets and stages to an instance whose struct is zeroed but for the settings, the device
    // and the target, and makes it ready for its first step. False, with one logged line, on
    // failure; rg_instance_close follows.
    bool (*open)(struct rg_instance *instance);
    // Frees what is neither asset nor stage, of an instance that may have failed to open anywhere.
    // NULL: there is nothing.
    void (*close)(struct rg_instance *instance);
    // Simulates one frame.
    bool (*step)(struct rg_instance *instance);
    // Draws the present state into instance->target.
    bool (*draw)(struct rg_instance *instance);
    // Hands over each level of each texture that it generates, the levels of one after the other
    // from the finest on; `raingauge atlas` writes them as files. NULL: there is none. False, with
    // one logged line, on failure.
    bool (*make_textures)(rg_take_texture *take, void *user);
};

// The technique of this name, or NULL. All of them, NULL-terminated, made by the build from the
// list in meson.build.
const struct rg_technique *rg_technique_find(const char *name);
extern const struct rg_technique *const rg_techniques[];

// Opens a technique on a device with a target of width x height pixels, at frame 0. `settings` is
// copied. NULL, with one logged line, on failure; also where it needs more memory than is allowed
// (core/base/memory.h), of which none is held then.
struct rg_instance *rg_instance_open(const struct rg_technique *technique, struct rg_device *device,
                                     const void *settings, int width, int height);
// What an instance takes on the device once its first frame is drawn, in bytes of buffers and
// images: opened, stepped and drawn without any of them, from the same sizes. Where the technique
// does not get on with contents of zeroes, it is what it has asked for until then.
int64_t rg_instance_bytes(const struct rg_technique *technique, struct rg_device *device,
                          const void *settings, int width, int height);
// Frees the instance with its assets and stages; NULL is accepted.
void rg_instance_close(struct rg_instance *instance);

// Settings with every default; the caller frees them. NULL, with one logged line, without memory.
void *rg_settings_create(const struct rg_technique *technique);
// A copy with these "key=value key=value" over it; the caller frees it. NULL, with one logged line,
// where one is refused.
void *rg_settings_copy(const struct rg_technique *technique, const void *settings,
                       const char *assignments);

#endif
