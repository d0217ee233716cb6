// KTX cube maps in this process.
#include "core/scene/environment/ktx.h"
#include "tests/fuzz/heard.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_write("fuzz.ktx", data, size);
    fuzz_listen();
    struct rg_environment *environment = rg_ktx_read(path);
    fuzz_judge_lines(environment, 0);
    rg_environment_destroy(environment);
    return 0;
}
