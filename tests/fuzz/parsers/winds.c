// Files of winds, and the wind at some times.
#include <math.h>

#include "core/techniques/cartoon/rain/settings.h"
#include "core/techniques/cartoon/rain/wind.h"
#include "tests/fuzz/heard.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_write("fuzz.txt", data, size);
    struct cartoon_wind_script script;
    const struct cartoon_rain_settings settings = {.wind = CARTOON_WIND_SCRIPT};
    fuzz_listen();
    const bool taken = cartoon_wind_read(path, &script);
    fuzz_judge_lines(taken, 0);
    for (int i = 0; taken && i < 2 * script.count; i++) {
        const struct cartoon_wind_knot *knot = &script.knots[i / 2];
        double wind_m_s[2];
        cartoon_wind_at(&settings, &script, 1, knot->time_s + i % 2 * 0.5, wind_m_s);
        if (!isfinite(wind_m_s[0]) || !isfinite(wind_m_s[1]))
            fuzz_complain("a wind that is no number");
    }
    return 0;
}
