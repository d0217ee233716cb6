// Long texts as lines.
#ifndef RG_CORE_BASE_TEXT_WRAP_H
#define RG_CORE_BASE_TEXT_WRAP_H

// How many bytes of a text stand in a line of so many columns: up to a blank, or all of the columns
// where there is none. `*rest` is what follows behind the blanks; "" at the end.
int rg_wrap(const char *text, int columns, const char **rest);

#endif
