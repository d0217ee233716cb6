#include "core/scene/atlas/cache.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/files/user.h"
#include "core/base/log.h"
#include "core/image/files/temporary.h"
#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/sample.h"

// The header of a file. `order` detects machines of the other byte order; raise `version` when the
// file's format changes.
struct header {
    char magic[8];
    uint32_t order, version, size, reserved;
    uint64_t sample; // hash of a small traced sample
    uint64_t hash;   // hash of the whole atlas
    float point_factor[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS][RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    float env_factor[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS];
    float splash_part[RG_ATLAS_MATERIALS][RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
};

enum { ORDER = 0x01020304, VERSION = 2 };

static const char magic[8] = {'r', 'g', '-', 'a', 't', 'l', 'a', 's'};

static bool because(char why[256], const char *format, ...) __attribute__((format(printf, 2, 3)));

static bool because(char why[256], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(why, 256, format, args);
    va_end(args);
    return false;
}

// --- paths ---

bool rg_atlas_cache_path(enum rg_atlas_size size, char path[RG_ATLAS_PATH_SIZE], char why[256])
{
    char name[64];
    snprintf(name, sizeof(name), "streaks-%s.atlas", rg_atlas_kinds[size].name);
    return rg_user_path(RG_USER_CACHE, name, path, RG_ATLAS_PATH_SIZE, why);
}

// --- reading a file ---

static enum rg_atlas_cached check_header(const struct header *header, enum rg_atlas_size size,
                                         char why[256])
{
    because(why, "it is no file of this kind");
    if (memcmp(header->magic, magic, sizeof(magic)))
        return RG_ATLAS_DAMAGED;
    because(why, "another version of raingauge wrote it");
    if (header->order != ORDER || header->version != VERSION || header->size != size)
        return RG_ATLAS_STALE;
    return header->sample == rg_atlas_sample(size) ? RG_ATLAS_SOUND : RG_ATLAS_STALE;
}

// Reads the texels; false unless the rest of the file has exactly the atlas's size and hash.
static bool read_texels(FILE *file, const struct header *header, struct rg_atlas *atlas,
                        char why[256])
{
    memcpy(atlas->point_factor, header->point_factor, sizeof(atlas->point_factor));
    memcpy(atlas->env_factor, header->env_factor, sizeof(atlas->env_factor));
    memcpy(atlas->splash_part, header->splash_part, sizeof(atlas->splash_part));
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++) {
        const size_t count = rg_atlas_image_texels(&atlas->images[part]);
        if (fread(atlas->images[part].texels, sizeof(uint16_t), count, file) != count)
            return because(why, "it ends too early");
    }
    if (fgetc(file) != EOF)
        return because(why, "it is too long");
    return (rg_atlas_find_hash(atlas) && atlas->hash == header->hash) ||
           because(why, "its checksum is wrong");
}

static FILE *open_regular(const char *path, enum rg_atlas_cached *state, char why[256])
{
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat st;
    *state = fd < 0 && (errno == ENOENT || errno == ENOTDIR) ? RG_ATLAS_ABSENT : RG_ATLAS_DAMAGED;
    because(why, "%s", *state == RG_ATLAS_ABSENT ? "it is not there" : strerror(errno));
    if (fd < 0)
        return NULL;
    if (fstat(fd, &st) || !S_ISREG(st.st_mode)) {
        because(why, "it is no regular file");
        close(fd);
        return NULL;
    }
    FILE *file = fdopen(fd, "rb");
    if (!file)
        close(fd);
    return file;
}

struct rg_atlas *rg_atlas_cache_read(enum rg_atlas_size size, enum rg_atlas_cached *state,
                                     char why[256])
{
    char path[RG_ATLAS_PATH_SIZE];
    *state = RG_ATLAS_ABSENT;
    if (!rg_atlas_cache_path(size, path, why))
        return NULL;
    FILE *file = open_regular(path, state, why);
    if (!file)
        return NULL;
    struct header header;
    *state = RG_ATLAS_DAMAGED;
    struct rg_atlas *atlas = NULL;
    if (fread(&header, sizeof(header), 1, file) != 1)
        because(why, "it ends too early");
    else
        *state = check_header(&header, size, why);
    if (*state == RG_ATLAS_SOUND)
        atlas = rg_atlas_allocate(size);
    if (atlas && !read_texels(file, &header, atlas, why)) {
        rg_atlas_destroy(atlas);
        atlas = NULL;
        *state = RG_ATLAS_DAMAGED;
    }
    fclose(file);
    return atlas;
}

// --- writing a file ---

static bool write_all(FILE *file, const struct rg_atlas *atlas)
{
    struct header header = {.order = ORDER,
                            .version = VERSION,
                            .size = atlas->size,
                            .sample = rg_atlas_sample(atlas->size),
                            .hash = atlas->hash};
    memcpy(header.magic, magic, sizeof(magic));
    memcpy(header.point_factor, atlas->point_factor, sizeof(header.point_factor));
    memcpy(header.env_factor, atlas->env_factor, sizeof(header.env_factor));
    memcpy(header.splash_part, atlas->splash_part, sizeof(header.splash_part));
    bool good = fwrite(&header, sizeof(header), 1, file) == 1;
    for (int part = 0; good && part < RG_ATLAS_PART_COUNT; part++) {
        const size_t count = rg_atlas_image_texels(&atlas->images[part]);
        good = fwrite(atlas->images[part].texels, sizeof(uint16_t), count, file) == count;
    }
    return good;
}

bool rg_atlas_cache_write(const struct rg_atlas *atlas, char why[256])
{
    char path[RG_ATLAS_PATH_SIZE];
    struct rg_temporary temporary;
    struct rg_why error;
    if (!rg_atlas_cache_path(atlas->size, path, why) || !rg_user_make_folders(path, why))
        return false;
    if (!rg_temporary_make(path, &temporary, &error))
        return because(why, "%.200s: %s", path, error.text);
    FILE *file = fopen(temporary.path, "wb");
    bool good = file && write_all(file, atlas);
    good = file && fclose(file) == 0 && good;
    if (!good)
        rg_why_set(&error, "%s", strerror(errno));
    return rg_temporary_end(&temporary, good, &error) ||
           because(why, "%.200s: %s", path, error.text);
}
