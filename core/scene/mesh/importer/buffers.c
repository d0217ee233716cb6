// Reads the buffer files of glTF in advance, because nothing can be opened in the cage.
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/scene/mesh/importer/importer.h"

// --- files ---

unsigned char *import_read_whole(const char *path, size_t *size)
{
    struct stat st;
    if (!stat(path, &st) && !S_ISREG(st.st_mode)) { // some devices act as soon as they are opened
        errno = EFBIG;
        return NULL;
    }
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); // may block, if replaced
    if (fd < 0)
        return NULL;
    unsigned char *bytes = NULL;
    if (fstat(fd, &st))
        st.st_size = 0;
    else if (!S_ISREG(st.st_mode) || st.st_size > RG_IMPORT_MAX_FILE_BYTES)
        errno = EFBIG;
    else
        bytes = malloc((size_t)st.st_size + 1);
    *size = 0;
    for (ssize_t got = 1; bytes && got > 0 && *size < (size_t)st.st_size;) {
        got = read(fd, bytes + *size, (size_t)st.st_size - *size);
        *size += got > 0 ? (size_t)got : 0;
    }
    close(fd);
    return bytes;
}

// --- names ---

// Decodes %20 and the like, in place.
static void decode_percents(char *text)
{
    char *to = text;
    for (const char *from = text; *from; to++) {
        const bool is_coded =
            from[0] == '%' && isxdigit((unsigned char)from[1]) && isxdigit((unsigned char)from[2]);
        *to = is_coded ? (char)strtol((const char[]){from[1], from[2], 0}, NULL, 16) : *from;
        from += is_coded ? 3 : 1;
    }
    *to = 0;
}

// Whether a URI names a file relative to the mesh's, not embedded data or another location.
static bool is_relative(const char *uri)
{
    return *uri && *uri != '/' && uri[strcspn(uri, ":/?#")] != ':';
}

// Whether a path leaves the folder: a foreign mesh must not open files elsewhere.
static bool leads_out(const char *name)
{
    for (const char *at = strstr(name, ".."); at; at = strstr(at + 1, ".."))
        if ((at == name || at[-1] == '/') && (!at[2] || at[2] == '/'))
            return true;
    return *name == '/';
}

static bool has_buffer(const struct import *import, const char *path)
{
    for (int i = 0; i < import->buffer_count; i++)
        if (!strcmp(import->buffers[i].path, path))
            return true;
    return false;
}

// The path of a name in the mesh's folder; the caller frees it. NULL if the name leaves the folder.
static char *path_of(const struct import *import, const char *name)
{
    const char *slash = strrchr(import->name, '/');
    const size_t folder = slash ? (size_t)(slash - import->name) + 1 : 0;
    char *path = leads_out(name) ? NULL : malloc(folder + strlen(name) + 1);
    if (path) {
        memcpy(path, import->name, folder);
        strcpy(path + folder, name);
    }
    return path;
}

// Some programs write names unencoded. So if the decoded file is missing, a file of exactly that
// name is used.
static void read_buffer(struct import *import, const char *uri)
{
    struct import_buffer *buffer = &import->buffers[import->buffer_count];
    if (import->buffer_count == IMPORT_MAX_BUFFERS || !is_relative(uri))
        return;
    *buffer = (struct import_buffer){.path = path_of(import, uri)};
    char *name = strdup(uri);
    if (name)
        decode_percents(name);
    char *decoded = name ? path_of(import, name) : NULL;
    if (buffer->path && decoded && !has_buffer(import, buffer->path)) {
        buffer->bytes = import_read_whole(decoded, &buffer->size);
        if (!buffer->bytes)
            buffer->bytes = import_read_whole(buffer->path, &buffer->size);
    }
    free(name);
    free(decoded);
    if (buffer->bytes)
        import->buffer_count++;
    else
        free(buffer->path);
}

// --- the JSON text ---

// The JSON text: a GLB's first chunk, or a whole glTF file.
static const char *text_of(const struct import *import, size_t *size)
{
    enum { HEAD = 12, CHUNK = 8 };
    uint32_t bytes;
    *size = import->size;
    if (import->size < HEAD + CHUNK || memcmp(import->bytes, "glTF", 4) != 0)
        return (const char *)import->bytes;
    memcpy(&bytes, import->bytes + HEAD, sizeof(bytes));
    *size = bytes < import->size - HEAD - CHUNK ? bytes : import->size - HEAD - CHUNK;
    return (const char *)import->bytes + HEAD + CHUNK;
}

static void read_named(struct import *import, json_t *buffer)
{
    const char *uri = json_string_value(json_object_get(buffer, "uri"));
    if (uri)
        read_buffer(import, uri);
}

// glTF 2 has an array of buffers, glTF 1 an object.
void import_read_buffers(struct import *import)
{
    size_t size, i;
    const char *key;
    json_t *buffer;
    if (strcasecmp(import->extension, "gltf") && strcasecmp(import->extension, "glb"))
        return;
    const char *text = text_of(import, &size);
    json_t *root = json_loadb(text, size, JSON_DISABLE_EOF_CHECK, NULL);
    json_t *buffers = json_object_get(root, "buffers");
    json_array_foreach(buffers, i, buffer) read_named(import, buffer);
    json_object_foreach(buffers, key, buffer) read_named(import, buffer);
    json_decref(root);
}
