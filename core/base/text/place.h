// The place in a file that error messages name.
#ifndef RG_CORE_BASE_TEXT_PLACE_H
#define RG_CORE_BASE_TEXT_PLACE_H

// Puts "PLACE: " before each error from now on, so that an error from code that knows nothing of
// files still names its place. NULL ends that. `place` is not copied and must live until then. Not
// thread-safe.
void rg_log_place(const char *place);

#endif
