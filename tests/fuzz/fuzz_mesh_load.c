// The whole path of a user: a file, the importer's process, a mesh. Whatever happens to the
// importer, the result is a sound mesh or one line. Some hundred files a second at best.
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *path = fuzz_write(fuzz_name(data, size), data, size);
    fuzz_listen();
    fuzz_judge(rg_mesh_load(path));
    return 0;
}
