// Whether address and undefined-behaviour sanitizers watch this test. What they find they find in
// less of the same work: a law that the build without them holds in full is tried there in part.
#ifndef RG_TESTS_TOOLS_PROCESS_SANITIZED_H
#define RG_TESTS_TOOLS_PROCESS_SANITIZED_H

#ifdef __SANITIZE_ADDRESS__
enum { IS_SANITIZED = 1 };
#else
enum { IS_SANITIZED = 0 };
#endif

#endif
