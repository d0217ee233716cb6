// Text from anywhere, made fit for every form.
#ifndef RG_HARNESS_COMPARE_GATE_REPORT_TEXTS_H
#define RG_HARNESS_COMPARE_GATE_REPORT_TEXTS_H

#include <stdbool.h>
#include <stddef.h>

// A copy in UTF-8 as report.h says, which the caller frees; of one line, or of several. NULL, and
// one logged line, without memory.
char *rg_texts_clean(const char *text, bool is_line);

// The most bytes of clean text, up to `size`, that end in a whole character.
size_t rg_texts_fit(const char *text, size_t size);

#endif
