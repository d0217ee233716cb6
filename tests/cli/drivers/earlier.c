// A clock that is set back again and again, for LD_PRELOAD: every EARLIER_EVERY-th question for the
// time of day sets it back by EARLIER_BY_S seconds. The clock since the machine's start goes on, as
// it does when a person or a server sets the time.
#include <dlfcn.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/time.h>
#include <time.h>

static long of_environment(const char *name)
{
    const char *value = getenv(name);
    return value && atol(value) > 0 ? atol(value) : 1;
}

static time_t set_back_by(void)
{
    static atomic_long asked;
    return ++asked / of_environment("EARLIER_EVERY") * of_environment("EARLIER_BY_S");
}

int clock_gettime(clockid_t clock, struct timespec *now)
{
    int (*next)(clockid_t, struct timespec *) =
        (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
    const int status = next(clock, now);
    if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)
        now->tv_sec -= set_back_by();
    return status;
}

time_t time(time_t *told)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (told)
        *told = now.tv_sec;
    return now.tv_sec;
}

int gettimeofday(struct timeval *told, void *zone)
{
    struct timespec now;
    (void)zone;
    clock_gettime(CLOCK_REALTIME, &now);
    *told = (struct timeval){now.tv_sec, now.tv_nsec / 1000};
    return 0;
}
