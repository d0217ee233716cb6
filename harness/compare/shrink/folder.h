// The kernel folder of a case: one run of a compute shader, or one draw, for a driver's developer
// who does not have raingauge.
#ifndef RG_HARNESS_COMPARE_SHRINK_FOLDER_H
#define RG_HARNESS_COMPARE_SHRINK_FOLDER_H

#include "harness/compare/shrink/culprit.h"

// Writes the folder CASE.kernel: the kernel as SPIR-V, GLSL and OpenCL C, or the stages of a draw;
// each slot's inputs and expected results; kernel.txt, which describes them; a program that runs
// and compares the kernel; and a README with `note`, one line. Either writes all files and removes
// others of an earlier case, or writes none. False, and one logged line, on failure.
bool rg_kernel_folder_write(const char *path, const struct rg_culprit *culprit, const char *note,
                            struct rg_device *device, const struct rg_device *truth);

// The command that builds and runs its program: with OpenGL for a draw on such a device, else with
// Vulkan.
const char *rg_kernel_folder_command(const struct rg_culprit *culprit,
                                     const struct rg_device *device);

// Removes the folder of an earlier case of this name, as far as rg_kernel_folder_write made it.
void rg_kernel_folder_remove(const char *path);

#endif
