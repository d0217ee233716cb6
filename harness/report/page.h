// One page of all records, for people to look at (docs/page.md).
//
// Records are the JSON that commands write (docs/records.md). This code reads and checks them, and
// puts them into the page as they are, with the papers' printed rows and the pictures that they
// name. The files in `page/`, which the build embeds, show them.
#ifndef RG_HARNESS_REPORT_PAGE_H
#define RG_HARNESS_REPORT_PAGE_H

#include "harness/tables/claims/outcomes.h"

// The content of a page. Zero it before; rg_page_free in any case.
struct rg_page {
    json_t *records;  // array of {kind, file, document}; tables have `printed` too
    json_t *pictures; // object: data of each picture by its digest
    json_t *files;    // object: digests of pictures by the path that a record names
    json_t *linear;   // object: linear values by the first of the files that are compared
    json_t *gallery;  // array of {file, caption, printed}: pictures in a text of Markdown
    int64_t picture_bytes;
    int linear_count;
    int left_out; // pictures that had no room
    int gates, gates_left_out;
    // Launches that give the verdicts on tables without any; NULL: none. Not owned.
    const struct rg_stored *kept;
    struct rg_claim_outcomes outcomes;
};

enum {
    RG_PAGE_PICTURES = 32 << 20, // bytes of all pictures together
    RG_PAGE_LINEAR = 24,         // most sets of pictures with linear values, 0.2 MB each
    RG_PAGE_STRIP = 24,          // most frames of one clip
    RG_PAGE_GATES = 30,          // most gates; the page shows their history
};

// Adds a file of records, a text of Markdown with pictures, or all such files of a folder. False,
// with one logged line that names the file, the place and the mend, if a file is neither.
bool rg_page_add(struct rg_page *page, const char *path);
// Adds the JSON of a record in memory; its pictures lie in the folder of `path`.
bool rg_page_add_text(struct rg_page *page, const char *path, const char *text);
// Logs a lack of memory for a page, and returns false.
bool rg_page_lacks_memory(const char *path);
void rg_page_free(struct rg_page *page);

// Writes the page: one file, which needs no other and no network. With records from `before` (NULL:
// none) it shows what changed since. False, with one logged line, on failure.
bool rg_page_write(const struct rg_page *page, const struct rg_page *before, const char *path);

// The page in short, as text that the caller frees: Markdown for a merge request, below
// RG_PAGE_BRIEF bytes and without pictures; and a badge as SVG. NULL, with one logged line, without
// memory.
enum { RG_PAGE_BRIEF = 60000 };
char *rg_page_markdown(const struct rg_page *page);
char *rg_page_badge(const struct rg_page *page);

// --- the parts ---

// The state of a claim on all devices together.
enum rg_page_stand {
    RG_STAND_HOLDS, // reproduced on a device, refuted on none
    RG_STAND_MIXED, // either on some
    RG_STAND_FAILS,
    RG_STAND_FITS,   // undecided, and fits by figures of one launch
    RG_STAND_MISSES, // undecided, and misses by such figures on some device
    RG_STAND_OPEN,
    RG_STANDS
};
// Counts the claims that have verdicts on a machine (NULL: on any) by their state there; `claims`
// may be NULL. Returns their number.
int rg_page_stands(const json_t *claims, const char *machine, int counts[RG_STANDS]);
// Whether the verdicts of a claim on a device differ between machines. Those not seen do not count.
bool rg_page_differs(const json_t *claim, const char *device);
// The claims that were judged from the page's tables, or else those of its records, as in "claims"
// of docs/records.schema.json; the caller owns the document. NULL if there are none.
json_t *rg_page_claims(const struct rg_page *page);

// Whether a field of an object is this text.
bool rg_page_is(const json_t *object, const char *field, const char *value);

// The printed rows of a table's paper, as {about, technique, paper, names, keys, columns, rows,
// variants}, which the caller owns. NULL if no such table is known.
json_t *rg_page_printed(const char *table);

// Embed pictures: those that the document of a record in `folder` names, or those in a text of
// Markdown, with the captions below them, and those that papers print. Only PNG and EXR from the
// record's folder, the current one, and those below is taken, so that a foreign record cannot have
// a private picture published. Linear values are kept of EXR files that are compared. False, with
// one logged line, without memory, or if an EXR is damaged.
bool rg_page_add_pictures(struct rg_page *page, const char *folder, const json_t *document);
bool rg_page_add_gallery(struct rg_page *page, const char *folder, const char *markdown);

#endif
