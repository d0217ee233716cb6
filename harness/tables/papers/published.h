// Published tables: which cells each has, and the numbers in print.
#ifndef RG_HARNESS_TABLES_PAPERS_PUBLISHED_H
#define RG_HARNESS_TABLES_PAPERS_PUBLISHED_H

#include <stdbool.h>
#include <stddef.h>

enum { RG_TABLE_ROWS = 64, RG_TABLE_VALUES = 10, RG_TABLE_VARIANTS = 10, RG_TABLE_WORKS = 4 };
enum { RG_TABLE_COUNTED = 4 };

// One row: settings of the technique and what the paper printed. Assignments are "key=value
// key=value", as --set takes each; "" for none.
struct rg_table_row {
    const char *set;                // "panes=glass model=bunny"
    double values[RG_TABLE_VALUES]; // in the order of the table's columns
    const char *name; // "glass with bunny", in tables whose rows have names, or are of textures
};

// What is timed of each row: "full", and the frames with less in them that the paper also timed.
struct rg_table_variant {
    const char *name; // "no_geometry"
    const char *set;  // over the row's
    // The column that its frame rate is compared with: "fps_no_geometry"; NULL where nothing is
    // published, or where times are, from ms_per_frame_min to ms_per_frame_max.
    const char *fps;
};

// How much work a row's cells do: "paper", what was printed of, "reading", the same as the paper
// can be read otherwise, "ours", the same picture for less, and perhaps "queries", what was printed
// of by the API's own occlusion queries. A table without any has cells of one kind, which it does
// not name.
struct rg_table_work {
    const char *name;
    const char *set;   // over the row's and the variant's
    const char *saves; // what saves work, one line; "" of what was printed
    // Of "queries": what draws the same image on devices that have none, over all these. A table is
    // measured without the work where no device has any. NULL: every device does it.
    const char *elsewhere;
    // How the paper is read, where it can be read in several ways, one line: "two textures a light
    // (section 4.4.2)". NULL: there is one way.
    const char *reading;
};

struct rg_table {
    const char *id;        // "stuppacher-2"
    const char *technique; // "flow"
    const char *about;     // one line
    const char *hardware;  // what the paper measured on; NULL: nothing is published, and all
                           // columns are keys
    const char *names;     // what the rows' names are: "scene"; NULL: none
    const char *columns[RG_TABLE_VALUES + 1]; // as in results/published/ID.csv, NULL after the last
    // So many columns, the first, are settings and tell rows apart. The first of them is the axis
    // along which frame rates fall. 0: there is none, and only the order of rows can be reproduced.
    int key_count;
    // Of columns that are parameters with choices, rows have the choice's index, and readers its
    // name: "on". False: what is printed there is a number.
    bool has_choices;
    struct rg_table_variant variants[RG_TABLE_VARIANTS + 1]; // the last has no name
    struct rg_table_work works[RG_TABLE_WORKS + 1];          // likewise
    const char *truth; // over a row's: an image without its approximations, which gives the error
                       // of the row's own; NULL: no column for that
    // Nothing is timed: a row is about the technique's texture of the row's name, and of it the
    // level in the column "level". Devices tell its "width_px" and "height_px".
    bool is_of_textures;
    // What quick mode sets over rows and variants, for less work: "atlas=small"; NULL: nothing.
    const char *quick;
    // What a budget sets over these for pictures of a fourth of the width and height, and of half:
    // as much less to draw as there are fewer pixels to draw it on, so that shapes stay. NULL:
    // nothing.
    const char *smaller[2];
    // What is set over these where a row's image is compared with the truth: all of what smaller
    // pictures leave out. NULL: nothing.
    const char *shown;
    // So many rows, the first, has quick mode, and those that claims are about; 0: all.
    int quick_rows;
    // Counters of the technique that have a column: what they grow by in a frame, NULL after the
    // last.
    const char *counted[RG_TABLE_COUNTED + 1];
    // At most so many rows have their cells open, and are visited in turn, at the same time; 0: as
    // many as memory holds.
    int rows_at_once;
    int check_frames;  // simulated and drawn before images are compared; 0: RG_CHECK_FRAMES
    int window_frames; // timed behind them, over and over (struct rg_job); 0: whatever follows
    int width, height; // of the image, in pixels
    int row_count;     // at most RG_TABLE_ROWS
    const struct rg_table_row *rows;
    const char *note; // what a reader of the table must know, one line
};

// What quick mode sets where the width and height are divided by 4, 2 or 1; the caller frees it.
// NULL, and one logged line, without memory.
char *rg_table_quick(const struct rg_table *table, int divisor);
bool rg_table_is_published(const struct rg_table *table);
// The number in a row's column; NAN where the table has no such column.
double rg_table_value(const struct rg_table *table, int row, const char *column);
// The same as a reader has it: "1000", or the name of a choice, "on".
void rg_table_value_text(const struct rg_table *table, int row, int column, char *text,
                         size_t size);
// Whether a column has such names.
bool rg_table_is_choice(const struct rg_table *table, int column);
// Frames a second of a row and variant in print; NAN where nothing is.
double rg_table_published_fps(const struct rg_table *table, int row, int variant);
// Whether a column is neither a key nor a frame rate: "vertices".
bool rg_table_is_extra(const struct rg_table *table, int column);

#endif
