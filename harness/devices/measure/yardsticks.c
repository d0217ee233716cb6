#include "harness/devices/measure/yardsticks.h"

#include <pthread.h>
#include <semaphore.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/clock.h"

#define COPY_BYTES ((size_t)64 << 20)
enum { CHAIN_STEPS = 1000000, VECTOR_STEPS = 1000000, VECTORS = 12, FORKS = 200 };

const char *rg_yardstick_name(enum rg_yardstick yardstick)
{
    static const char *const names[] = {"chain", "vector", "copy", "fork_join"};
    return names[yardstick];
}

// --- arithmetic ---

// Both converge to 1, so that no number becomes too small or too large for full speed.
static float chain(float x)
{
    static volatile float factor = 0.75f, more = 0.25f;
    const float f = factor, m = more;
    for (int i = 0; i < CHAIN_STEPS; i++)
        x = x * f + m;
    return x;
}

// Vectors that all machines have, whatever the code is compiled for, so that the work is the same.
typedef float four __attribute__((vector_size(16)));

static float vectors(float start)
{
    static volatile float factor = 0.75f, more = 0.25f;
    const four f = {factor, factor, factor, factor}, m = {more, more, more, more};
    four x[VECTORS], sum = {0, 0, 0, 0};
    for (int k = 0; k < VECTORS; k++)
        x[k] = m * (start + (float)k);
    for (int i = 0; i < VECTOR_STEPS; i++)
        for (int k = 0; k < VECTORS; k++)
            x[k] = x[k] * f + m;
    for (int k = 0; k < VECTORS; k++)
        sum += x[k];
    return sum[0] + sum[1] + sum[2] + sum[3];
}

// --- two threads ---

struct rg_fork {
    pthread_t thread;
    sem_t begin, end;
    bool is_over;
};

static void *answer(void *user)
{
    struct rg_fork *fork = user;
    for (;;) {
        while (sem_wait(&fork->begin))
            ;
        if (fork->is_over)
            return NULL;
        sem_post(&fork->end);
    }
}

static struct rg_fork *open_fork(void)
{
    struct rg_fork *fork = rg_alloc(1, sizeof(*fork), "yardsticks");
    if (!fork)
        return NULL;
    sem_init(&fork->begin, 0, 0);
    sem_init(&fork->end, 0, 0);
    if (!pthread_create(&fork->thread, NULL, answer, fork))
        return fork;
    free(fork);
    return rg_error_null("yardsticks: no second thread can be started; see `ulimit -u`");
}

static void close_fork(struct rg_fork *fork)
{
    fork->is_over = true;
    sem_post(&fork->begin);
    pthread_join(fork->thread, NULL);
    sem_destroy(&fork->begin);
    sem_destroy(&fork->end);
    free(fork);
}

static void fork_and_join(struct rg_fork *fork)
{
    for (int i = 0; i < FORKS; i++) {
        sem_post(&fork->begin);
        while (sem_wait(&fork->end))
            ;
    }
}

// --- all four ---

bool rg_yardsticks_open(struct rg_yardstick_room *room)
{
    room->from = rg_alloc(1, COPY_BYTES, "yardsticks");
    room->to = room->from ? rg_alloc(1, COPY_BYTES, "yardsticks") : NULL;
    room->fork = room->to ? open_fork() : NULL;
    if (!room->fork)
        return false;
    memset(room->from, 1, COPY_BYTES); // touches all pages before anything is timed
    memset(room->to, 2, COPY_BYTES);
    return true;
}

void rg_yardsticks_close(struct rg_yardstick_room *room)
{
    if (room->fork)
        close_fork(room->fork);
    free(room->to);
    free(room->from);
    *room = (struct rg_yardstick_room){0};
}

double rg_yardstick_take(struct rg_yardstick_room *room, enum rg_yardstick yardstick)
{
    static volatile float kept; // keeps the compiler from removing the work
    const double start_ms = rg_now_ms();
    switch (yardstick) {
    case RG_YARDSTICK_CHAIN:
        kept = chain(kept / 2);
        break;
    case RG_YARDSTICK_VECTOR:
        kept = vectors(kept / 2);
        break;
    case RG_YARDSTICK_COPY:
        memcpy(room->to, room->from, COPY_BYTES);
        break;
    case RG_YARDSTICK_FORK:
        fork_and_join(room->fork);
        break;
    }
    return rg_now_ms() - start_ms;
}
