#include "harness/compare/bisect/blanks.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

// In which quotes of the shell's a place of the line is.
enum quotes { NONE, SINGLE, DOUBLE };

// A text while it grows: it has room for what is put into it.
struct made {
    char *end;
};

static void put(struct made *made, const char *text, size_t length)
{
    memcpy(made->end, text, length);
    made->end += length;
}

// What the shell reads as one character of a text, in quotes.
static void put_character(struct made *made, char c, enum quotes quotes)
{
    if (quotes == DOUBLE && strchr("\\\"$`", c))
        put(made, "\\", 1);
    if (quotes == SINGLE && c == '\'')
        put(made, "'\\'", 3); // ends the quotes, has a quote, and begins them again
    put(made, &c, 1);
}

static void put_quoted(struct made *made, const char *text, enum quotes quotes)
{
    const enum quotes within = quotes == NONE ? SINGLE : quotes;
    if (quotes == NONE)
        put(made, "'", 1);
    for (; *text; text++)
        put_character(made, *text, within);
    if (quotes == NONE)
        put(made, "'", 1);
}

// The blank that begins here, and what fills it; NULL: none does.
static const char *blank_at(const char *line, const struct rg_blanks *blanks, size_t *length)
{
    const struct {
        const char *blank, *text;
    } all[] = {{"{}", blanks->candidate}, {"{good}", blanks->good}, {"{budget}", blanks->budget}};
    for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
        *length = strlen(all[i].blank);
        if (all[i].text && !strncmp(line, all[i].blank, *length))
            return all[i].text;
    }
    return NULL;
}

static enum quotes behind(char c, enum quotes quotes)
{
    if (c == '\'' && quotes != DOUBLE)
        return quotes == SINGLE ? NONE : SINGLE;
    if (c == '"' && quotes != SINGLE)
        return quotes == DOUBLE ? NONE : DOUBLE;
    return quotes;
}

// The most bytes that the line comes to.
static size_t room_for(const char *line, const struct rg_blanks *blanks)
{
    enum { A_CHARACTER = 4, QUOTES = 2 };
    size_t room = 1, length;
    for (; *line; line++) {
        const char *text = blank_at(line, blanks, &length);
        room += text ? A_CHARACTER * strlen(text) + QUOTES : 1;
    }
    return room;
}

char *rg_blanks_fill(const char *line, const struct rg_blanks *blanks)
{
    char *text = rg_alloc(1, room_for(line, blanks), "bisect");
    struct made made = {text};
    enum quotes quotes = NONE;
    while (text && *line) {
        size_t length;
        const char *filled = blank_at(line, blanks, &length);
        if (filled) {
            put_quoted(&made, filled, quotes);
        } else {
            length = *line == '\\' && quotes != SINGLE && line[1] ? 2 : 1;
            if (length == 1)
                quotes = behind(*line, quotes);
            put(&made, line, length);
        }
        line += length;
    }
    return text;
}
