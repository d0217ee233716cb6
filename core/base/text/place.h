// Where in a file the work stands that may log an error.
#ifndef RG_CORE_BASE_TEXT_PLACE_H
#define RG_CORE_BASE_TEXT_PLACE_H

// Puts "PLACE: " before each error from now on, so that a refusal from below, which knows nothing
// of files, is still one line that names its place. NULL: no longer. Not copied: it lives until
// then. Not thread-safe.
void rg_log_place(const char *place);

#endif
