// What an instance runs: stages, rows of a table each of which is a kernel with what it is bound
// to, by name. The order in which they run is plain C, in the technique's step and draw.
//
//   static const struct rg_stage stages[STAGES] = {
//       [MOVE] = {"drops_move", .params = AT(move), .over = "drops"},
//       [SHOW] = {"drops_show", .params = AT(view), .over = "drops", .colour = "target"},
//   };
#ifndef RG_CORE_TECHNIQUES_STAGES_STAGES_H
#define RG_CORE_TECHNIQUES_STAGES_STAGES_H

#include "core/techniques/stages/instance.h"

// Opens stages: the first is `return` of the call, the others follow in order. `owner` is the
// struct that rows say where in it their parameters lie; it outlives the instance's last run. A
// slot is bound to the asset of its name, or of the name that the row gives it: one of `scope`,
// "scope.name", if there is one, else "name"; `scope` may be NULL. A name that no asset has, an
// asset of another kind or format, or a slot that the kernel has not, is refused with one logged
// line. -1 on failure.
int rg_open_stages(struct rg_instance *instance, const struct rg_stage *rows, int count,
                   const void *owner, const char *scope);

// Runs a stage over the items of its row, if the stage was opened; else it does nothing. False,
// with one logged line, on failure.
bool rg_stage(struct rg_instance *instance, int stage);
// The same over items of its own, and, where `draw` is not NULL, onto another target.
bool rg_stage_over(struct rg_instance *instance, int stage, struct rg_extent origin,
                   struct rg_extent extent);
bool rg_stage_onto(struct rg_instance *instance, int stage, int items, const struct rg_draw *draw);

// Whether running it does something.
bool rg_stage_runs(const struct rg_instance *instance, int stage);
// What its row says of drawing; the caller may change all but the images, for runs to come.
struct rg_draw rg_stage_draw(const struct rg_instance *instance, int stage);
// Whether the last run of a stage wrote an asset.
bool rg_stage_wrote(const struct rg_opened_stage *stage, const struct rg_asset *asset);

// What the words of a buffer are (struct rg_slot_info), by the slots that it is bound to: those of
// `by` first, which has written it, or NULL. NULL where no slot tells.
const char *rg_asset_words(const struct rg_instance *instance, const struct rg_opened_stage *by,
                           const struct rg_asset *asset);

// Destroys all stages' passes.
void rg_stages_free(struct rg_instance *instance);

#endif
