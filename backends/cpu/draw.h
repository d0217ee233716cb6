// Drawing on cpu. cpu:reference has plain loops of its own in draw/reference_tmpl.h.
//
// A run goes in rounds of two steps, each on all cores:
//   1. Items, in chunks (draw/emit.c): a batch of items becomes snapped corners. Those that cover
//      pixels become primitives, each with a number, a record and a reference for every tile of the
//      target that it touches. A chunk sorts its references by tile.
//   2. Tiles (draw/shade_tmpl.h): each walks the chunks in order, so that primitives reach a pixel
//      in the order of their items, whichever thread made them. Different pixels of many primitives
//      are listed, and their fragments computed, tested and blended side by side.
// A round ends when the memory for primitives or references is full (draw/bins.c).
//
// Five loops depend on the program, seven with lights (draw/stages_tmpl.h); they are compiled for
// each program and level. Vectorised code that does not depend on it is in draw/raster.c, compiled
// for each level.
#ifndef RG_BACKENDS_CPU_DRAW_H
#define RG_BACKENDS_CPU_DRAW_H

#include "backends/cpu/draw/program.h"

struct cpu_device;
struct rg_counts;

// draw.c: runs a program. False, and one logged line, when memory runs out.
bool cpu_draw(struct cpu_device *device, const char *name, const struct cpu_program *program,
              const struct cpu_call *call);

// Counts the work of the same items by plain loops.
void cpu_count(const struct cpu_program *program, const struct cpu_call *call,
               struct rg_counts *counts);

#endif
