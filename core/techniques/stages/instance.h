// An instance: a technique opened on a device. Its assets are buffers and images by name; its
// stages are kernels bound to assets by name.
//
// Assets and stages belong to the instance and are freed with it. After adding one has failed, with
// one logged line, adding does nothing. So a technique adds everything and checks once, at the end.
#ifndef RG_CORE_TECHNIQUES_STAGES_INSTANCE_H
#define RG_CORE_TECHNIQUES_STAGES_INSTANCE_H

#include "core/device/device.h"

enum { RG_MAX_ASSETS = 64, RG_MAX_STAGES = 48, RG_ASSET_NAME = 40, RG_STAGE_NAMES = 4 };
enum { RG_MAX_STATE = 8, RG_MAX_COUNTERS = 16, RG_MAX_FACTS = 24, RG_FACT_SIZE = 192 };
enum { RG_MAX_TEXTURES = 8 };

struct rg_instance;
struct rg_technique;

// A buffer or an image under the name that stages know it by (core/techniques/stages/assets.h).
struct rg_asset {
    char name[RG_ASSET_NAME];
    bool is_image;
    bool is_owned;      // destroyed with the instance
    bool is_shared;     // put back with the instance (core/device/shared.h)
    bool is_defined;    // it has been written, so that its contents are the same on all devices
    struct rg_buf *buf; // this or `image` is set; both NULL: made later
    struct rg_image *image;
    struct rg_extent items; // of a stage over it
};

// A row of a stage: a kernel, and the arguments of its runs (core/techniques/stages/stages.h).
// Names are those of assets.
struct rg_stage {
    const char *kernel;                               // NULL: none; running the stage does nothing
    bool (*when)(const struct rg_instance *instance); // false: not run; NULL: always run
    size_t params;    // offset of the kernel's parameters in the owner's struct
    const char *over; // the asset whose items a run has; NULL: one item, or the run's own
    // For DRAW programs: targets and draw state (struct rg_draw).
    const char *colour, *depth, *samples;
    enum rg_blend blend;
    enum rg_depth_mode depth_mode;
    enum rg_cull cull;
    int items_a_query;
    // A slot is bound to the asset of its own name, unless it is listed here.
    struct {
        const char *slot, *asset;
    } named[RG_STAGE_NAMES];
};

// An opened stage.
struct rg_opened_stage {
    struct rg_stage row;
    const void *owner;    // the struct with the parameters
    struct rg_pass *pass; // NULL: not run
    bool owns_pass;       // stages of one kernel share a pass
    struct rg_asset *slots[RG_MAX_SLOTS];
    struct rg_asset *over, *colour, *depth, *samples;
    struct rg_draw drawn; // draw state of its last run
    struct rg_extent ran; // and that run's items
};

// An asset that is part of the simulation's state, which `verify` compares byte by byte. `row` and
// `margin` name an element in a message: (index % row - margin, index / row - margin). The reader
// of the contents sets `words` (rg_asset_words).
struct rg_state {
    const char *name;
    const struct rg_asset *asset; // a buffer
    int row;                      // elements in a row; 0: a plain list
    int margin;                   // elements before the first of a row, and rows before the first
    const char *words;            // kinds of an element's words (enum rg_word); NULL: not known
};

// An exact count of work since the instance was opened.
struct rg_counter {
    const char *name; // "drops", "texels_simulated"
    int64_t value;
};

// A fact about an instance's inputs that a reader of results needs: which model was used, its hash,
// its number of faces. A table that prints a number of the same name shows both side by side.
struct rg_fact {
    const char *name;        // "model", "faces"
    char text[RG_FACT_SIZE]; // UTF-8; "": the fact is the number
    double number;
};

// An input image of an instance. Tables of textures report the sizes of its levels.
struct rg_texture {
    const char *name; // "environment"
    const struct rg_image *image;
    int first_level; // the level of the whole texture that is level 0 here; 0 unless it is reduced
};

struct rg_instance {
    const struct rg_technique *technique;
    struct rg_device *device;
    int64_t frame;           // frames simulated
    struct rg_image *target; // the asset "target": RGBA16F, linear, row 0 on top
    bool has_failed;         // adding an asset or stage failed
    int asset_count;
    struct rg_asset assets[RG_MAX_ASSETS];
    int stage_count;
    struct rg_opened_stage stages[RG_MAX_STAGES];
    int state_count;
    struct rg_state state[RG_MAX_STATE];
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS]; // of the current frame
    int texture_count;
    struct rg_texture textures[RG_MAX_TEXTURES]; // for the instance's life
    // Called after each stage that ran, to measure or compare stages; may be NULL.
    void (*after_stage)(const struct rg_opened_stage *stage, void *user);
    void *user;
};

// Names the counters, which start at 0. `names` must outlive the instance.
void rg_add_counters(struct rg_instance *instance, const char *const *names, int count);
// Adds a fact: a number, or a text formatted as by printf. The fact may be changed later.
struct rg_fact *rg_tell(struct rg_instance *instance, const char *name, double number);
struct rg_fact *rg_tell_text(struct rg_instance *instance, const char *name, const char *format,
                             ...) __attribute__((format(printf, 3, 4)));
// Lists an image among the instance's textures.
void rg_tell_texture(struct rg_instance *instance, const char *name, const struct rg_image *image,
                     int first_level);

#endif
