// A fragment of the DRAW program that was just included, with the sum of its lights (draw.h): one
// light after the other is added to zero. Shells with their own loop over lights, which lets them
// vectorise over fragments, add in this order too.

#if defined(RG_LIGHTS)

RG_FN rg_lit rg_program_lit(rg_ctx rg, RG_PARAMS p, RG_RECORD r, int px, int py)
{
    rg_lit lit = rg_no_light();
    for (int light = 0; light < p.lights; light++)
        lit = rg_light_sum(
            lit, rg_program_light(rg, p, r, px, py, light RG_RECORD_LIGHT(rg, p, r, light)));
    return lit;
}

RG_FN rg_fragment rg_drawn_fragment(rg_ctx rg, RG_PARAMS p, RG_RECORD r, int px, int py)
{
    return rg_settled(rg_program_fragment(rg, p, r, px, py, rg_program_lit(rg, p, r, px, py)));
}

#else

RG_FN rg_fragment rg_drawn_fragment(rg_ctx rg, RG_PARAMS p, RG_RECORD r, int px, int py)
{
    return rg_settled(rg_program_fragment(rg, p, r, px, py));
}

#endif
