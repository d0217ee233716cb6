// Tells ThreadSanitizer about the order that libgomp keeps. gcc's libgomp is built without
// ThreadSanitizer. Without this file the latter sees neither a barrier nor the end of a parallel
// region, and reports races between them. This file wraps each entry of libgomp that orders
// threads; libgomp's own entry does the work. A region has its own places, at which its threads
// release and acquire order, so that no false order hides a race.
#define _GNU_SOURCE // RTLD_NEXT
#include "tests/backends/watched/annotate.h"

#include <dlfcn.h>
#include <omp.h>
#include <sanitizer/tsan_interface.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void work_function(void *data);

// A parallel region, on the stack of the thread that began it. The address of a char is a place of
// order.
struct region {
    work_function *work;
    void *data;
    char begun, ended, tasks_ended;
    char met[2]; // of barriers in turn: a thread may be at the next one while others leave
};

static _Thread_local struct region *mine; // NULL: outside all regions
static _Thread_local int barriers;        // those that this thread met in its region
static char in_critical, in_atomic;
static int helpers;

int annotated_helpers(void)
{
    return __atomic_load_n(&helpers, __ATOMIC_RELAXED);
}

void GOMP_parallel(work_function *work, void *data, unsigned threads, unsigned flags);
void GOMP_parallel_loop_nonmonotonic_dynamic(work_function *work, void *data, unsigned threads,
                                             long start, long end, long step, long chunk,
                                             unsigned flags);
void GOMP_barrier(void);
void GOMP_loop_end(void);
void GOMP_critical_start(void);
void GOMP_critical_end(void);
void GOMP_atomic_start(void);
void GOMP_atomic_end(void);
void GOMP_task(work_function *work, void *data, void (*copy)(void *to, void *from), long size,
               long align, bool is_deferred, unsigned flags, void **depends, int priority,
               void *detached);

static void *next(const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found) {
        fprintf(stderr, "%s: libgomp has none\n", name);
        abort();
    }
    return found;
}
// libgomp's own function of the name, after this file's. Looked up each time, since a shared place
// for it would be a race of its own.
#define NEXT(name) __typeof__(name) *own = (__typeof__(name) *)next(#name)

// --- regions ---

static void enter(void *data)
{
    struct region *region = data, *outer = mine;
    const int outer_barriers = barriers;
    __tsan_acquire(&region->begun);
    mine = region;
    barriers = 0;
    __atomic_fetch_add(&helpers, omp_get_thread_num() > 0, __ATOMIC_RELAXED); // relaxed: no order
    region->work(region->data);
    __tsan_release(&region->ended);
    mine = outer;
    barriers = outer_barriers;
}

static void leave(struct region *region)
{
    __tsan_acquire(&region->ended);
    __tsan_acquire(&region->tasks_ended);
}

void GOMP_parallel(work_function *work, void *data, unsigned threads, unsigned flags)
{
    NEXT(GOMP_parallel);
    struct region region = {.work = work, .data = data};
    __tsan_release(&region.begun);
    own(enter, &region, threads, flags);
    leave(&region);
}

void GOMP_parallel_loop_nonmonotonic_dynamic(work_function *work, void *data, unsigned threads,
                                             long start, long end, long step, long chunk,
                                             unsigned flags)
{
    NEXT(GOMP_parallel_loop_nonmonotonic_dynamic);
    struct region region = {.work = work, .data = data};
    __tsan_release(&region.begun);
    own(enter, &region, threads, start, end, step, chunk, flags);
    leave(&region);
}

// The two sides of a barrier.
static char *arrive(void)
{
    char *place = mine ? &mine->met[barriers++ % 2] : NULL;
    if (place)
        __tsan_release(place);
    return place;
}

static void go_on(char *place)
{
    if (!place)
        return;
    __tsan_acquire(place);
    __tsan_acquire(&mine->tasks_ended);
}

void GOMP_barrier(void)
{
    NEXT(GOMP_barrier);
    char *place = arrive();
    own();
    go_on(place);
}

// A loop without `nowait` ends in a barrier.
void GOMP_loop_end(void)
{
    NEXT(GOMP_loop_end);
    char *place = arrive();
    own();
    go_on(place);
}

// --- one thread after the other ---

void GOMP_critical_start(void)
{
    NEXT(GOMP_critical_start);
    own();
    __tsan_acquire(&in_critical);
}

void GOMP_critical_end(void)
{
    NEXT(GOMP_critical_end);
    __tsan_release(&in_critical);
    own();
}

void GOMP_atomic_start(void)
{
    NEXT(GOMP_atomic_start);
    own();
    __tsan_acquire(&in_atomic);
}

void GOMP_atomic_end(void)
{
    NEXT(GOMP_atomic_end);
    __tsan_release(&in_atomic);
    own();
}

// --- tasks ---

struct task {
    work_function *work;
    struct region *region;
    char made;
    _Alignas(max_align_t) char data[];
};

static void run_task(void *data)
{
    struct task *task;
    memcpy(&task, data, sizeof(task));
    __tsan_acquire(&task->made);
    struct region *outer = mine, *region = task->region;
    mine = region;
    task->work(task->data);
    mine = outer;
    free(task);
    __tsan_release(&region->tasks_ended);
}

// Flags of tasks that wait for other tasks, or that end on request.
enum { DEPENDS = 8, DETACHED = 64, UNTOLD = DEPENDS | DETACHED };

// A task waits only for a barrier or its region's end. Other kinds are refused, since their order
// is not annotated.
void GOMP_task(work_function *work, void *data, void (*copy)(void *to, void *from), long size,
               long align, bool is_deferred, unsigned flags, void **depends, int priority,
               void *detached)
{
    NEXT(GOMP_task);
    struct task *task = mine && !(flags & UNTOLD) && align <= (long)_Alignof(max_align_t)
                            ? malloc(sizeof(*task) + (size_t)size)
                            : NULL;
    if (!task) {
        fprintf(stderr, "GOMP_task: a kind of task that is not annotated yet\n");
        abort();
    }
    task->work = work;
    task->region = mine;
    if (copy)
        copy(task->data, data);
    else
        memcpy(task->data, data, (size_t)size);
    __tsan_release(&task->made);
    own(run_task, &task, NULL, sizeof(task), sizeof(task), is_deferred, flags, depends, priority,
        detached);
}
