// Makes text from anywhere fit for every form.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_TEXTS_H
#define RG_HARNESS_COMPARE_GATE_REPORT_TEXTS_H

#include <stdbool.h>
#include <stddef.h>

// A cleaned UTF-8 copy, as report.h describes it, in one line or several; the caller frees it.
// NULL, and one logged line, without memory.
char *rg_texts_clean(const char *text, bool is_line);

// The most bytes, up to `size`, at which clean text can be cut between characters.
size_t rg_texts_fit(const char *text, size_t size);

#endif
