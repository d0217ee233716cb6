#include "tests/backends/watched/planted.h"

#include <omp.h>
#include <sched.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/device/device.h"
#include "kernels/probe/copy_params.h"

enum { THREADS = 4, WORDS = 1 << 16 };

// Volatile, so that the compiler keeps the work that leads to it.
static volatile int64_t sum;

static struct rg_buf *make_buf(struct rg_device *device, const char *name)
{
    uint32_t *zeroes = calloc(WORDS, sizeof(*zeroes));
    struct rg_buf *buf = zeroes ? rg_buf_create_with(device, zeroes, WORDS * 4, name) : NULL;
    if (!buf)
        exit(EXIT_FAILURE);
    free(zeroes);
    return buf;
}

// Runs a kernel on cpu, which divides its passes among threads.
static void run_kernel(const char *kernel, const void *params, int width, int height)
{
    struct rg_device *device = rg_device_open("cpu");
    struct rg_pass *pass = device ? rg_pass_create(device, kernel) : NULL;
    if (!pass)
        exit(EXIT_FAILURE);
    struct rg_buf *one = make_buf(device, "one"), *two = make_buf(device, "two");
    if (!rg_pass_run(pass, &(struct rg_run){.params = params,
                                            .slots = {[1].buf = one, [2].buf = two},
                                            .extent = {width, height, 1}}))
        exit(EXIT_FAILURE);
    rg_pass_destroy(pass);
    rg_buf_destroy(one);
    rg_buf_destroy(two);
    rg_device_close(device);
}

// In the wrong form, items of all rows write the first row's words.
static void items_of_a_kernel(bool is_right)
{
    enum { WIDTH = 512, HEIGHT = WORDS / WIDTH };
    run_kernel("probe_copy", &(probe_copy_params){is_right ? WIDTH : 0, HEIGHT, 1}, WIDTH, HEIGHT);
}

// Each thread writes a part, and then reads its neighbour's.
static void threads_at_a_barrier(bool is_right)
{
    int parts[THREADS] = {0};
#pragma omp parallel num_threads(THREADS)
    {
        const int me = omp_get_thread_num();
        for (int round = 0; round < 3; round++) {
            parts[me] = me + round;
#pragma omp barrier
            const int read = parts[(me + 1) % THREADS];
            if (is_right) {
#pragma omp barrier
            }
#pragma omp atomic
            sum += read;
        }
    }
}

// Each thread adds to the same number.
static void threads_in_turn(bool is_right)
{
#pragma omp parallel num_threads(THREADS)
    if (is_right) {
#pragma omp critical
        sum += omp_get_thread_num();
    } else {
        sum += omp_get_thread_num();
    }
}

// The same, with the code that gcc uses when the processor has no instruction for it: libgomp.
static void threads_adding(bool is_right)
{
    static long double whole;
#pragma omp parallel num_threads(THREADS)
    if (is_right) {
#pragma omp atomic
        whole += omp_get_thread_num();
    } else {
        whole += omp_get_thread_num();
    }
    sum += (int64_t)whole;
}

// Pieces of a loop, handed out one at a time, write beside each other, or all to one place. Each
// waits until a second thread has a piece; the wait orders nothing.
static void pieces_of_a_loop(bool is_right)
{
    static int pieces[8], begun;
#pragma omp parallel for schedule(dynamic, 1) num_threads(THREADS)
    for (int i = 0; i < 8; i++) {
        __atomic_fetch_add(&begun, 1, __ATOMIC_RELAXED);
        while (__atomic_load_n(&begun, __ATOMIC_RELAXED) < 2)
            sched_yield();
        pieces[is_right ? i : 0] += i;
    }
    sum += pieces[0];
}

// A region's writes are read after it has ended, or overwritten by another thread while it runs.
static void a_region_and_the_next(bool is_right)
{
    int written[THREADS] = {0};
#pragma omp parallel num_threads(THREADS)
    {
        written[omp_get_thread_num()] = 1;
        if (!is_right)
            written[THREADS - 1 - omp_get_thread_num()] = 2;
    }
#pragma omp parallel num_threads(THREADS)
#pragma omp atomic
    sum += written[THREADS - 1 - omp_get_thread_num()];
}

// A task makes a task of its own; in the wrong form a task's result is read without waiting for the
// task. The reader spins until another thread has run it, which orders nothing.
static void tasks(bool is_right)
{
    static int made[4];
    static bool is_done;
#pragma omp parallel num_threads(THREADS)
    {
#pragma omp single nowait
        {
            made[0] = 1;
#pragma omp task
            {
#pragma omp task
                made[1] = made[0];
                made[2] = made[0];
                __atomic_store_n(&is_done, true, __ATOMIC_RELAXED);
            }
            while (!is_right && !__atomic_load_n(&is_done, __ATOMIC_RELAXED))
                sched_yield();
            if (!is_right)
                made[3] = made[2];
        }
#pragma omp barrier
#pragma omp atomic
        sum += made[1] + made[2];
    }
    sum += made[3];
}

// Compares two values; in the wrong form the second one is not set.
static void a_value(bool is_right)
{
    int *values = malloc(2 * sizeof(*values));
    if (!values)
        exit(EXIT_FAILURE);
    values[0] = 1;
    if (is_right)
        values[1] = 2;
    if (values[0] > *(volatile int *)&values[1])
        puts("above");
    free(values);
}

const struct planted planted_values = {"a value", a_value};

const struct planted planted_races[] = {
    {"items of a kernel", items_of_a_kernel},
    {"threads at a barrier", threads_at_a_barrier},
    {"threads in turn", threads_in_turn},
    {"threads adding", threads_adding},
    {"pieces of a loop", pieces_of_a_loop},
    {"a region and the next", a_region_and_the_next},
    {"tasks", tasks},
    {NULL, NULL},
};
