// How cpu draws, apart from cpu:reference, whose plain loops are in draw/reference_tmpl.h.
//
// A run goes in rounds of two steps, each on all cores:
//   1. Items, in chunks (draw/emit.c): a batch of items becomes snapped corners; those that cover
//      pixels become primitives, which have a number, a record and, for every tile of the target
//      that they touch, a reference. A chunk sorts its references by tile.
//   2. Tiles (draw/shade_tmpl.h): each walks the chunks in order, so that primitives meet a pixel
//      in the order of their items, whoever made them. Different pixels of many primitives are
//      listed, and their fragments computed, tested and blended side by side.
// A round ends where the room for primitives or references does (draw/bins.c).
//
// What depends on the program are five loops, and two more with lights (draw/stages_tmpl.h),
// compiled once a program and level. What does not, but is worth vectors, is in draw/raster.c,
// compiled once a level.
#ifndef RG_BACKENDS_CPU_DRAW_H
#define RG_BACKENDS_CPU_DRAW_H

#include "backends/cpu/draw/program.h"

struct cpu_device;
struct rg_counts;

// draw.c: a run of a program. False, and one logged line, where memory is missing.
bool cpu_draw(struct cpu_device *device, const char *name, const struct cpu_program *program,
              const struct cpu_call *call);

// What it comes to, from the same items by plain loops.
void cpu_count(const struct cpu_program *program, const struct cpu_call *call,
               struct rg_counts *counts);

#endif
