#include "harness/measure/expected.h"

#include <stdlib.h>

#include "harness/frames/frame.h"

bool rg_expected_read(struct rg_expected *expected, struct rg_instance *instance)
{
    expected->texels = rg_frame_read(instance, &expected->size);
    return expected->texels && rg_frame_picture(instance, expected->texels, &expected->picture);
}

void rg_expected_free(struct rg_expected *expected)
{
    rg_picture_destroy(&expected->picture);
    rg_picture_destroy(&expected->dry);
    free(expected->texels);
    *expected = (struct rg_expected){0};
}
