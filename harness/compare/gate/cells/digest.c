#include "harness/compare/gate/cells/digest.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

void rg_digest_of(const void *bytes, size_t size, char digest[RG_DIGEST_SIZE])
{
    snprintf(digest, RG_DIGEST_SIZE, "%016" PRIx64, (uint64_t)XXH3_64bits(bytes, size));
}

void rg_digest_of_cell(const struct rg_gate_cell *cell, char digest[RG_DIGEST_SIZE])
{
    const struct rg_param_table *table = cell->technique->params;
    char line[RG_PATH_SIZE + 128], value[RG_PATH_SIZE];
    snprintf(line, sizeof(line), "%s %dx%d %d", cell->technique->name, cell->width, cell->height,
             cell->frames);
    uint64_t hash = XXH3_64bits(line, strlen(line));
    for (int i = 0; i < table->count; i++) {
        rg_params_text(&table->rows[i], cell->settings, value, sizeof(value));
        snprintf(line, sizeof(line), "%s=%s", table->rows[i].name, value);
        hash = XXH3_64bits_withSeed(line, strlen(line), hash);
    }
    snprintf(digest, RG_DIGEST_SIZE, "%016" PRIx64, hash);
}
