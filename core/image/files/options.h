// Options for writing a picture.
#ifndef RG_CORE_IMAGE_FILES_OPTIONS_H
#define RG_CORE_IMAGE_FILES_OPTIONS_H

#include <stdbool.h>

// Zeroed: half floats for EXR and TIFF, exposure 1.
struct rg_write_options {
    bool full_float; // EXR and TIFF: 32-bit floats, which keep every bit, instead of half floats
    float exposure;  // PNG: factor of linear colours before clamping and sRGB encoding; 0: 1
};

#endif
