// A cell's water, by the slots height and still of the including kernel.
#ifndef RG_KERNELS_DROPS_WATER_CELLS_H
#define RG_KERNELS_DROPS_WATER_CELLS_H

RG_FN uint mask_of(bool b)
{
    return b ? 0xffffffffu : 0u;
}

// Chooses by bits, so that all heights are read in any case, and compilers for processors vectorise
// over cells.
RG_FN float either(uint is_a, float a, float b)
{
    return rg_bits_float((rg_float_bits(a) & is_a) | (rg_float_bits(b) & ~is_a));
}

// The height at a cell, with the water of drops at rest.
RG_FN float wet_at(rg_ctx rg, int cell)
{
    float h = height_at(rg, cell);
    return rg_max(h, still_at(rg, cell));
}

#endif
