// All published tables, by the papers that have them.
#ifndef RG_HARNESS_TABLES_PAPERS_PAPERS_H
#define RG_HARNESS_TABLES_PAPERS_PAPERS_H

#include "harness/tables/papers/published.h"

// All tables, NULL-terminated, made by the build from the list in meson.build beside this.
extern const struct rg_table *const rg_tables[];

// The table of this id, or NULL.
const struct rg_table *rg_table_find(const char *id);

#endif
