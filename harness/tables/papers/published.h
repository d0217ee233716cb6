// Published tables: their cells and printed numbers.
#ifndef RG_HARNESS_TABLES_PAPERS_PUBLISHED_H
#define RG_HARNESS_TABLES_PAPERS_PUBLISHED_H

#include <stdbool.h>
#include <stddef.h>

enum { RG_TABLE_ROWS = 64, RG_TABLE_VALUES = 10, RG_TABLE_VARIANTS = 10, RG_TABLE_WORKS = 4 };
enum { RG_TABLE_COUNTED = 4 };

// A row: settings of the technique and printed values. Assignments are "key=value key=value", as
// for --set; "" for none.
struct rg_table_row {
    const char *set;                // "panes=glass model=bunny"
    double values[RG_TABLE_VALUES]; // in the order of the table's columns
    const char *name;               // "glass with bunny", for tables with named rows or of textures
};

// A variant of each row that is timed: "full", or one with fewer features that the paper also
// timed.
struct rg_table_variant {
    const char *name; // "no_geometry"
    const char *set;  // assignments over the row's
    // The column of its printed frame rate: "fps_no_geometry". NULL if nothing is published, or if
    // times are, from ms_per_frame_min to ms_per_frame_max.
    const char *fps;
};

// A work: how much a row's cells do. "paper" is the printed work, "reading" another reading of it,
// "ours" the same picture for less, and "queries" the printed work with the API's own occlusion
// queries. A table without works has cells of one kind, without a name.
struct rg_table_work {
    const char *name;
    const char *set;   // assignments over the row's and the variant's
    const char *saves; // one line about what saves work; "" for the printed work
    // For "queries": assignments that give the same image on devices without queries. NULL: every
    // device can do the work. A table is measured without this work if no device has queries.
    const char *elsewhere;
    // One line about the reading of an ambiguous paper: "two textures a light (section 4.4.2)".
    // NULL: unambiguous.
    const char *reading;
};

struct rg_table {
    const char *id;        // "stuppacher-2"
    const char *technique; // "flow"
    const char *about;     // one line
    const char *hardware;  // the paper's; NULL: nothing is published, and all columns are keys
    const char *names;     // meaning of the rows' names: "scene"; NULL: no names
    const char *columns[RG_TABLE_VALUES + 1]; // as in results/published/ID.csv, NULL after the last
    // The first so many columns are settings that identify rows; the first of them is the axis
    // along which frame rates fall. 0: no axis, so that only the order of rows can be reproduced.
    int key_count;
    // Columns of parameters with choices have the choice's index in rows, and its name for readers:
    // "on". False: printed as numbers.
    bool has_choices;
    struct rg_table_variant variants[RG_TABLE_VARIANTS + 1]; // the last has no name
    struct rg_table_work works[RG_TABLE_WORKS + 1];          // likewise
    const char *truth; // assignments over a row's that switch off approximations, for the image
                       // against which its error is computed; NULL: no such column
    // Nothing is timed. A row is about the technique's texture of its name, at the level in the
    // column "level"; devices report "width_px" and "height_px".
    bool is_of_textures;
    // Quick mode's assignments over rows and variants, to save work: "atlas=small"; NULL: none.
    const char *quick;
    // A budget's further assignments for pictures of a fourth and of half the width and height.
    // They reduce the drawn things by as much as the pixels, so that the shape of curves stays.
    // NULL: none.
    const char *smaller[2];
    // Assignments over these for comparing a row's image with the truth, which restore what smaller
    // pictures omit. NULL: none.
    const char *shown;
    // The rows of quick mode: the first so many, and those with claims; 0: all.
    int quick_rows;
    // Counters with a column for their growth in a frame, NULL after the last.
    const char *counted[RG_TABLE_COUNTED + 1];
    // The most rows whose cells are open and visited in turn at the same time; 0: as many as memory
    // allows.
    int rows_at_once;
    int check_frames;  // before images are compared; 0: RG_CHECK_FRAMES
    int window_frames; // frames after these, timed repeatedly (struct rg_job); 0: any later ones
    int width, height; // of the image, in pixels
    int row_count;     // at most RG_TABLE_ROWS
    const struct rg_table_row *rows;
    const char *note; // one-line note that readers of the table need
    bool is_own;      // from a user's file, and of no paper
};

// Quick mode's assignments for a size divisor of 4, 2 or 1; the caller frees them. NULL, and one
// logged line, when memory runs out.
char *rg_table_quick(const struct rg_table *table, int divisor);
// The key of the paper that it is of; "" for none.
const char *rg_table_paper(const struct rg_table *table);
bool rg_table_is_published(const struct rg_table *table);
// The number in a row's column; NAN if the table has no such column.
double rg_table_value(const struct rg_table *table, int row, const char *column);
// The same for readers: "1000", or the name of a choice, "on".
void rg_table_value_text(const struct rg_table *table, int row, int column, char *text,
                         size_t size);
// Whether a column has names of choices.
bool rg_table_is_choice(const struct rg_table *table, int column);
// The printed frame rate of a row and variant; NAN if there is none.
double rg_table_published_fps(const struct rg_table *table, int row, int variant);
// Whether a column is neither a key nor a frame rate: "vertices".
bool rg_table_is_extra(const struct rg_table *table, int column);

#endif
