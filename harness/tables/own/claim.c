// Claims in a table's file.
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/pair.h"
#include "core/base/text/words.h"
#include "harness/tables/own/reading.h"

static int find_test(const char *name)
{
    struct rg_nearest nearest = {0};
    for (int i = 0; i < RG_CLAIM_TESTS; i++) {
        if (!strcmp(rg_claim_forms[i].name, name))
            return i;
        rg_nearest_try(&nearest, name, rg_claim_forms[i].name);
    }
    rg_error("claim '%.80s': no such test; the nearest is '%s'", name, nearest.name);
    return -1;
}

// --- what a test is told ---

static bool take_rows(const struct rg_own *own, const char *key, const char *text, int *first,
                      int *last)
{
    const int rows = rg_own_rows(own);
    if (rg_range_read(text, first, last) && *first >= 1 && *last >= *first && *last <= rows)
        return true;
    return rg_error("%s=%.80s: write it as FIRST-LAST, of rows 1-%d; rows stand before claims", key,
                    text, rows);
}

static bool take_variant(const struct rg_own *own, const char *key, const char *text,
                         const char **variant)
{
    *variant = text;
    return rg_own_has_variant(own, text) ||
           rg_error("%s=%.80s: no variant before this line has that name", key, text);
}

// Takes one word, and adds what it tells to *told.
static bool take_word(const struct rg_own *own, struct rg_claim *claim, const char *key,
                      const char *value, int *told)
{
    if (!strcmp(key, "rows"))
        return take_rows(own, key, value, &claim->first, &claim->last);
    if (!strcmp(key, "variant"))
        return take_variant(own, key, value, &claim->variant);
    if (!strcmp(key, "section")) {
        claim->where = value;
        return true;
    }
    if (!strcmp(key, "knee")) {
        *told |= RG_CLAIM_KNEE;
        return take_rows(own, key, value, &claim->knee, &claim->until);
    }
    if (!strcmp(key, "other")) {
        *told |= RG_CLAIM_OTHER;
        return take_variant(own, key, value, &claim->other);
    }
    const bool is_least = !strcmp(key, "least");
    if (!is_least && strcmp(key, "most") != 0)
        return rg_error("claim: '%.80s' is no word of it; there are rows, least, most, knee, "
                        "variant, other and section",
                        key);
    *told |= is_least ? RG_CLAIM_LEAST : RG_CLAIM_MOST;
    return rg_own_number(key, value, is_least ? &claim->least : &claim->most);
}

static bool is_told(const char *test, int needs, int told)
{
    static const char *const names[] = {"least", "most", "knee", "other"};
    for (int i = 0; i < 4; i++) {
        const int bit = 1 << i;
        if ((needs & bit) && !(told & bit))
            return rg_error("claim %s: needs a number; add %s=", test, names[i]);
        if ((told & bit) && !(needs & bit))
            return rg_error("claim %s: has no use for %s=; take it out", test, names[i]);
    }
    return true;
}

static bool is_sound(const struct rg_own *own, const struct rg_claim *claim, const char *test,
                     int needs)
{
    if (claim->test == RG_CLAIM_ORDER && !own->printed_count)
        return rg_error("claim %s: is about printed rates, and no row has any; write them after a "
                        "bar, as in resolution_px=512 | fps=87",
                        test);
    if (claim->test == RG_CLAIM_FLATTENS && !own->table.truth)
        return rg_error("claim %s: is about errors; say by a line 'truth KEY=VALUE' before it what "
                        "has none",
                        test);
    if ((needs & RG_CLAIM_KNEE) && (claim->knee < claim->first || claim->until > claim->last))
        return rg_error("claim %s: its knee lies outside of its rows", test);
    return (needs & (RG_CLAIM_LEAST | RG_CLAIM_MOST)) != (RG_CLAIM_LEAST | RG_CLAIM_MOST) ||
           claim->least <= claim->most ||
           rg_error("claim %s: least=%g is more than most=%g", test, claim->least, claim->most);
}

// Only words in quotation marks are those of a source.
static bool take_words(struct rg_claim *claim, char *words)
{
    const size_t length = words ? strlen(words) : 0;
    if (!length)
        return rg_error("claim: has no words; write them after a bar, as in claim falls | gets "
                        "slower with more texels");
    claim->words = words;
    claim->source = RG_CLAIM_PRINTED;
    if (length > 2 && words[0] == '"' && words[length - 1] == '"') {
        words[length - 1] = 0;
        claim->words = words + 1;
        claim->source = RG_CLAIM_SAID;
    }
    char title[RG_CLAIM_TITLE];
    rg_claim_title(claim, title);
    return strlen(title) < RG_CLAIM_TITLE - 1 ||
           rg_error("claim: its words are too long; say it in %d letters", RG_CLAIM_TITLE - 40);
}

bool rg_own_take_claim(struct rg_own *own, char *text)
{
    if (own->claim_count == RG_OWN_CLAIMS - 1) // the last one ends them
        return rg_error("claim: more than %d; leave some out", RG_OWN_CLAIMS - 1);
    char *words = rg_own_behind(text), *rest = rg_line_cut(text), *key, *value;
    const char *base = strrchr(own->lines.name, '/');
    const int test = find_test(text);
    struct rg_claim claim = {.table = own->table.id,
                             .variant = own->table.variants[0].name,
                             .where = base ? base + 1 : own->lines.name,
                             .first = 1,
                             .last = rg_own_rows(own),
                             .is_ours = true};
    int told = 0;
    if (test < 0)
        return false;
    if (!claim.last)
        return rg_error("claim: no row stands before it");
    const int needs = rg_claim_forms[test].needs;
    claim.test = (enum rg_claim_test)test;
    while (*rest)
        if (!rg_own_pair(&rest, &key, &value) || !take_word(own, &claim, key, value, &told))
            return false;
    if (!is_told(text, needs, told) || !is_sound(own, &claim, text, needs) ||
        !take_words(&claim, words))
        return false;
    own->claims[own->claim_count++] = claim;
    return true;
}
