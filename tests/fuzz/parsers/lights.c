// Files of lights.
#include <math.h>

#include "core/scene/light_file.h"
#include "tests/fuzz/heard.h"

static bool is_sound(const struct rg_light *light)
{
    bool sound = isfinite(light->near_m) && light->inner_deg <= light->outer_deg;
    for (int i = 0; i < 3; i++)
        sound = sound && isfinite(light->position_m[i]) && isfinite(light->direction[i]) &&
                isfinite(light->colour[i]) && light->colour[i] >= 0;
    return sound;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_write("fuzz.json", data, size);
    struct rg_lights lights;
    fuzz_listen();
    const bool taken = rg_light_file_read(path, &lights);
    fuzz_judge_lines(taken, 0);
    for (int i = 0; taken && i < lights.count; i++)
        if (!is_sound(&lights.lights[i]))
            fuzz_complain("a light that cannot be");
    return 0;
}
