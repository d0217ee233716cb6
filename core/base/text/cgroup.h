// The control groups that this process is in, as Linux tells them: they bound what it gets of a
// machine.
#ifndef RG_CORE_BASE_TEXT_CGROUP_H
#define RG_CORE_BASE_TEXT_CGROUP_H

#include <stdbool.h>

enum { RG_CGROUP_PATH = 1024 };

// A `place` holds a group's files, of version 1 or 2.
typedef void rg_cgroup_visit(const char *place, bool is_v2, void *user);

// Visits the groups that bound what a controller ("cpu", "memory") grants: this process's, those
// around it, and where several are mounted each. `root` goes before all paths, "" but for tests.
void rg_cgroups_visit(const char *root, const char *controller, rg_cgroup_visit *visit, void *user);

#endif
