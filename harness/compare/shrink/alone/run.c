// Runs the shaders here as kernel.txt describes, and compares their results with the expected ones.
// Exit status: 0 equal, 1 different, 2 something failed, 77 no such device.
// clang-format off
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAIL(status, ...) exit((fprintf(stderr, __VA_ARGS__), status))
#define EACH_SLOT for (struct slot *s = slots; s < slots + count; s++)
enum { SAMPLED_IMAGE = 1, STORED_IMAGE = 3, UNIFORM_BLOCK = 6, STORAGE_BUFFER = 7, TARGET = 10 }; // types of slots

static struct slot { // a line of kernel.txt
    unsigned at, type, format, aspect, texel, width, height, layers, levels, view_type, filter, wrap, compare, size;
    char before[64], expected[64]; // files; "-": the slot is not written
    unsigned char *bytes;          // of a buffer, or of an image's texels
} slots[16];
static unsigned count, groups[3], constants[2]; // also of kernel.txt
static struct { // of a draw there: the first item, how many, state, place in the targets
    unsigned first, items, blend, depth, cull, x, y, across, down, width, height, layer, level;
} draw;

// The API's part: opens the device of this number, and runs. Then slots hold the results.
static void open_device(unsigned index);
static void run(void);

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

static void read_manifest(FILE *file) {
    for (char line[512]; file && count < 16 && fgets(line, sizeof(line), file);) {
        struct slot *s = &slots[count];
        sscanf(line, "groups %u %u %u", &groups[0], &groups[1], &groups[2]);
        sscanf(line, "constants %u %u", &constants[0], &constants[1]);
        sscanf(line, "draw first %u items %u blend %u depth %u cull %u scissor %u %u %u %u target %u x %u layer %u level %u", &draw.first,
            &draw.items, &draw.blend, &draw.depth, &draw.cull, &draw.x, &draw.y, &draw.across, &draw.down, &draw.width, &draw.height,
            &draw.layer, &draw.level);
        count += sscanf(line, "slot %u type %u format %u aspect %u texel %u size %u x %u layers %u levels %u "
            "view %u filter %u wrap %u compare %u bytes %u %63s %63s",
            &s->at, &s->type, &s->format, &s->aspect, &s->texel, &s->width, &s->height, &s->layers, &s->levels,
            &s->view_type, &s->filter, &s->wrap, &s->compare, &s->size, s->before, s->expected) == 16;
    }
    if (!count || fclose(file)) FAIL(2, "kernel.txt: cannot be read; run this in its folder\n");
}

static int differs(const struct slot *s) {
    unsigned char *due = calloc(1, s->size);
    if (!due) FAIL(2, "there is no memory\n");
    read_parts(s->before, due, s->size);
    read_parts(s->expected, due, s->size);
    for (unsigned i = 0; i < s->size; i++)
        if (s->bytes[i] != due[i])
            return printf("slot %u: byte %u is %02x, not %02x as in %s\n", s->at, i, s->bytes[i], due[i], s->expected);
    return 0;
}

int main(int argc, char **argv) {
    int differing = 0;
    if (argc > 1 && (argc != 3 || strcmp(argv[1], "--device") || argv[2][strspn(argv[2], "0123456789")])) FAIL(2, "./run [--device N]\n");
    read_manifest(fopen("kernel.txt", "r"));
    open_device(argc == 3 ? (unsigned)atoi(argv[2]) : 0);
    run();
    EACH_SLOT differing |= *s->expected != '-' && differs(s);
    puts(differing ? "it differs" : "it is the same");
    return differing;
}
