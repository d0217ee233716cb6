#include "backends/cpu/cpu.h"

#include "backends/formats.h"

static uint *texels_of(struct rg_image *image, const struct rg_draw *draw)
{
    struct cpu_image *cpu = (struct cpu_image *)image;
    return image ? cpu->texels + rg_texel_word(cpu->texels, cpu->shape, 0, 0, draw->layer,
                                               draw->level, rg_format_size(image->desc.format) / 4)
                 : NULL;
}

struct cpu_target cpu_target_of(const struct rg_draw *draw)
{
    return (struct cpu_target){
        .colour = texels_of(draw->colour, draw),
        .depth = texels_of(draw->depth, draw),
        .samples = draw->samples ? ((struct cpu_buf *)draw->samples)->data : NULL,
    };
}
