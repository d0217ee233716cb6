#define _GNU_SOURCE // dl_iterate_phdr
#include "harness/record/passport/program.h"

#include <link.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

// The program is the first object reported.
static int read_program(struct dl_phdr_info *info, size_t size, void *id)
{
    (void)size;
    rg_build_id(info, id);
    return 1;
}

struct libraries {
    int count; // including the program
    uint64_t hash;
};

// Adds hashes up, because their order is arbitrary.
static int add_library(struct dl_phdr_info *info, size_t size, void *user)
{
    (void)size;
    struct libraries *all = user;
    char id[RG_BUILD_ID_SIZE] = "";
    if (all->count++)
        rg_build_id(info, id);
    all->hash += XXH3_64bits(id, strlen(id));
    return 0;
}

void rg_program_id(char id[RG_BUILD_ID_SIZE])
{
    snprintf(id, RG_BUILD_ID_SIZE, "unknown");
    dl_iterate_phdr(read_program, id);
}

uint64_t rg_libraries_hash(void)
{
    struct libraries all = {0};
    dl_iterate_phdr(add_library, &all);
    return all.hash;
}
