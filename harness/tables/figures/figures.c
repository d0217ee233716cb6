#include "harness/tables/figures/figures.h"

#include <string.h>

#include "harness/tables/figures/papers.h"

#define DECLARE(paper) extern const struct rg_figure rg_figures_##paper[];
RG_FIGURE_PAPERS(DECLARE)
#define ENTRY(paper) rg_figures_##paper,
static const struct rg_figure *const papers[] = {RG_FIGURE_PAPERS(ENTRY) NULL};

const struct rg_figure *rg_figure_at(int index)
{
    for (int paper = 0; papers[paper]; paper++)
        for (const struct rg_figure *figure = papers[paper]; figure->id; figure++)
            if (index-- == 0)
                return figure;
    return NULL;
}

const struct rg_figure *rg_figure_find(const char *id)
{
    const struct rg_figure *figure;
    for (int i = 0; (figure = rg_figure_at(i)); i++)
        if (!strcmp(figure->id, id))
            return figure;
    return NULL;
}
