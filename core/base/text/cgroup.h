// The control groups of Linux that this process is in; they limit its share of the machine.
#ifndef RG_CORE_BASE_TEXT_CGROUP_H
#define RG_CORE_BASE_TEXT_CGROUP_H

#include <stdbool.h>

enum { RG_CGROUP_PATH = 1024 };

// `place` is a folder with a group's files, of version 1 or 2.
typedef void rg_cgroup_visit(const char *place, bool is_v2, void *user);

// Visits the groups that limit what a controller ("cpu", "memory") grants: this process's group and
// its ancestors, at each mount point. `root` is put before all paths: "" except in tests.
void rg_cgroups_visit(const char *root, const char *controller, rg_cgroup_visit *visit, void *user);

#endif
