#include "harness/compare/shrink/files.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/alloc.h"
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/record/output.h"

enum { MOST_FILES = 8 };

static bool is_spared_by_folder(const char *value, const char *path, const char *ending)
{
    char folder[RG_PATH_SIZE + 16];
    snprintf(folder, sizeof(folder), "%.*s%s", RG_PATH_SIZE, path, ending);
    return !rg_file_is_in(value, folder) ||
           rg_error("%s: would be overwritten, and is read from '%s'; name another case with -o",
                    folder, value);
}

bool rg_files_spared_by_case(const struct rg_subject *subject, const char *path)
{
    char value[RG_PATH_SIZE];
    bool spared = rg_files_spared_by(subject, path);
    for (int at = 0; spared && rg_file_own_next(subject, &at, value);)
        spared = is_spared_by_folder(value, path, ".files") &&
                 is_spared_by_folder(value, path, ".kernel");
    return spared;
}

void rg_file_ending(const char *path, char *ending, size_t size)
{
    const char *slash = strrchr(path, '/');
    const char *point = strrchr(slash ? slash : path, '.');
    *ending = 0;
    if (!point || !point[1] || strlen(point) >= size)
        return;
    for (const char *c = point + 1; *c; c++)
        if (!isalnum((unsigned char)*c))
            return;
    snprintf(ending, size, "%s", point);
}

char *rg_file_load(const char *path, size_t *size)
{
    const char *why = "cannot be read";
    int error = EINVAL;
    FILE *file = rg_file_open(path, &why);
    if (!file)
        error = errno;
    long end = file && !fseek(file, 0, SEEK_END) ? ftell(file) : -1;
    char *bytes = end >= 0 && !fseek(file, 0, SEEK_SET) ? calloc(1, (size_t)end + 1) : NULL;
    if (end >= 0 && !bytes)
        error = ENOMEM;
    *size = bytes ? fread(bytes, 1, (size_t)end, file) : 0;
    if (file)
        fclose(file);
    if (bytes && *size == (size_t)end)
        return bytes;
    free(bytes);
    rg_system_error(error, "%s: %s; name a file that can be read", path,
                    error == ENOMEM ? strerror(error) : why);
    return NULL;
}

void rg_file_sent_name(const struct rg_param *param, const char *path, char name[RG_FILE_NAME])
{
    char ending[16];
    rg_file_ending(path, ending, sizeof(ending));
    snprintf(name, RG_FILE_NAME, "%.64s%s", param->name, ending);
}

static bool folder_of(const char *path, char *folder, size_t size)
{
    return snprintf(folder, size, "%s.files", path) < (int)size ||
           rg_error("%.80s...: its name is too long", path);
}

bool rg_files_send(const struct rg_subject *subject, const char *path)
{
    const struct rg_param *param;
    struct rg_output_file files[MOST_FILES];
    char names[MOST_FILES][RG_FILE_NAME], folder[2048], value[RG_PATH_SIZE];
    int count = 0;
    bool ok = folder_of(path, folder, sizeof(folder));
    for (int at = 0; ok && count < MOST_FILES && (param = rg_file_own_next(subject, &at, value));) {
        rg_file_sent_name(param, value, names[count]);
        files[count] = (struct rg_output_file){.name = names[count]};
        ok = (files[count].text = rg_file_load(value, &files[count].size)) != NULL;
        count += ok;
    }
    ok = ok && (!count || rg_output_write_set(folder, files, count));
    for (int i = 0; i < count; i++)
        free((void *)(uintptr_t)files[i].text);
    return ok;
}

bool rg_file_receive(const struct rg_technique *technique, void *settings, const char *assignment,
                     const char *path)
{
    char folder[2048], whole[3072];
    const char *name = strchr(assignment, '=');
    if (!folder_of(path, folder, sizeof(folder)))
        return false;
    if (!name || !name[1] || strchr(name, '/'))
        return rg_error("'%s' names no file beside the case; write it as KEY=NAME", assignment);
    snprintf(whole, sizeof(whole), "%.*s%s/%s", (int)(name + 1 - assignment), assignment, folder,
             name + 1);
    if (!rg_file_is_own(whole + (name + 1 - assignment)))
        return rg_error("%s is not there; send the folder along with the case",
                        whole + (name + 1 - assignment));
    return rg_params_set(technique->params, settings, whole);
}
