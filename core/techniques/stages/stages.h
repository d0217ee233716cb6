// An instance's stages: rows of a table, each with a kernel and the assets bound to it, by name.
// The order in which they run is plain C, in the technique's step and draw.
//
//   static const struct rg_stage stages[STAGES] = {
//       [MOVE] = {"drops_move", .params = AT(move), .over = "drops"},
//       [SHOW] = {"drops_show", .params = AT(view), .over = "drops", .colour = "target"},
//   };
#ifndef RG_CORE_TECHNIQUES_STAGES_STAGES_H
#define RG_CORE_TECHNIQUES_STAGES_STAGES_H

#include "core/techniques/stages/instance.h"

// Opens stages; returns the index of the first, the others follow in order, or -1 on failure.
// `owner` is the struct that holds the rows' parameters, and must outlive the last run. A slot is
// bound to the asset of its name, or of the name in the row: "scope.name" if there is one, else
// "name"; `scope` may be NULL. It refuses, with one logged line, a name that no asset has, an asset
// of another kind or format, and a slot that the kernel lacks.
int rg_open_stages(struct rg_instance *instance, const struct rg_stage *rows, int count,
                   const void *owner, const char *scope);

// Runs a stage over its row's items; does nothing if the stage was not opened. False, with one
// logged line, on failure.
bool rg_stage(struct rg_instance *instance, int stage);
// The same over other items, or onto another target unless `draw` is NULL.
bool rg_stage_over(struct rg_instance *instance, int stage, struct rg_extent origin,
                   struct rg_extent extent);
bool rg_stage_onto(struct rg_instance *instance, int stage, int items, const struct rg_draw *draw);

// Whether running the stage does anything.
bool rg_stage_runs(const struct rg_instance *instance, int stage);
// The row's draw state, with which runs can be made; all but the images may be changed.
struct rg_draw rg_stage_draw(const struct rg_instance *instance, int stage);
// Whether the last run of a stage wrote an asset.
bool rg_stage_wrote(const struct rg_opened_stage *stage, const struct rg_asset *asset);

// The kinds of a buffer's words (struct rg_slot_info), by the slots that it is bound to. Slots of
// `by`, the stage that wrote it, come first; `by` may be NULL. NULL if no slot tells.
const char *rg_asset_words(const struct rg_instance *instance, const struct rg_opened_stage *by,
                           const struct rg_asset *asset);

// Destroys all stages' passes.
void rg_stages_free(struct rg_instance *instance);

#endif
