// What a newly opened device is asked by: a pass and the buffers that it reads and writes. They are
// made on the backend itself, below core/device, so that no count of work has them.
#ifndef RG_BACKENDS_ASKED_QUESTION_H
#define RG_BACKENDS_ASKED_QUESTION_H

#include "backends/backend.h"

enum { RG_QUESTION_BUFS = 3 };

// Zero all but `device` before. rg_question_end in any case.
struct rg_question {
    struct rg_device *device;
    struct rg_pass *pass;
    struct rg_buf *bufs[RG_QUESTION_BUFS];
};

// Makes the pass of a kernel. False, and one logged line, if the driver fails, here and below.
bool rg_question_pass(struct rg_question *q, const char *kernel);
// Makes a buffer of `size` bytes, and writes `words` into it; NULL: nothing.
bool rg_question_buf(struct rg_question *q, int i, const void *words, size_t size,
                     const char *name);
// Waits, and destroys what was made.
void rg_question_end(struct rg_question *q);

// Notes in the name of the device's API that it draws in another way: "own rounding", "native".
void rg_question_note(struct rg_device *device, const char *own);

#endif
