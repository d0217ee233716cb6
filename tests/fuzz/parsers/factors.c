// The text files of the original streak database, each both as one view's and as that of all views.
#include <math.h>

#include "core/scene/atlas/cave/factors.h"
#include "tests/fuzz/heard.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct rg_cave_factors of_view;
    static float of_all[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS];
    const char *path = fuzz_write("fuzz.txt", data, size);
    struct rg_cave_why why = {""};
    fuzz_listen();
    if (!rg_cave_point_factors(path, 0, &of_view, &why) && !*why.text)
        fuzz_complain("refused without a word");
    why.text[0] = 0;
    if (!rg_cave_env_factors(path, of_all, &why) && !*why.text)
        fuzz_complain("refused without a word");
    fuzz_judge_lines(true, 0);
    return 0;
}
