// Long texts as lines.
#ifndef RG_CORE_BASE_TEXT_WRAP_H
#define RG_CORE_BASE_TEXT_WRAP_H

// The length in bytes of a text's first line of up to `columns` columns: it ends at a blank, or
// fills all columns where there is none. `*rest` is what follows after the blanks; "" at the end.
int rg_wrap(const char *text, int columns, const char **rest);

#endif
