#include "harness/measure/expected.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/image/compare/compare.h"

bool rg_expected_read(struct rg_expected *expected, struct rg_session *session)
{
    expected->device = rg_session_device(session)->info;
    expected->texels = rg_session_read(session, &expected->size);
    return expected->texels && rg_session_picture(session, expected->texels, &expected->picture);
}

bool rg_expected_shows_rain(const struct rg_expected *expected, bool *shows)
{
    const struct rg_picture *picture = &expected->picture;
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    uint8_t *codes = rg_alloc(pixels, 8, "pictures");
    if (!codes)
        return false;
    rg_encode(picture, 1.0f, codes);
    rg_encode(&expected->dry, 1.0f, codes + pixels * 4);
    *shows = rg_shows_rain(codes, codes + pixels * 4, (int64_t)pixels);
    free(codes);
    return true;
}

void rg_expected_free(struct rg_expected *expected)
{
    rg_picture_destroy(&expected->picture);
    rg_picture_destroy(&expected->dry);
    free(expected->texels);
    *expected = (struct rg_expected){0};
}
