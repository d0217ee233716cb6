#define _GNU_SOURCE // dl_iterate_phdr, dladdr
#include "backends/library.h"

#include <dlfcn.h>
#include <inttypes.h>
#include <link.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <xxhash.h>

// --- build ids ---

static size_t padded(size_t size)
{
    return (size + 3) & ~(size_t)3;
}

// Reads a segment of notes, each a header, its owner's name and its content.
static void read_notes(const char *notes, size_t size, char id[RG_BUILD_ID_SIZE])
{
    ElfW(Nhdr) note;
    for (size_t at = 0; at + sizeof(note) <= size;) {
        memcpy(&note, notes + at, sizeof(note));
        const char *name = notes + at + sizeof(note);
        const unsigned char *content = (const unsigned char *)name + padded(note.n_namesz);
        at += sizeof(note) + padded(note.n_namesz) + padded(note.n_descsz);
        if (at > size || note.n_type != NT_GNU_BUILD_ID || strcmp(name, "GNU") != 0)
            continue;
        for (size_t i = 0; i < note.n_descsz && 2 * i + 2 < RG_BUILD_ID_SIZE; i++)
            snprintf(id + 2 * i, 3, "%02x", content[i]);
    }
}

// Hashes the code, which is the same wherever it is loaded.
static void read_code(const struct dl_phdr_info *info, char id[RG_BUILD_ID_SIZE])
{
    uint64_t hash = 0;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &info->dlpi_phdr[i];
        if (segment->p_type == PT_LOAD && segment->p_flags == (PF_R | PF_X))
            hash = XXH3_64bits_withSeed((const char *)(info->dlpi_addr + segment->p_vaddr),
                                        segment->p_filesz, hash);
    }
    snprintf(id, RG_BUILD_ID_SIZE, "%016" PRIx64, hash);
}

void rg_build_id(const struct dl_phdr_info *object, char id[RG_BUILD_ID_SIZE])
{
    *id = 0;
    for (int i = 0; i < object->dlpi_phnum; i++)
        if (object->dlpi_phdr[i].p_type == PT_NOTE)
            read_notes((const char *)(object->dlpi_addr + object->dlpi_phdr[i].p_vaddr),
                       object->dlpi_phdr[i].p_memsz, id);
    if (!*id)
        read_code(object, id);
}

// --- files ---

// Finds the line of the process's map with the address. False without /proc, or if no file is
// mapped there.
static bool read_map(uintptr_t code, struct rg_library *library)
{
    char line[RG_LIBRARY_PATH + 128];
    bool is_found = false;
    FILE *maps = fopen("/proc/self/maps", "re");
    while (maps && !is_found && fgets(line, sizeof(line), maps)) {
        uintptr_t first, end;
        unsigned major, minor;
        int at = 0;
        if (sscanf(line, "%" SCNxPTR "-%" SCNxPTR " %*s %*x %x:%x %" SCNu64 " %n", &first, &end,
                   &major, &minor, &library->inode, &at) < 5 ||
            code < first || code >= end || line[at] != '/')
            continue;
        library->device = makedev(major, minor);
        snprintf(library->path, sizeof(library->path), "%.*s", (int)strcspn(line + at, "\n"),
                 line + at);
        is_found = true;
    }
    if (maps)
        fclose(maps);
    return is_found;
}

// Finds the file by the name that it was loaded with; the program's own name is empty.
static void read_name(const char *name, struct rg_library *library)
{
    struct stat file;
    *library = (struct rg_library){.path = ""};
    if (!*name || stat(name, &file))
        return;
    snprintf(library->path, sizeof(library->path), "%s", name);
    library->device = file.st_dev;
    library->inode = file.st_ino;
}

struct wanted {
    uintptr_t code;
    struct rg_library *library;
};

static bool holds(const struct dl_phdr_info *info, uintptr_t code)
{
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &info->dlpi_phdr[i];
        const uintptr_t first = info->dlpi_addr + segment->p_vaddr;
        if (segment->p_type == PT_LOAD && code >= first && code < first + segment->p_memsz)
            return true;
    }
    return false;
}

static int read_holder(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size;
    const struct wanted *wanted = user;
    if (!holds(info, wanted->code))
        return 0;
    if (!read_map(wanted->code, wanted->library))
        read_name(info->dlpi_name, wanted->library);
    rg_build_id(info, wanted->library->build);
    return 1;
}

void rg_library_at(const void *code, struct rg_library *library)
{
    struct wanted wanted = {(uintptr_t)code, library};
    *library = (struct rg_library){.path = ""};
    dl_iterate_phdr(read_holder, &wanted);
}

// --- objects ---

bool rg_library_exports(const void *code, const char *symbol)
{
    Dl_info object, found;
    if (!dladdr(code, &object))
        return false;
    void *handle = dlopen(object.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    void *address = handle ? dlsym(handle, symbol) : NULL;
    if (handle)
        dlclose(handle);
    return address && dladdr(address, &found) && found.dli_fbase == object.dli_fbase;
}

struct found {
    int count, max;
    const void **codes;
    const char *paths[256];
};

static int keep_code(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size;
    struct found *all = user;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &info->dlpi_phdr[i];
        if (segment->p_type != PT_LOAD || !(segment->p_flags & PF_X) || !*info->dlpi_name)
            continue;
        all->paths[all->count] = info->dlpi_name;
        all->codes[all->count++] = (const void *)(info->dlpi_addr + segment->p_vaddr);
        break;
    }
    return all->count == all->max;
}

// `is_wanted` is called after the walk, because the walk holds the lock that symbol look-up takes.
int rg_libraries_find(bool (*is_wanted)(const char *path, const void *code), const void **codes,
                      int max)
{
    const void *seen[256];
    struct found all = {.max = 256, .codes = seen};
    int count = 0;
    dl_iterate_phdr(keep_code, &all);
    for (int i = 0; i < all.count && count < max; i++)
        if (is_wanted(all.paths[i], seen[i]))
            codes[count++] = seen[i];
    return count;
}

bool rg_library_is_same(const struct rg_library *a, const struct rg_library *b)
{
    const bool is_one = a->inode && a->device == b->device && a->inode == b->inode;
    return is_one || (*a->path && !strcmp(a->path, b->path) && !strcmp(a->build, b->build));
}
