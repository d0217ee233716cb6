// Rain as a layer of its own: light gathers there from black, in single precision, and is blended
// over its background once. Blending in halves would lose each faint drop, and so would a bright
// background.
//
//   rg_layer_begin(&layer) && ... stages with .colour = RG_LAYER and .blend = RG_BLEND_OVER ... &&
//   rg_layer_meet(&layer)
#ifndef RG_CORE_TECHNIQUES_STAGES_LAYER_H
#define RG_CORE_TECHNIQUES_STAGES_LAYER_H

#include "core/techniques/stages/instance.h"
#include "kernels/scenery/layer/params.h"

#define RG_LAYER      "layer"      // the asset that rain is blended into: RGBA32F, premultiplied
#define RG_BACKGROUND "background" // the picture behind the layer: RGBA16F

struct rg_layer {
    struct rg_instance *instance;
    struct rg_asset *light, *background; // of the target's size
    layer_params params;
    int stage;
};

// Adds both images and the stage that lays one over the other, onto the target. `layer` must
// outlive the instance's last frame. False, and one logged line, on failure.
bool rg_layer_open(struct rg_layer *layer, struct rg_instance *instance);
// Makes the layer black and clear.
bool rg_layer_begin(const struct rg_layer *layer);
// Lays the layer over the background; the target gets the result, each number rounded to the
// nearest half.
bool rg_layer_meet(const struct rg_layer *layer);

#endif
