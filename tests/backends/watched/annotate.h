// What annotate.c has seen of libgomp.
#ifndef RG_TESTS_BACKENDS_WATCHED_ANNOTATE_H
#define RG_TESTS_BACKENDS_WATCHED_ANNOTATE_H

// How often a thread has joined another one's parallel region until now: without any there is
// nothing to race with.
int annotated_helpers(void);

#endif
