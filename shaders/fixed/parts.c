// Names of shaders, their code, and the parts of pictures.
#include "shaders/fixed/fixed.h"

#include <stdio.h>
#include <string.h>

#define NAME(name) #name,

const char *rg_fixed_fragment_name(int fragment)
{
    static const char *const names[] = {RG_FIXED_FRAGMENTS(NAME)};
    return names[fragment];
}

const char *rg_fixed_vertex_name(int vertex)
{
    static const char *const names[] = {RG_FIXED_VERTICES(NAME)};
    return names[vertex];
}

const char *rg_fixed_between_name(int between)
{
    static const char *const names[] = {NULL, "BESIDE", "EVERYWHERE", "BULGE"};
    return names[between];
}

static const char *name_of(const struct rg_fixed_state *state, enum rg_fixed_stage stage)
{
    if (stage == RG_FIXED_STAGE_VERT)
        return rg_fixed_vertex_name(state->vertex);
    if (stage == RG_FIXED_STAGE_FRAG)
        return rg_fixed_fragment_name(state->fragment);
    return rg_fixed_between_name(state->between);
}

const struct rg_fixed_code *rg_fixed_code_of(const struct rg_fixed_state *state,
                                             enum rg_fixed_stage stage)
{
    const char *name = name_of(state, stage);
    for (const struct rg_fixed_code *code = rg_fixed_codes; name && code->name; code++)
        if (code->stage == stage && !strcmp(code->name, name))
            return code;
    return NULL;
}

void *rg_fixed_part(struct rg_fixed_picture *picture, size_t size)
{
    if (size > picture->room - picture->size)
        return NULL;
    picture->size += size;
    return picture->bytes + picture->size - size;
}

void rg_fixed_look(struct rg_fixed_picture *picture, size_t size, size_t texel)
{
    const uint8_t *part = picture->bytes + picture->size - size;
    if (size > texel && !memcmp(part, part + texel, size - texel))
        picture->is_constant = true;
}

bool rg_fixed_lacks(struct rg_fixed_picture *picture, const char *what)
{
    snprintf(picture->lacks, sizeof(picture->lacks), "%s", what);
    return true;
}
