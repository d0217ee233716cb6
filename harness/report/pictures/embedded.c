// Pictures in a page. Each is stored once, by its content, as data in a URL.
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/files/io.h"
#include "harness/record/named.h"
#include "harness/record/numbered.h"
#include "harness/report/page.h"
#include "harness/report/pictures/codes.h"
#include "harness/report/pictures/linear.h"

enum { MOST_BYTES = 16 << 20 }; // of one picture

static const unsigned char png_begins[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

// Writes `size` bytes as base64, followed by a zero.
static void encode(const unsigned char *bytes, size_t size, char *text)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const unsigned b = i + 1 < size ? bytes[i + 1] : 0, c = i + 2 < size ? bytes[i + 2] : 0;
        const unsigned word = (unsigned)bytes[i] << 16 | b << 8 | c;
        *text++ = digits[word >> 18];
        *text++ = digits[word >> 12 & 63];
        *text++ = i + 1 < size ? digits[word >> 6 & 63] : '=';
        *text++ = i + 2 < size ? digits[word & 63] : '=';
    }
    *text = 0;
}

// --- which files may be taken ---

static bool is_below(const char *path, const char *folder)
{
    char whole[PATH_MAX];
    if (!realpath(folder, whole))
        return false;
    const size_t length = strlen(whole);
    return !strncmp(path, whole, length) && (path[length] == '/' || whole[length - 1] == '/');
}

// Finds a file that a record in `folder` names: by its path from the current folder, by its path
// from `folder`, or by its name in `folder`. False if none of these exists and may be taken.
static bool find(const char *folder, const char *name, char found[PATH_MAX])
{
    const char *slash = strrchr(name, '/');
    const char *const tried[][2] = {{"", name}, {folder, name}, {folder, slash ? slash + 1 : name}};
    for (int i = 0; i < 3; i++) {
        char path[PATH_MAX];
        const char *glue = *tried[i][0] ? "/" : "";
        if (snprintf(path, sizeof(path), "%s%s%s", tried[i][0], glue, tried[i][1]) < PATH_MAX &&
            realpath(path, found) && (is_below(found, folder) || is_below(found, ".")))
            return true;
    }
    return false;
}

// The bytes of a PNG, which the caller frees; NULL if it is none or too large.
static unsigned char *load(const char *path, size_t *size)
{
    const char *why;
    FILE *file = rg_file_open(path, &why);
    unsigned char *bytes = file ? malloc(MOST_BYTES) : NULL;
    *size = bytes ? fread(bytes, 1, MOST_BYTES, file) : 0;
    const bool is_png = *size > sizeof(png_begins) && *size < MOST_BYTES &&
                        !memcmp(bytes, png_begins, sizeof(png_begins));
    if (file)
        fclose(file);
    if (is_png)
        return bytes;
    free(bytes);
    return NULL;
}

// --- taking them ---

// A picture as data in a URL; the caller owns it. NULL without memory.
static json_t *data_json(const char *kind, const unsigned char *bytes, size_t size)
{
    char begin[32];
    const size_t length = (size_t)snprintf(begin, sizeof(begin), "data:image/%s;base64,", kind);
    char *text = malloc(length + 1 + (size + 2) / 3 * 4);
    if (!text)
        return NULL;
    memcpy(text, begin, length);
    encode(bytes, size, text + length);
    json_t *json = json_string_nocheck(text);
    free(text);
    return json;
}

// Puts a picture into the page by its digest, if there is room.
static bool put(struct rg_page *page, const char *digest, const char *kind,
                const unsigned char *bytes, size_t size, bool *has_room)
{
    *has_room = page->picture_bytes + (int64_t)size <= RG_PAGE_PICTURES;
    page->left_out += !*has_room;
    page->picture_bytes += *has_room ? (int64_t)size : 0;
    return !*has_room || !json_object_set_new(page->pictures, digest, data_json(kind, bytes, size));
}

// The same as WebP, which takes two thirds of PNG's bytes, unless there is a PNG that takes fewer.
static bool put_smaller(struct rg_page *page, const char *digest, const struct rg_codes *codes,
                        const unsigned char *png, size_t size, bool *has_room)
{
    size_t webp_size = 0;
    unsigned char *webp = codes->texels ? rg_codes_webp(codes, &webp_size) : NULL;
    const bool is_smaller = webp && (!png || webp_size < size);
    bool ok = true;
    if (webp || png)
        ok = put(page, digest, is_smaller ? "webp" : "png", is_smaller ? webp : png,
                 is_smaller ? webp_size : size, has_room);
    else
        *has_room = false;
    free(webp);
    return ok;
}

