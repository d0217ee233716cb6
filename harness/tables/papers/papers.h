// All tables that are known: those of papers, and of files that were read (harness/tables/own).
#ifndef RG_HARNESS_TABLES_PAPERS_PAPERS_H
#define RG_HARNESS_TABLES_PAPERS_PAPERS_H

#include "harness/tables/papers/published.h"

// All tables, NULL-terminated; the build generates the list from meson.build in this folder.
extern const struct rg_table *const *rg_tables;

// The table of this id, or NULL.
const struct rg_table *rg_table_find(const char *id);

#endif
