#include "harness/record/passport/passport.h"

#include <gnu/libc-version.h>
#include <stdlib.h>
#include <string.h>

#include "backends/kernel.h"
#include "harness/record/passport/build_info.h"
#include "harness/record/passport/machine.h"
#include "harness/record/named.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/program.h"
#include "harness/record/passport/variables.h"

static json_t *environment(void)
{
    json_t *set = json_object();
    for (int i = 0; rg_variables[i].name; i++) {
        const char *value = getenv(rg_variables[i].name);
        if (value)
            json_object_set_new(set, rg_variables[i].name, rg_json_text(value));
    }
    return set;
}

static json_t *words(const char *text)
{
    json_t *array = json_array();
    while (*text) {
        size_t length = 0;
        while (text[length] && text[length] != ' ')
            length++;
        json_array_append_new(array, json_stringn(text, length));
        text += length + (text[length] == ' ');
    }
    return array;
}

static json_t *machine(void)
{
    struct rg_machine m;
    rg_machine_read(&m, "");
    return json_pack("{sososisisssosssososI}", "cpu", rg_json_text(m.cpu), "features",
                     words(m.features), "cores_online", m.cores_online, "cores_allowed",
                     m.cores_allowed, "cores_list", m.cores_list, "quota_cpus",
                     m.quota_cpus > 0 ? json_real(rg_number_kept(m.quota_cpus)) : json_null(),
                     "kernel", m.kernel, "distribution", rg_json_text(m.distribution), "clocks",
                     rg_json_text(m.clocks), "memory_bytes", (json_int_t)m.memory_bytes);
}

// The C library is that which runs; of the others the headers' versions are known.
static json_t *libraries(void)
{
    json_t *all = json_pack("{ss}", "glibc", gnu_get_libc_version());
    for (const struct rg_build_library *library = rg_build_libraries; library->name; library++)
        json_object_set_new(all, library->name, json_string(library->version));
    return all;
}

static json_t *build(void)
{
    const char *folder = rg_kernel_override();
    char id[RG_BUILD_ID_SIZE];
    rg_program_id(id);
    return json_pack("{sssssssssssoso}", "version", rg_build_version, "commit", rg_build_commit,
                     "compiler", rg_build_compiler, "type", rg_build_type, "program", id,
                     "kernel_dir", folder ? rg_json_text(folder) : json_null(), "libraries",
                     libraries());
}

json_t *rg_passport_device(const struct rg_device_info *info)
{
    json_t *device = json_pack("{sososososb}", "name", rg_json_text(info->name), "api",
                               rg_json_text(info->api), "device", rg_json_text(info->device),
                               "driver", rg_json_text(info->driver), "software", info->software);
    rg_driver_put(device, info);
    return device;
}

json_t *rg_passport_devices(const struct rg_device_info *const infos[], int count)
{
    json_t *all = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(all, rg_passport_device(infos[i]));
    return all;
}

json_t *rg_passport_json(const struct rg_device_info *infos, int count)
{
    json_t *devices = json_array(), *device;
    size_t i;
    for (int k = 0; k < count; k++)
        json_array_append_new(devices, rg_passport_device(&infos[k]));
    json_t *passport = json_pack("{sosososo}", "raingauge", build(), "machine", machine(),
                                 "environment", environment(), "devices", devices);
    json_array_foreach(devices, i, device)
    {
        char key[RG_KEY_SIZE];
        json_t *parts = rg_key_parts(passport, device);
        rg_key_hash(parts, key);
        json_object_set_new(device, "key", json_string(key));
        json_decref(parts);
    }
    return passport;
}
