// HDR, TIFF and EXR pictures on the whole path: a file, the reader's process in its cage, the check
// of its reply. Whatever happens to OpenImageIO, the result is a picture or one line.
#include <string.h>

#include "core/base/memory.h"
#include "core/image/files/io.h"
#include "tests/fuzz/heard.h"

enum { MOST_BYTES = 256 << 20 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool is_hdr = size > 2 && !memcmp(data, "#?", 2);
    const bool is_exr = size > 4 && !memcmp(data, "v/1\1", 4);
    const char *name = is_hdr ? "fuzz.hdr" : is_exr ? "fuzz.exr" : "fuzz.tif";
    const char *path = fuzz_write(name, data, size);
    struct rg_picture picture;
    rg_memory_allow(MOST_BYTES); // a display window promises more than its file has
    fuzz_listen();
    const bool taken = rg_picture_read(path, &picture);
    fuzz_judge_lines(taken, 2);
    if (taken)
        rg_picture_destroy(&picture);
    return 0;
}
