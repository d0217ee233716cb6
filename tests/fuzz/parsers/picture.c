// PNG and EXR pictures in this process, and the density maps made of them. A PNG's checksums are
// corrected first; otherwise nothing after them would be tried. An EXR for another process is
// refused, since it has no descriptors; caged.c tries those, a hundred times slower.
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include "core/base/memory.h"
#include "core/image/files/io.h"
#include "core/scene/density.h"
#include "tests/fuzz/heard.h"

enum { MOST_BYTES = 256 << 20 };

static uint32_t big_endian(const uint8_t *c)
{
    return (uint32_t)c[0] << 24 | (uint32_t)c[1] << 16 | (uint32_t)c[2] << 8 | c[3];
}

static void mend_checksums(uint8_t *bytes, size_t size)
{
    for (size_t at = 8; at + 12 <= size;) {
        const size_t length = big_endian(bytes + at);
        if (length > size - at - 12)
            return;
        const uint32_t sum = (uint32_t)crc32(0, bytes + at + 4, (uInt)length + 4);
        for (int i = 0; i < 4; i++)
            bytes[at + 8 + length + (size_t)i] = (uint8_t)(sum >> (24 - 8 * i));
        at += length + 12;
    }
}

// Reads with descriptors for the file and for the system's memory, but none for a process.
static bool read_here(const char *path, struct rg_picture *picture)
{
    const int lowest = dup(STDERR_FILENO);
    struct rlimit before, few;
    close(lowest);
    getrlimit(RLIMIT_NOFILE, &before);
    few = before;
    few.rlim_cur = (rlim_t)lowest + 2;
    setrlimit(RLIMIT_NOFILE, &few);
    const bool taken = rg_picture_read(path, picture);
    setrlimit(RLIMIT_NOFILE, &before);
    return taken;
}

static void judge(const char *path)
{
    struct rg_picture picture;
    rg_memory_allow(MOST_BYTES); // a display window promises more than its file has
    fuzz_listen();
    const bool taken = read_here(path, &picture);
    fuzz_judge_lines(taken, 2);
    if (!taken)
        return;
    if (picture.width < 1 || picture.height < 1 || picture.channels < 1 || picture.channels > 4)
        fuzz_complain("a picture of no size");
    fuzz_listen();
    struct rg_density *density = rg_density_from_picture(&picture, path);
    fuzz_judge_lines(density, 0);
    if (density && !(rg_density_mean(density) > 0))
        fuzz_complain("a density map that is black");
    rg_density_destroy(density);
    rg_picture_destroy(&picture);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const bool is_png = size > 8 && !memcmp(data, "\x89PNG", 4);
    uint8_t *bytes = malloc(size + 1);
    if (!bytes)
        return 0;
    memcpy(bytes, data, size);
    if (is_png && data[size - 1] % 8)
        mend_checksums(bytes, size);
    judge(fuzz_write(is_png ? "fuzz.png" : "fuzz.exr", bytes, size));
    free(bytes);
    return 0;
}
