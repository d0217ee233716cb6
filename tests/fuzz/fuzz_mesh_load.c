// The whole path as users take it: a file, the importer's process, a mesh. Whatever happens to the
// importer, there is a sound mesh or one line. Some hundred files a second at best.
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/fuzz/fuzz.h"

static char folder[] = "/tmp/raingauge-fuzz-XXXXXX";

static void remove_folder(void)
{
    rmdir(folder);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static int ready;
    char path[256];
    if (!ready && (!mkdtemp(folder) || atexit(remove_folder)))
        abort();
    ready = 1;
    snprintf(path, sizeof(path), "%s/%s", folder, fuzz_name(data, size));
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file))
        abort();
    fuzz_listen();
    fuzz_judge(rg_mesh_load(path));
    unlink(path);
    return 0;
}
