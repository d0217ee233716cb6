#include "core/base/text/cgroup.h"

#include <stdio.h>
#include <string.h>

#include "core/base/text/words.h"

enum { LINE_SIZE = 8192 };

struct walk {
    const char *root;
    rg_cgroup_visit *visit;
    void *user;
};

// Visits a group and its ancestors. Inside a container the group's path may be the host's and lead
// nowhere; the mount point itself is then our group.
static void visit_upwards(const struct walk *walk, const char *mount, const char *group, bool is_v2)
{
    char place[RG_CGROUP_PATH];
    const size_t mount_length = strlen(walk->root) + strlen(mount);
    if (snprintf(place, sizeof(place), "%s%s%s", walk->root, mount, group) >= RG_CGROUP_PATH)
        return;
    for (;;) {
        walk->visit(place, is_v2, walk->user);
        if (strlen(place) <= mount_length)
            return;
        *strrchr(place, '/') = 0;
    }
}

// Version 1 mounts a controller under its name, or under the names of all controllers mounted
// together.
static void visit_version_1(const struct walk *walk, const char *names, const char *controller,
                            const char *group)
{
    char mount[RG_CGROUP_PATH], words[LINE_SIZE];
    snprintf(words, sizeof(words), "%s", names);
    for (char *c = words; *c; c++)
        *c = *c == ',' ? ' ' : *c;
    if (!rg_has_word(words, controller))
        return;
    snprintf(mount, sizeof(mount), "/sys/fs/cgroup/%s", controller);
    visit_upwards(walk, mount, group, false);
    if (strcmp(names, controller) != 0 &&
        snprintf(mount, sizeof(mount), "/sys/fs/cgroup/%s", names) < RG_CGROUP_PATH)
        visit_upwards(walk, mount, group, false);
}

// A line of /proc/self/cgroup is ID:CONTROLLERS:PATH; version 2 has no controllers.
static void visit_line(const struct walk *walk, char *line, const char *controller)
{
    char *names = strchr(line, ':');
    char *group = names ? strchr(names + 1, ':') : NULL;
    if (!group || group[1] != '/')
        return;
    *names++ = *group++ = 0;
    if (*names) {
        visit_version_1(walk, names, controller, group);
    } else {
        visit_upwards(walk, "/sys/fs/cgroup", group, true);
        visit_upwards(walk, "/sys/fs/cgroup/unified", group, true);
    }
}

void rg_cgroups_visit(const char *root, const char *controller, rg_cgroup_visit *visit, void *user)
{
    const struct walk walk = {root, visit, user};
    char path[RG_CGROUP_PATH], line[LINE_SIZE];
    snprintf(path, sizeof(path), "%s/proc/self/cgroup", root);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof(line), file)) {
        line[strcspn(line, "\n")] = 0;
        visit_line(&walk, line, controller);
    }
    if (file)
        fclose(file);
}
