// A technique: one paper's simulation and rendering, written once for all backends.
//
// An instance is a technique opened on a device: its buffers, images and passes. A frame is a step
// of the simulation and a drawing of it, both lists of passes in one order for all devices.
#ifndef RG_CORE_TECHNIQUES_TECHNIQUE_H
#define RG_CORE_TECHNIQUES_TECHNIQUE_H

#include "core/device/device.h"
#include "core/techniques/params.h"

enum { RG_MAX_STATE = 8, RG_MAX_COUNTERS = 16, RG_MAX_FACTS = 12, RG_FACT_SIZE = 192 };
enum { RG_MAX_TEXTURES = 8 };

struct rg_instance;
struct rg_proof;

// A buffer that is part of the simulation's state: what `verify` compares byte by byte. The rest
// is there to name an element in a message: (index % row - margin, index / row - margin).
struct rg_state {
    const char *name;
    struct rg_buf *buf;
    bool is_float; // 4-byte floats, or uints
    int row;       // elements a row; 0: a plain list
    int margin;    // elements before the first of a row, and rows before the first
};

// An exact count of work since the instance was opened.
struct rg_counter {
    const char *name; // "drops", "texels_simulated"
    int64_t value;
};

// What a reader of a result must know of an instance's inputs: which model stood in, its hash, how
// many faces it has. Where a table prints a number of the same name, the two stand side by side.
struct rg_fact {
    const char *name;        // "model", "faces"
    char text[RG_FACT_SIZE]; // UTF-8; "": the fact is the number
    double number;
};

// An image that an instance reads its inputs from. Tables of textures tell the sizes of its levels.
struct rg_texture {
    const char *name; // "environment"
    const struct rg_image *image;
    int first_level; // of the whole texture, that the image's level 0 is: 0 unless it is reduced
};

struct rg_technique {
    const char *name;  // "flow"
    const char *paper; // key of the paper: "stuppacher"; "" for none
    const char *about; // one line
    const struct rg_param_table *params;
    const struct rg_proof *proof; // core/techniques/proof.h

    // Opens the technique on a device with a target of width x height pixels, at frame 0.
    // `settings` is copied. NULL, with one logged line, on failure.
    struct rg_instance *(*create)(struct rg_device *device, const void *settings, int width,
                                  int height);
    void (*destroy)(struct rg_instance *instance);
    // Simulates one frame.
    bool (*step)(struct rg_instance *instance);
    // Draws the present state into instance->target.
    bool (*draw)(struct rg_instance *instance);
};

struct rg_instance {
    const struct rg_technique *technique;
    struct rg_device *device;
    int64_t frame;           // frames simulated
    struct rg_image *target; // RGBA16F, linear, row 0 on top
    int state_count;
    struct rg_state state[RG_MAX_STATE]; // valid until the next step
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS]; // true of the present frame
    int texture_count;
    struct rg_texture textures[RG_MAX_TEXTURES]; // for as long as the instance lives
    // Called after each pass, with its name, by those who measure passes; NULL for nobody.
    void (*after_pass)(const char *pass, void *user);
    void *user;
};

// The technique of this name, or NULL. All of them, NULL-terminated, made by the build from the
// list in core/meson.build.
const struct rg_technique *rg_technique_find(const char *name);
extern const struct rg_technique *const rg_techniques[];

// Runs a pass of an instance and tells after_pass of it.
bool rg_instance_run(struct rg_instance *instance, struct rg_pass *pass, const struct rg_run *run);

// Settings with every default; the caller frees them. NULL, with one logged line, without memory.
void *rg_settings_create(const struct rg_technique *technique);
// A copy with these "key=value key=value" over it; the caller frees it. NULL, with one logged line,
// where one is refused.
void *rg_settings_copy(const struct rg_technique *technique, const void *settings,
                       const char *assignments);

#endif
