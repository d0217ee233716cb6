#include <archive.h>
#include <archive_entry.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/text/mark.h"
#include "core/scene/mesh/importer/importer.h"

// A file in memory and the position in it, as Assimp's callbacks read it.
struct memory_file {
    struct aiFile callbacks;
    unsigned char *bytes;
    size_t size, at;
};

// --- texts and archives ---

// Drops the byte order mark, which Assimp (5.2) takes for the beginning of a word, losing a vertex.
static void drop_mark(struct import *import)
{
    const size_t mark = rg_mark_bytes(import->bytes, import->size);
    import->size -= mark;
    memmove(import->bytes, import->bytes + mark, import->size);
}

static bool read_entry(struct import *import, struct archive *archive, int64_t size)
{
    if (size <= 0 || size > RG_IMPORT_MAX_FILE_BYTES)
        return import_refuse(import, "%s has %lld bytes; 1 to %lld are read", import->name,
                             (long long)size, (long long)RG_IMPORT_MAX_FILE_BYTES);
    import->bytes = malloc((size_t)size + 1);
    if (!import->bytes)
        return import_refuse(import, "no memory for %lld bytes", (long long)size);
    if (archive_read_data(archive, import->bytes, (size_t)size) != size)
        return import_refuse(import, "%s is damaged; install the package again", import->name);
    import->size = (size_t)size;
    drop_mark(import);
    return true;
}

bool import_read_member(struct import *import)
{
    if (!import->member)
        return true;
    struct archive *archive = archive_read_new();
    struct archive_entry *entry;
    if (!archive || archive_read_support_filter_gzip(archive) != ARCHIVE_OK ||
        archive_read_support_format_tar(archive) != ARCHIVE_OK ||
        archive_read_open_fd(archive, import->archive, 1 << 16) != ARCHIVE_OK)
        return import_refuse(import, "cannot be read as a tar archive; install the package again");
    int result;
    while ((result = archive_read_next_header(archive, &entry)) == ARCHIVE_OK)
        if (!strcmp(archive_entry_pathname(entry), import->member))
            return read_entry(import, archive, archive_entry_size(entry));
    return import_refuse(import,
                         result == ARCHIVE_EOF ? "holds no %s; check the name"
                                               : "is damaged before %s; install the "
                                                 "package again",
                         import->member);
}

void import_name(struct import *import, const char *name)
{
    const char *base = strrchr(name, '/'), *dot = strrchr(base ? base : name, '.');
    import->name = name;
    import->extension = dot ? dot + 1 : "";
}

bool import_open(struct import *import, const char *path, const char *member)
{
    import_name(import, member ? member : path);
    import->member = member;
    if (member)
        import->archive = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    else if ((import->bytes = import_read_whole(path, &import->size))) {
        drop_mark(import);
        import_read_buffers(import);
    }
    return member ? import->archive >= 0 ||
                        import_refuse(import, "%s; install the package again", strerror(errno))
                  : import->bytes || import_refuse(import, "%s; check the path", strerror(errno));
}

// --- Assimp's callbacks ---

static struct memory_file *from(struct aiFile *file)
{
    return (struct memory_file *)file;
}

static size_t read_items(struct aiFile *file, char *to, size_t size, size_t count)
{
    struct memory_file *memory = from(file);
    const size_t left = memory->size - memory->at;
    if (!size)
        return 0;
    count = count < left / size ? count : left / size;
    memcpy(to, memory->bytes + memory->at, count * size);
    memory->at += count * size;
    return count;
}

static size_t write_nothing(struct aiFile *file, const char *data, size_t size, size_t count)
{
    (void)file;
    (void)data;
    (void)size;
    (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    return from(file)->at;
}

static size_t size_of(struct aiFile *file)
{
    return from(file)->size;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    struct memory_file *memory = from(file);
    const size_t start = origin == aiOrigin_SET   ? 0
                         : origin == aiOrigin_CUR ? memory->at
                                                  : memory->size;
    const size_t at = start + offset; // wraps around for a step back
    if (at > memory->size)
        return aiReturn_FAILURE;
    memory->at = at;
    return aiReturn_SUCCESS;
}

static void flush_nothing(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *open_file(struct aiFileIO *files, const char *name, const char *mode)
{
    const struct import *import = (const struct import *)(void *)files->UserData;
    unsigned char *bytes = strcmp(name, import->name) ? NULL : import->bytes;
    size_t size = import->size;
    for (int i = 0; !bytes && !strpbrk(mode, "wa+") && i < import->buffer_count; i++) {
        if (!strcmp(name, import->buffers[i].path)) {
            bytes = import->buffers[i].bytes;
            size = import->buffers[i].size;
        }
    }
    struct memory_file *memory = bytes ? malloc(sizeof(*memory)) : NULL;
    if (!memory)
        return NULL;
    *memory = (struct memory_file){
        {read_items, write_nothing, tell, size_of, seek, flush_nothing, NULL}, bytes, size, 0};
    return &memory->callbacks;
}

// The bytes stay until the process ends, since Assimp may reopen the file.
static void close_file(struct aiFileIO *files, struct aiFile *file)
{
    (void)files;
    free(file);
}

struct aiFileIO import_files(struct import *import)
{
    return (struct aiFileIO){open_file, close_file, (aiUserData)(void *)import};
}
