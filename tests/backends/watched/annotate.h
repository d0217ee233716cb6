// Counts from annotate.c's view of libgomp.
#ifndef RG_TESTS_BACKENDS_WATCHED_ANNOTATE_H
#define RG_TESTS_BACKENDS_WATCHED_ANNOTATE_H

// How often a thread has joined another's parallel region so far. Without joins there are no races
// to find.
int annotated_helpers(void);

#endif