// Keeps a picture once, by its codes if they are known: files of the same codes may differ. `png`
// may be NULL if there are codes.
static bool keep(struct rg_page *page, const char *name, const struct rg_codes *codes,
                 const unsigned char *png, size_t size)
{
    char digest[17];
    bool has_room = true, ok = true;
    snprintf(digest, sizeof(digest), "%016" PRIx64,
             codes->texels ? rg_codes_digest(codes) : (uint64_t)XXH3_64bits(png, size));
    if (!page->pictures) {
        page->pictures = json_object();
        page->files = json_object();
    }
    if (!json_object_get(page->pictures, digest))
        ok = put_smaller(page, digest, codes, png, size, &has_room);
    return ok && (!has_room || !json_object_set_new(page->files, name, json_string(digest)));
}

static bool lacks_memory(const char *name)
{
    return rg_harness_error("%s: no memory for it; name fewer records", name);
}

static bool take_png(struct rg_page *page, const char *name, const char *path)
{
    size_t size;
    struct rg_codes codes = {0};
    unsigned char *bytes = load(path, &size);
    if (bytes)
        rg_codes_of_png(bytes, size, &codes);
    const bool ok = !bytes || keep(page, name, &codes, bytes, size) || lacks_memory(name);
    rg_codes_free(&codes);
    free(bytes);
    return ok;
}

// Takes linear light as a screen shows it.
static bool take_exr(struct rg_page *page, const char *name, const char *path)
{
    struct rg_picture picture;
    if (!rg_picture_read(path, &picture))
        return false;
    struct rg_codes codes = {picture.width, picture.height,
                             malloc(4 * (size_t)picture.width * (size_t)picture.height)};
    if (codes.texels)
        rg_encode(&picture, 1, codes.texels);
    const bool ok = (codes.texels && keep(page, name, &codes, NULL, 0)) || lacks_memory(name);
    rg_codes_free(&codes);
    rg_picture_destroy(&picture);
    return ok;
}

static bool ends_in(const char *name, const char *end)
{
    const size_t length = strlen(name), end_length = strlen(end);
    return length > end_length && !strcmp(name + length - end_length, end);
}

// Takes a picture, if it exists and may be taken; the page shows which are missing.
static bool take(struct rg_page *page, const char *folder, const char *name)
{
    char path[PATH_MAX];
    return !find(folder, name, path) ||
           (ends_in(path, ".exr") ? take_exr : take_png)(page, name, path);
}

// --- linear values ---

// Keeps the values of pictures of one frame around the texels that differ most, by `key`. Files
// that do not exist or may not be taken are left out.
static bool keep_linear(struct rg_page *page, const char *folder, const char *key,
                        const char *const names[], const char *const files[], int count)
{
    struct rg_linear linear = {0};
    char path[PATH_MAX];
    bool ok = true;
    for (int i = 0; ok && i < count && page->linear_count < RG_PAGE_LINEAR; i++)
        if (files[i] && find(folder, files[i], path)) {
            linear.names[linear.count] = names[i];
            ok = rg_picture_read(path, &linear.pictures[linear.count]);
            linear.count += ok;
        }
    json_t *json = ok ? rg_linear_json(&linear) : NULL;
    if (json && !page->linear)
        page->linear = json_object();
    page->linear_count += json != NULL;
    ok = ok && (!json || !json_object_set_new(page->linear, key, json) || lacks_memory(key));
    rg_linear_free(&linear);
    return ok;
}

// Those of a case of a gate, whose files of linear light stand beside A's and B's pictures.
static bool keep_case(struct rg_page *page, const char *folder, const json_t *attachments)
{
    static const char *const names[] = {"A", "B"}, *const ends[] = {"-a.png", "-b.png"};
    char paths[2][PATH_MAX] = {"", ""};
    const char *key = NULL;
    size_t i;
    json_t *attachment;
    json_array_foreach(attachments, i, attachment)
    {
        const char *name = json_string_value(attachment);
        for (int k = 0; name && k < 2; k++)
            if (ends_in(name, ends[k]) && !*paths[k] && strlen(name) < PATH_MAX) {
                snprintf(paths[k], PATH_MAX, "%.*s.exr", (int)strlen(name) - 4, name);
                key = k ? key : name;
            }
    }
    return !key || !*paths[1] ||
           keep_linear(page, folder, key, names, (const char *const[]){paths[0], paths[1]}, 2);
}

// Takes the pictures of a diff's devices, and keeps their values.
static bool take_devices(struct rg_page *page, const char *folder, const json_t *pictures)
{
    const char *names[RG_LINEAR_PICTURES], *files[RG_LINEAR_PICTURES];
    int count = 0;
    size_t i;
    json_t *picture;
    bool ok = true;
    json_array_foreach(pictures, i, picture)
    {
        const char *name = json_string_value(json_object_get(picture, "device"));
        const char *file = json_string_value(json_object_get(picture, "file"));
        if (!ok || !name || !file || count == RG_LINEAR_PICTURES)
            continue;
        names[count] = name;
        files[count++] = file;
        ok = take(page, folder, file);
    }
    return ok && (!count || keep_linear(page, folder, files[0], names, files, count));
}

