// Runs the shaders here as kernel.txt describes, and compares their results with the expected ones.
// Exit status: 0 equal, 1 different, 2 something failed, 77 no such device.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAIL(status, ...) exit((fprintf(stderr, __VA_ARGS__), status))
#define EACH_SLOT for (struct slot *s = slots; s < slots + count; s++)
static struct slot { // a line of kernel.txt
    unsigned at, type, format, aspect, texel, width, height, layers, levels, view_type, filter, wrap, compare, size;
    char before[64], expected[64]; // files; "-": the slot is not written
    unsigned char *bytes;          // of a buffer, or of an image's texels
} slots[16];
static unsigned count, constants[2], items; // also of kernel.txt; items are of a draw

static void *read_code(const char *path, size_t *size) { // the whole file
    FILE *file = fopen(path, "rb");
    const long end = file && !fseek(file, 0, SEEK_END) ? ftell(file) : -1;
    void *bytes = end > 0 ? calloc(1, *size = (size_t)end) : NULL;
    if (!bytes || fseek(file, 0, SEEK_SET) || fread(bytes, 1, *size, file) != *size || fclose(file)) FAIL(2, "%s: cannot be read\n", path);
    return bytes;
}

static void read_parts(const char *path, unsigned char *bytes, size_t size) { // only the parts in the file; other bytes stay
    unsigned part[2]; // offset and size in bytes
    FILE *file = fopen(path, "rb");
    for (size_t head; file && (head = fread(part, 1, sizeof(part), file));)
        if (head != sizeof(part) || part[0] > size || part[1] > size - part[0] || fread(bytes + part[0], 1, part[1], file) != part[1])
            FAIL(2, "%s: a part of it is cut off, or ends after the slot\n", path);
    if (!file || fclose(file)) FAIL(2, "%s: cannot be read\n", path);
}

