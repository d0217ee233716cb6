#define _GNU_SOURCE // dl_iterate_phdr
#include "harness/record/passport/program.h"

#include <inttypes.h>
#include <link.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

static size_t padded(size_t size)
{
    return (size + 3) & ~(size_t)3;
}

// A segment of notes, each a header, its owner's name and its content.
static void read_notes(const char *notes, size_t size, char id[RG_PROGRAM_ID_SIZE])
{
    ElfW(Nhdr) note;
    for (size_t at = 0; at + sizeof(note) <= size;) {
        memcpy(&note, notes + at, sizeof(note));
        const char *name = notes + at + sizeof(note);
        const unsigned char *content = (const unsigned char *)name + padded(note.n_namesz);
        at += sizeof(note) + padded(note.n_namesz) + padded(note.n_descsz);
        if (at > size || note.n_type != NT_GNU_BUILD_ID || strcmp(name, "GNU") != 0)
            continue;
        for (size_t i = 0; i < note.n_descsz && 2 * i + 2 < RG_PROGRAM_ID_SIZE; i++)
            snprintf(id + 2 * i, 3, "%02x", content[i]);
    }
}

// Of code, which is the same wherever it is loaded.
static void read_code(const struct dl_phdr_info *info, char id[RG_PROGRAM_ID_SIZE])
{
    uint64_t hash = 0;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *segment = &info->dlpi_phdr[i];
        if (segment->p_type == PT_LOAD && segment->p_flags == (PF_R | PF_X))
            hash = XXH3_64bits_withSeed((const char *)(info->dlpi_addr + segment->p_vaddr),
                                        segment->p_filesz, hash);
    }
    snprintf(id, RG_PROGRAM_ID_SIZE, "%016" PRIx64, hash);
}

static void read_object(const struct dl_phdr_info *info, char id[RG_PROGRAM_ID_SIZE])
{
    *id = 0;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_NOTE)
            read_notes((const char *)(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr),
                       info->dlpi_phdr[i].p_memsz, id);
    if (!*id)
        read_code(info, id);
}

// The program is the first that is told of.
static int read_program(struct dl_phdr_info *info, size_t size, void *id)
{
    (void)size;
    read_object(info, id);
    return 1;
}

struct libraries {
    int count; // the program included
    uint64_t hash;
};

// A sum, for their order says nothing.
static int add_library(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size;
    struct libraries *all = user;
    char id[RG_PROGRAM_ID_SIZE] = "";
    if (all->count++)
        read_object(info, id);
    all->hash += XXH3_64bits(id, strlen(id));
    return 0;
}

void rg_program_id(char id[RG_PROGRAM_ID_SIZE])
{
    snprintf(id, RG_PROGRAM_ID_SIZE, "unknown");
    dl_iterate_phdr(read_program, id);
}

uint64_t rg_libraries_hash(void)
{
    struct libraries all = {0};
    dl_iterate_phdr(add_library, &all);
    return all.hash;
}
