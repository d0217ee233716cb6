// HDR and TIFF pictures on the whole path: a file, the reader's process in its cage, the check of
// its reply. Whatever happens to OpenImageIO, there is a picture or one line.
#include <string.h>

#include "core/image/files/io.h"
#include "tests/fuzz/heard.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool is_hdr = size > 2 && !memcmp(data, "#?", 2);
    const char *path = fuzz_write(is_hdr ? "fuzz.hdr" : "fuzz.tif", data, size);
    struct rg_picture picture;
    fuzz_listen();
    const bool taken = rg_picture_read(path, &picture);
    fuzz_judge_lines(taken, 1);
    if (taken)
        rg_picture_destroy(&picture);
    return 0;
}
