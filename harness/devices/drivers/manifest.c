#include "harness/devices/drivers/manifest.h"

#include <elf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backends/manifests.h"
#include "core/base/files/file.h"
#include "core/base/log.h"

// --- reading ---

static bool is_icd(const char *path)
{
    const size_t length = strlen(path);
    return length > 4 && !strcmp(path + length - 4, ".icd");
}

// A path with a slash is relative to the manifest's folder.
static void find_library(struct rg_manifest *m)
{
    const char *slash = strrchr(m->path, '/');
    m->is_bare = !strchr(m->named, '/');
    if (m->is_bare || *m->named == '/')
        memcpy(m->library, m->named, PATH_MAX);
    else if (snprintf(m->library, PATH_MAX, "%.*s/%s", slash ? (int)(slash - m->path) : 1,
                      slash ? m->path : ".", m->named) >= PATH_MAX)
        m->fault = RG_MANIFEST_NO_LIBRARY;
    if (!m->is_bare && access(m->library, F_OK))
        m->fault = RG_MANIFEST_NO_LIBRARY;
}

void rg_manifest_read(const char *path, struct rg_manifest *m)
{
    const char *why;
    char fault[200];
    *m = (struct rg_manifest){.fault = RG_MANIFEST_NO_FORM};
    snprintf(m->path, sizeof(m->path), "%s", path);
    if (access(path, F_OK))
        m->fault = RG_MANIFEST_ABSENT;
    FILE *file = rg_file_open_small(path, &why);
    if (!file)
        return;
    if (rg_manifest_read_library(file, is_icd(path), m->named, fault, sizeof(fault))) {
        m->fault = RG_MANIFEST_WELL;
        find_library(m);
    }
    fclose(file);
}

// --- writing ---

// The manifest's text with another library; the caller frees it. NULL when memory runs out.
static char *text_with(const struct rg_manifest *m, const char *library)
{
    char *text = NULL;
    if (is_icd(m->path)) {
        const size_t size = strlen(library) + 2;
        text = malloc(size);
        if (text)
            snprintf(text, size, "%s\n", library);
        return text;
    }
    json_t *json = json_load_file(m->path, 0, NULL);
    if (!json)
        json = json_pack("{s:s, s:{}}", "file_format_version", "1.0.0", "ICD");
    json_object_set_new(json_object_get(json, "ICD"), "library_path", json_string(library));
    text = json_dumps(json, JSON_INDENT(4));
    json_decref(json);
    return text;
}

static bool holds_already(const char *path, const char *text)
{
    char there[8192];
    FILE *file = fopen(path, "re");
    const size_t size = file ? fread(there, 1, sizeof(there), file) : 0;
    if (file)
        fclose(file);
    return size == strlen(text) && !memcmp(there, text, size);
}

// Writes under another name first, because another process may be reading it.
bool rg_manifest_write(const struct rg_manifest *m, const char *library, const char *path)
{
    char *text = text_with(m, library), other[PATH_MAX];
    bool ok = text && snprintf(other, sizeof(other), "%s.%d", path, (int)getpid()) < PATH_MAX;
    if (ok && !holds_already(path, text)) {
        FILE *file = fopen(other, "we");
        ok = file && fputs(text, file) >= 0;
        ok = file && !fclose(file) && ok && !rename(other, path);
    }
    free(text);
    return ok ||
           rg_error("%s: cannot be written; set XDG_CACHE_HOME to a folder that takes files", path);
}

// --- installed places ---

void rg_manifest_tree(const char *path, char tree[PATH_MAX])
{
    static const char *const places[] = {"/vulkan/icd.d", "/glvnd/egl_vendor.d", "/OpenCL/vendors"};
    static const char *const above[] = {"/share", "/etc", "/local", "/usr"};
    *tree = 0;
    char *real = realpath(path, NULL), *end = NULL;
    for (int i = 0; real && !end && i < 3; i++) {
        end = strstr(real, places[i]);
        if (end && end[strlen(places[i])] != '/' && end[strlen(places[i])])
            end = NULL;
    }
    for (size_t i = 0; end && i < sizeof(above) / sizeof(*above); i++) {
        const size_t length = strlen(above[i]);
        if (end - real >= (long)length && !strncmp(end - length, above[i], length))
            end -= length;
    }
    if (end)
        snprintf(tree, PATH_MAX, "%.*s", (int)(end - real), real);
    free(real);
}

bool rg_path_is_below(const char *path, const char *folder)
{
    char *real = realpath(folder, NULL);
    const size_t length = real ? strlen(real) : 0;
    const bool below =
        length && !strncmp(path, real, length) && (path[length] == '/' || real[length - 1] == '/');
    free(real);
    return below;
}

// --- libraries ---

static bool read_head(const char *path, Elf64_Ehdr *head)
{
    FILE *file = fopen(path, "re");
    const bool is_read = file && fread(head, sizeof(*head), 1, file) == 1;
    if (file)
        fclose(file);
    return is_read && !memcmp(head->e_ident, ELFMAG, SELFMAG);
}

bool rg_library_is_foreign(const char *path)
{
    Elf64_Ehdr its, own;
    return read_head(path, &its) && read_head("/proc/self/exe", &own) &&
           (its.e_ident[EI_CLASS] != own.e_ident[EI_CLASS] || its.e_machine != own.e_machine);
}
