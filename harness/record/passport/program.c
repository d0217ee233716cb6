#define _GNU_SOURCE // dl_iterate_phdr
#include "harness/record/passport/program.h"

#include <link.h>
#include <stdio.h>
#include <string.h>

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

// The program is the first that is told of.
static int read_program(struct dl_phdr_info *info, size_t size, void *id)
{
    (void)size;
    for (int i = 0; i < info->dlpi_phnum; i++)
        if (info->dlpi_phdr[i].p_type == PT_NOTE)
            read_notes((const char *)(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr),
                       info->dlpi_phdr[i].p_memsz, id);
    return 1;
}

void rg_program_id(char id[RG_PROGRAM_ID_SIZE])
{
    snprintf(id, RG_PROGRAM_ID_SIZE, "unknown");
    dl_iterate_phdr(read_program, id);
}
