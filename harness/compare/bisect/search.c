#include "harness/compare/bisect/search.h"

#include <stdlib.h>

struct rg_search rg_search_of(const enum rg_judgement *verdicts, int64_t count)
{
    struct rg_search search = {.good = 0, .bad = count - 1};
    for (int64_t i = 0; i < count; i++) {
        if (verdicts[i] == RG_JUDGED_BAD) {
            search.bad = i;
            break;
        }
        if (verdicts[i] == RG_JUDGED_GOOD) {
            search.good = i;
            search.left = 0;
        }
        search.left += verdicts[i] == RG_JUDGED_NONE;
    }
    return search;
}

int64_t rg_search_next(const struct rg_search *search, const enum rg_judgement *verdicts)
{
    int64_t next = -1, longest = 0, nearest = 0;
    for (int64_t first = search->good + 1, end; first < search->bad; first = end + 1) {
        for (end = first; end < search->bad && verdicts[end] == RG_JUDGED_NONE;)
            end++;
        const int64_t length = end - first, middle = first + (length - 1) / 2;
        const int64_t distance = llabs(2 * middle - search->good - search->bad);
        if (length > longest || (length == longest && length > 0 && distance < nearest)) {
            next = middle;
            longest = length;
            nearest = distance;
        }
    }
    return next;
}

int rg_search_steps(const struct rg_search *search)
{
    int steps = 0;
    for (int64_t left = search->left; left > 0; left /= 2)
        steps++;
    return steps;
}
