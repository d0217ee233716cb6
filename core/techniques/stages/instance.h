// An instance: a technique opened on a device. What it works on are assets, buffers and images by
// name; what it runs are stages, kernels bound to assets by name.
//
// Assets and stages belong to the instance and go with it. When adding one fails, one line is
// logged, and from then on adding does nothing. So a technique adds all that it needs, and asks
// once, at the end, whether all is there.
#ifndef RG_CORE_TECHNIQUES_STAGES_INSTANCE_H
#define RG_CORE_TECHNIQUES_STAGES_INSTANCE_H

#include "core/device/device.h"

enum { RG_MAX_ASSETS = 64, RG_MAX_STAGES = 48, RG_ASSET_NAME = 40, RG_STAGE_NAMES = 4 };
enum { RG_MAX_STATE = 8, RG_MAX_COUNTERS = 16, RG_MAX_FACTS = 20, RG_FACT_SIZE = 192 };
enum { RG_MAX_TEXTURES = 8 };

struct rg_instance;
struct rg_technique;

// A buffer or an image under the name that stages know it by (core/techniques/stages/assets.h).
struct rg_asset {
    char name[RG_ASSET_NAME];
    bool is_image;
    bool is_owned;      // destroyed with the instance
    bool is_defined;    // it has been written, so that its contents are the same on all devices
    struct rg_buf *buf; // this or `image`, whichever it is; both NULL: it is made later
    struct rg_image *image;
    struct rg_extent items; // of a stage that goes over it
};

// One row a stage: a kernel, and what it is run with (core/techniques/stages/stages.h). Names are
// those of assets.
struct rg_stage {
    const char *kernel; // NULL: none, and running the stage does nothing
    bool (*when)(const struct rg_instance *instance); // false: it does nothing; NULL: always
    size_t params;    // where the kernel's parameters lie in the owner's struct
    const char *over; // a run's items are this asset's; NULL: one item, or what the run says
    // Of a DRAW program: what it draws onto, and how (struct rg_draw).
    const char *colour, *depth, *samples;
    enum rg_blend blend;
    enum rg_depth_mode depth_mode;
    enum rg_cull cull;
    int items_a_query;
    // A slot is bound to the asset of its own name, but for these.
    struct {
        const char *slot, *asset;
    } named[RG_STAGE_NAMES];
};

// A stage as it was opened.
struct rg_opened_stage {
    struct rg_stage row;
    const void *owner;    // of the parameters
    struct rg_pass *pass; // NULL: not run
    bool owns_pass;       // stages of one kernel share a pass
    struct rg_asset *slots[RG_MAX_SLOTS];
    struct rg_asset *over, *colour, *depth, *samples;
    struct rg_draw drawn; // how its last run drew
    struct rg_extent ran; // and over how many items it was
};

// An asset that is part of the simulation's state: what `verify` compares byte by byte. `row` and
// `margin` name an element in a message: (index % row - margin, index / row - margin). `words` is
// told by whoever reads the contents (rg_asset_words).
struct rg_state {
    const char *name;
    const struct rg_asset *asset; // a buffer
    int row;                      // elements a row; 0: a plain list
    int margin;                   // elements before the first of a row, and rows before the first
    const char *words;            // what an element's are (enum rg_word); NULL: not known
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

struct rg_instance {
    const struct rg_technique *technique;
    struct rg_device *device;
    int64_t frame;           // frames simulated
    struct rg_image *target; // the asset "target": RGBA16F, linear, row 0 on top
    bool has_failed;         // adding something did
    int asset_count;
    struct rg_asset assets[RG_MAX_ASSETS];
    int stage_count;
    struct rg_opened_stage stages[RG_MAX_STAGES];
    int state_count;
    struct rg_state state[RG_MAX_STATE];
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS]; // true of the present frame
    int texture_count;
    struct rg_texture textures[RG_MAX_TEXTURES]; // for as long as the instance lives
    // Called after each stage that ran, by those who measure or compare stages; NULL for nobody.
    void (*after_stage)(const struct rg_opened_stage *stage, void *user);
    void *user;
};

// Names the counters, which begin at 0. `names` outlive the instance.
void rg_add_counters(struct rg_instance *instance, const char *const *names, int count);
// Tells a fact; a number, or a text in printf's way. The fact may be changed later.
struct rg_fact *rg_tell(struct rg_instance *instance, const char *name, double number);
struct rg_fact *rg_tell_text(struct rg_instance *instance, const char *name, const char *format,
                             ...) __attribute__((format(printf, 3, 4)));
// Tells of an image among the assets.
void rg_tell_texture(struct rg_instance *instance, const char *name, const struct rg_image *image,
                     int first_level);

#endif
