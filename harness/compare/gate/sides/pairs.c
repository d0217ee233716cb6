#include "harness/compare/gate/sides/pairs.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/names.h"
#include "harness/compare/gate/sides/sides.h"
#include "harness/devices/workers/worker.h"

static bool copy_name(const char *from, char to[RG_DEVICE_NAME_SIZE])
{
    struct rg_device_name name;
    if (!rg_device_name_read(&from, &name))
        return false;
    if (*from)
        return rg_error("gate: '%s,%s' are two devices; name one", name.name, from);
    snprintf(to, RG_DEVICE_NAME_SIZE, "%s", name.name);
    return true;
}

bool rg_gate_pair_of(const char *a, const char *b, struct rg_gate_pair *pair)
{
    return copy_name(a, pair->names[RG_SIDE_A]) && copy_name(b, pair->names[RG_SIDE_B]);
}

static bool add(const char *program, const char *name, struct rg_gate_pairs *pairs)
{
    if (pairs->count == RG_MAX_DEVICES)
        return rg_error("--device: more than %d names", RG_MAX_DEVICES);
    struct rg_gate_pair *pair = &pairs->all[pairs->count++];
    snprintf(pair->names[RG_SIDE_B], RG_DEVICE_NAME_SIZE, "%s", name);
    return rg_device_name_with(name, RG_WORKER_PROGRAM, program, pair->names[RG_SIDE_A]);
}

static int add_listed(const char *program, struct rg_gate_pairs *pairs)
{
    struct rg_device_list *list = rg_alloc(1, sizeof(*list), "list of devices");
    if (!list)
        return rg_exit_of_error();
    rg_devices_list(list);
    pairs->left_out = rg_devices_complain(list);
    bool ok = true;
    for (int i = 0; ok && i < list->count; i++)
        ok = add(program, list->infos[i].name, pairs);
    free(list);
    if (!ok)
        return rg_exit_of_error();
    return pairs->count ? RG_EXIT_PASS : rg_exit_worse(RG_EXIT_UNSUPPORTED, pairs->left_out);
}

static int add_named(const char *program, const char *names, struct rg_gate_pairs *pairs)
{
    struct rg_device_name name;
    if (!rg_sides_are_apart(names))
        return rg_exit_of_error();
    do
        if (!rg_device_name_read(&names, &name) || !add(program, name.name, pairs))
            return rg_exit_of_error();
    while (*names);
    return RG_EXIT_PASS;
}

int rg_gate_pairs_of_builds(const char *program, const char *names, struct rg_gate_pairs *pairs)
{
    *pairs = (struct rg_gate_pairs){0};
    if (access(program, X_OK)) {
        rg_error("--against '%s': no program that can be started; name another build's raingauge",
                 program);
        return rg_exit_of_error();
    }
    // The program is a file; without a slash it would be searched for along PATH.
    char path[PATH_MAX];
    const int length =
        snprintf(path, sizeof(path), "%s%s", strchr(program, '/') ? "" : "./", program);
    if (length >= PATH_MAX) {
        rg_error("--against: its path is too long; choose a shorter one");
        return rg_exit_of_error();
    }
    return strcmp(names, "all") ? add_named(path, names, pairs) : add_listed(path, pairs);
}

// --- devices that are not gated ---

static bool is_held(const struct rg_gate_pairs *pairs, const char *name)
{
    const size_t length = strlen(name);
    bool any = false;
    for (int i = 0; !any && i < pairs->count; i++) {
        const char *held = rg_device_name_full(pairs->all[i].names[RG_SIDE_B]);
        any = strcspn(held, "@") == length && !strncmp(held, name, length);
    }
    return any;
}

void rg_gate_pairs_left(const struct rg_gate_pairs *pairs, struct rg_gate_left *left)
{
    const char *name = "cpu:reference";
    for (int i = 0; name; name = rg_backends[i] ? rg_backends[i]->name : NULL, i++)
        if (!is_held(pairs, name))
            left->names[left->count++] = name;
}
