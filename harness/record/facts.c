#include "harness/record/facts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/record/passport.h"

static bool is_among(const char *name, const char *const *names)
{
    for (int i = 0; names && names[i]; i++)
        if (!strcmp(names[i], name))
            return true;
    return false;
}

void rg_facts_text(const struct rg_fact *facts, int count, const char *const *except, char *text,
                   size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < count && used < size; i++) {
        if (is_among(facts[i].name, except))
            continue;
        const char *comma = used ? ", " : "";
        const int added = *facts[i].text ? snprintf(text + used, size - used, "%s%s %s", comma,
                                                    facts[i].name, facts[i].text)
                                         : snprintf(text + used, size - used, "%s%s %.15g", comma,
                                                    facts[i].name, facts[i].number);
        used += (size_t)added;
    }
}

const double *rg_facts_number(const struct rg_fact *facts, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (!*facts[i].text && !strcmp(facts[i].name, name))
            return &facts[i].number;
    return NULL;
}

json_t *rg_facts_json(const struct rg_fact *facts, int count)
{
    json_t *json = json_object();
    for (int i = 0; i < count; i++)
        json_object_set_new(json, facts[i].name,
                            *facts[i].text ? rg_json_text(facts[i].text)
                                           : rg_number_json(facts[i].number));
    return json;
}

json_t *rg_counters_json(const struct rg_counter *counters, int count)
{
    json_t *json = json_object();
    for (int i = 0; i < count; i++)
        json_object_set_new(json, counters[i].name, json_integer(counters[i].value));
    return json;
}

json_t *rg_number_json(double number)
{
    if (!isfinite(number))
        return json_null();
    if (number == floor(number) && fabs(number) < 9007199254740992.0)
        return json_integer((json_int_t)number);
    return json_real(number);
}
