#include "harness/devices/measure/expected.h"

#include <stdlib.h>

#include "core/image/compare/compare.h"

bool rg_expected_read(struct rg_expected *expected, struct rg_session *session)
{
    expected->device = rg_session_device(session)->info;
    expected->texels = rg_session_read(session, &expected->size);
    return expected->texels && rg_session_picture(session, expected->texels, &expected->picture);
}

bool rg_expected_shows_rain(const struct rg_expected *expected, bool *shows)
{
    return rg_picture_shows_rain(&expected->picture, &expected->dry, 1.0f, shows);
}

void rg_expected_free(struct rg_expected *expected)
{
    rg_picture_destroy(&expected->picture);
    rg_picture_destroy(&expected->dry);
    free(expected->texels);
    *expected = (struct rg_expected){0};
}
