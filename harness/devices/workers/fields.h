// Describes the contents of a message once, as fields of a struct. The struct is sent and received
// by this table, so that the receiver checks everything in it.
//
//   static const struct rg_field fields[] = {
//       RG_FIELD_INTEGER(struct fact, count, 0, 9),
//       RG_FIELD_NAME(struct fact, name),
//       RG_FIELDS_END,
//   };
#ifndef RG_HARNESS_DEVICES_WORKERS_FIELDS_H
#define RG_HARNESS_DEVICES_WORKERS_FIELDS_H

#include <stddef.h>

#include "harness/devices/workers/message.h"

enum rg_field_kind {
    RG_KIND_END,
    RG_KIND_INTEGER, // of 1, 4 or 8 bytes, from `least` to `most`; also bools and enums
    RG_KIND_NUMBER,  // a double from `least` to `most`; never NaN
    RG_KIND_BYTES,   // bytes with any values
    RG_KIND_TEXT,    // a text that ends within its array
    RG_KIND_NAME,    // a const char * of `least` bytes or more, valid for the process's life; NULL
                     // if empty
    RG_KIND_STRUCT,  // a struct with the fields `of`
    RG_KIND_BLOCK,   // a pointer to a block of memory; its size is the size_t at `count`
    RG_KIND_LIST,    // a pointer to rows, each with the fields `of`; their number is the int at
                     // `count`, their capacity the int64_t at `room`
    RG_KIND_OWN,     // a struct with functions of its own (struct rg_field_way)
    RG_KIND_CHECK,   // no field: the struct is damaged if `holds` returns false
};

// Functions for a struct that no table describes. `take` fills a zeroed struct; false, with one
// logged line, on failure. `free` then frees what was taken; NULL: there is nothing to free.
struct rg_field_way {
    void (*put)(struct rg_message *message, const void *entry);
    bool (*take)(struct rg_message *message, void *entry);
    void (*free)(void *entry);
};

// A field of a struct; RG_FIELDS_END ends a table of them.
struct rg_field {
    enum rg_field_kind kind;
    size_t offset, size; // of one entry, or of one row of a list
    int64_t least, most; // of a list: of its number of rows
    size_t entries;      // number of elements of an array
    bool is_counted;     // the int at `count` says how many of them are used
    size_t count, room;  // offsets
    const struct rg_field *of;
    const struct rg_field_way *way;
    bool (*holds)(const void *all);
};

#define RG_FIELD_OF(kind, S, field, ...)                                                           \
    {                                                                                              \
        RG_KIND_##kind, offsetof(S, field), sizeof(((S *)0)->field), .entries = 1, __VA_ARGS__     \
    }
#define RG_FIELD_INTEGER(S, field, from, to)                                                       \
    RG_FIELD_OF(INTEGER, S, field, .least = (from), .most = (to))
#define RG_FIELD_FLAG(S, field) RG_FIELD_INTEGER(S, field, 0, 1)
#define RG_FIELD_NUMBER(S, field, from, to)                                                        \
    RG_FIELD_OF(NUMBER, S, field, .least = (from), .most = (to))
#define RG_FIELD_BYTES(S, field)         RG_FIELD_OF(BYTES, S, field, .least = 0)
#define RG_FIELD_TEXT(S, field)          RG_FIELD_OF(TEXT, S, field, .least = 0)
#define RG_FIELD_NAME(S, field)          RG_FIELD_OF(NAME, S, field, .least = 1)
#define RG_FIELD_NAME_OR_NONE(S, field)  RG_FIELD_OF(NAME, S, field, .least = 0)
#define RG_FIELD_STRUCT(S, field, table) RG_FIELD_OF(STRUCT, S, field, .of = (table))
#define RG_FIELD_BLOCK(S, field, bytes)  RG_FIELD_OF(BLOCK, S, field, .count = offsetof(S, bytes))
// An array of integers or structs.
#define RG_FIELD_INTEGERS(S, field, from, to)                                                      \
    {                                                                                              \
        RG_KIND_INTEGER, offsetof(S, field), sizeof(((S *)0)->field[0]),                           \
            .least = (from), .most = (to), .entries = RG_FIELD_ENTRIES(S, field)                   \
    }
#define RG_FIELD_STRUCTS(S, field, table)                                                          \
    {                                                                                              \
        RG_KIND_STRUCT, offsetof(S, field), sizeof(((S *)0)->field[0]),                            \
            .entries = RG_FIELD_ENTRIES(S, field), .of = (table)                                   \
    }
// The same with an int for the number of used elements.
#define RG_FIELD_SOME(S, field, number, table)                                                     \
    {                                                                                              \
        RG_KIND_STRUCT, offsetof(S, field), sizeof(((S *)0)->field[0]),                            \
            .entries = RG_FIELD_ENTRIES(S, field), .is_counted = true,                             \
            .count = offsetof(S, number), .of = (table)                                            \
    }
#define RG_FIELD_LIST(S, field, table, highest)                                                    \
    {                                                                                              \
        RG_KIND_LIST, offsetof(S, field), sizeof(((S *)0)->field[0]),                              \
            .most = (highest), .entries = 1, .count = offsetof(S, count),                          \
            .room = offsetof(S, room), .of = (table)                                               \
    }
#define RG_FIELD_ENTRIES(S, field) (sizeof(((S *)0)->field) / sizeof(((S *)0)->field[0]))
// A whole struct, by functions of its own.
#define RG_FIELD_OWN(S, functions)                                                                 \
    {                                                                                              \
        RG_KIND_OWN, .size = sizeof(S), .entries = 1, .way = (functions)                           \
    }
// The last field before the end: a condition on several fields.
#define RG_FIELD_CHECK(function)                                                                   \
    {                                                                                              \
        RG_KIND_CHECK, .entries = 1, .holds = (function)                                           \
    }
#define RG_FIELDS_END                                                                              \
    {                                                                                              \
        RG_KIND_END                                                                                \
    }

void rg_put_fields(struct rg_message *message, const struct rg_field *fields, const void *all);
// Zero `all` before. False, with one logged line, if the message is damaged. Blocks and lists
// received until then stay in `all`, which the caller frees in either case.
bool rg_take_fields(struct rg_message *message, const struct rg_field *fields, void *all);
// Frees blocks and lists, and structs by their own functions.
void rg_free_fields(const struct rg_field *fields, void *all);

#endif
