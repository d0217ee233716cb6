// The functions of the OpenImageIO module: plain C, and no exception leaves them. oiio.c loads the
// module on first use.
#ifndef RG_CORE_IMAGE_FILES_OIIO_H
#define RG_CORE_IMAGE_FILES_OIIO_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// OpenImageIO's ImageBufAlgo::compare: differences of the values of two pictures of one shape.
struct rg_oiio_comparison {
    double mean, rms, psnr_db, max;
    int max_x, max_y, max_channel;
    int64_t pixels_failing, pixels_warning;
};

struct rg_oiio_functions {
    // `format`: "hdr", "tiff" (half floats), "tiff-float".
    bool (*write)(const char *path, const char *format, int width, int height, int channels,
                  const float *texels, char *why, int why_size);
    bool (*compare)(const float *a, const float *b, int width, int height, int channels,
                    float fail_threshold, float warn_threshold,
                    struct rg_oiio_comparison *comparison);
};

#ifdef __cplusplus
}
#endif

// The module's functions; NULL when it cannot be loaded, with the loader's reason in `why`.
// Safe from any thread.
const struct rg_oiio_functions *rg_oiio(char *why, int why_size);

#endif
