// Published tables: which cells each has, and the numbers in print.
#ifndef RG_HARNESS_TABLES_TABLES_H
#define RG_HARNESS_TABLES_TABLES_H

// One row: a setting of the technique, as --set would take it, and what the paper printed.
struct rg_table_row {
    const char *label; // as the paper names it
    const char *set;   // "resolution_px=128"
    double axis;       // the row's place on the axis of the shape verdict
    double fps;        // published
};

struct rg_table {
    const char *id;        // "stuppacher-2"
    const char *technique; // "flow"
    const char *about;     // one line
    const char *hardware;  // what the paper measured on
    const char *axis;      // name of the rows' column: "texture_px"
    int width, height;     // of the image, in pixels
    int row_count;
    const struct rg_table_row *rows;
    const char *note; // what a reader of the table must know, one line
};

// All tables, NULL-terminated, made by the build from the list in harness/meson.build.
extern const struct rg_table *const rg_tables[];

// The table of this id, or NULL.
const struct rg_table *rg_table_find(const char *id);

#endif