// Takes the picture that a record of `render` names: of numbered ones a strip, evenly spaced, with
// the first and the last.
static bool take_drawn(struct rg_page *page, const char *folder, const json_t *document)
{
    const char *file = json_string_value(json_object_get(document, "file"));
    const json_t *frames = json_object_get(document, "frames");
    const json_int_t first = json_integer_value(json_array_get(frames, 0));
    const json_int_t last = json_integer_value(json_array_get(frames, 1));
    if (!file || rg_numbered_places(file) != 1)
        return !file || take(page, folder, file);
    const json_int_t span = first < 0 || last < first || last > INT_MAX ? 0 : last - first;
    const json_int_t steps = span < RG_PAGE_STRIP ? span : RG_PAGE_STRIP - 1;
    bool ok = true;
    for (json_int_t i = 0; ok && i <= steps; i++) {
        char name[PATH_MAX];
        const json_int_t frame = first + (steps ? i * span / steps : 0);
        ok = rg_numbered_path(file, (int)frame, name, sizeof(name)) && take(page, folder, name);
    }
    return ok;
}

bool rg_page_add_pictures(struct rg_page *page, const char *folder, const json_t *document)
{
    bool ok = take_drawn(page, folder, document) &&
              take_devices(page, folder, json_object_get(document, "pictures"));
    size_t i, k;
    json_t *gated, *name;
    json_array_foreach(json_object_get(document, "gated"), i, gated)
    {
        const json_t *attachments = json_object_get(gated, "attachments");
        json_array_foreach(attachments, k, name)
        {
            ok = ok && (!json_is_string(name) || take(page, folder, json_string_value(name)));
        }
        ok = ok && keep_case(page, folder, attachments);
    }
    return ok;
}

// --- a text of Markdown ---

enum { CAPTION_SIZE = 1024 };

// Copies the paragraph at `*at` without marks, on one line, if it begins with `mark`, and moves
// `*at` behind it. False if it begins otherwise.
static bool take_paragraph(const char **at, char mark, char text[CAPTION_SIZE])
{
    size_t length = 0;
    *at += strspn(*at, " \t\r\n");
    if (**at != mark)
        return false;
    for (const char *begin = *at; **at && strncmp(*at, "\n\n", 2) != 0; ++*at) {
        const bool is_mark = strchr("*`", **at) ||
                             (mark == '>' && **at == '>' && (*at == begin || (*at)[-1] == '\n'));
        const char letter = **at == '\n' ? ' ' : **at;
        const bool is_double = letter == ' ' && (!length || text[length - 1] == ' ');
        if (!is_mark && !is_double && length < CAPTION_SIZE - 1)
            text[length++] = letter;
    }
    while (length && text[length - 1] == ' ')
        length--;
    text[length] = 0;
    return true;
}

// A picture with its caption: the paragraph at `at` if it begins with `*`, otherwise the picture's
// own text; and with the paper's caption, a paragraph behind it that begins with `>`. NULL if a
// text is not UTF-8.
static json_t *shown_json(const char *at, const char *name, const char *own, size_t own_length)
{
    char caption[CAPTION_SIZE], printed[CAPTION_SIZE];
    if (!take_paragraph(&at, '*', caption))
        snprintf(caption, sizeof(caption), "%.*s", (int)own_length, own);
    const bool has_printed = take_paragraph(&at, '>', printed);
    return json_pack("{so so ss*}", "file", rg_json_text(name), "caption", rg_json_text(caption),
                     "printed", has_printed ? printed : NULL);
}

bool rg_page_add_gallery(struct rg_page *page, const char *folder, const char *markdown)
{
    bool ok = true;
    if (!page->gallery)
        page->gallery = json_array();
    for (const char *at = markdown; ok && (at = strstr(at, "\n![")); at++) {
        const char *text = at + 3, *middle = strstr(text, "]("), *end = middle;
        end = end ? strchr(end, ')') : NULL;
        char name[PATH_MAX];
        if (!end || end - middle >= (int)sizeof(name))
            break;
        snprintf(name, sizeof(name), "%.*s", (int)(end - middle) - 2, middle + 2);
        json_t *shown = shown_json(end + 1, name, text, (size_t)(middle - text));
        ok = !shown || (take(page, folder, name) && !json_array_append_new(page->gallery, shown));
    }
    return ok || rg_harness_error("a text's pictures: no memory for them; name fewer records");
}
