// The folder beside a case: one run of a compute shader that a driver's developer needs nothing of
// raingauge for.
#ifndef RG_HARNESS_COMPARE_SHRINK_FOLDER_H
#define RG_HARNESS_COMPARE_SHRINK_FOLDER_H

#include "harness/compare/shrink/culprit.h"

// Writes a folder, whose name is the case's with .kernel behind it: SPIR-V, GLSL and, of a device
// of OpenCL, OpenCL C; what lies in each slot before and is expected after; kernel.txt, which says
// what is what; a program that runs and compares it; and a README, with `note`, one line. All files
// are there or none; those of an earlier case are removed then. False, and one logged line, on
// failure.
bool rg_kernel_folder_write(const char *path, const struct rg_culprit *culprit, const char *note,
                            struct rg_device *device, const struct rg_device *truth);

// Removes the folder of an earlier case of this name, as far as rg_kernel_folder_write made it.
void rg_kernel_folder_remove(const char *path);

#endif
