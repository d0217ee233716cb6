// The claims of all papers, in the order of their tables.
#include "harness/tables/claims/claim.h"

#include <ctype.h>
#include <stdio.h>

#define SAID(table, variant, where, words)    table, variant, NULL, RG_CLAIM_SAID, where, words
#define PRINTED(table, variant, where, words) table, variant, NULL, RG_CLAIM_PRINTED, where, words

// The factor that "notably", "much" and "greatly" require, because no paper gives a number with
// them.
#define NOTABLY 1.2
// A spoken number has the margin of its words: half way to the next number that one would speak of.
#define TIMES(number)   ((number)-0.5) // "doubles", "14 times": whole numbers
#define TO_A_THIRD      2.4            // to less than 5/12, half way from a third to a half
#define SLOWER_25_LEAST (1 / 0.775)    // by 22.5 to 27.5 %: spoken in steps of five
#define SLOWER_25_MOST  (1 / 0.725)
// The least frame rate that Akenine-Moller and others call real time; Creus gives none.
#define REAL_TIME 15

// clang-format off
static const struct rg_claim of_papers[] = {
    // Chin, "Animating Raindrops on a Surface" (2016)
    {SAID("chin-timing", "full", "5", "The simulation runs well at 30fps"),
     .test = RG_CLAIM_RATE, .first = 1, .last = 1, .least = 30},
    {PRINTED("chin-timing", "full", "5", "a frame takes at most 31.8 ms"),
     .test = RG_CLAIM_RATE, .first = 1, .last = 1, .least = 1000 / 31.8},
    // More cells, as in quick mode.
    {SAID("chin-grid", "full", "5.1", "increases ... the computational expense"),
     .test = RG_CLAIM_FALLS, .first = 1, .last = 3},

    // Creus, "Real-time realistic rain rendering" (2010)
    {SAID("creus-5.3", "full", "5.2.1", "decreases as ... is widened"),
     .test = RG_CLAIM_FALLS, .first = 1, .last = 9, .part = "camera 1"},
    {SAID("creus-5.3", "full", "5.2.1", "decreases as ... is widened"),
     .test = RG_CLAIM_FALLS, .first = 10, .last = 18, .part = "camera 2"},
    {SAID("creus-5.3", "full", "5.2.1", "20 meters ... good compromise"),
     .test = RG_CLAIM_FLATTENS, .first = 1, .knee = 4, .last = 8, .least = 3, .is_ours = true,
     .part = "camera 1"},
    {SAID("creus-5.3", "full", "5.2.1", "20 meters ... good compromise"),
     .test = RG_CLAIM_FLATTENS, .first = 10, .knee = 13, .last = 17, .least = 3, .is_ours = true,
     .part = "camera 2"},
    {PRINTED("creus-5.3", "full", "5.2.1", "the rate falls 9 times"),
     .test = RG_CLAIM_RATIO, .first = 1, .last = 9, .least = TIMES(9), .part = "camera 1"},
    {PRINTED("creus-5.3", "full", "5.2.1", "the rate falls 11 times"),
     .test = RG_CLAIM_RATIO, .first = 10, .last = 18, .least = TIMES(11), .part = "camera 2"},
    {SAID("creus-5.4", "full", "5.2.2", "Small values achieve faster framerates"),
     .test = RG_CLAIM_FALLS, .first = 1, .last = 8},
    {SAID("creus-5.4", "full", "5.2.2", "20 meters come as a good trade-off"),
     .test = RG_CLAIM_FLATTENS, .first = 1, .knee = 4, .last = 8, .least = 3, .is_ours = true},
    // Row 5 is the first with more than a million.
    {SAID("creus-5.4", "full", "5.4", "even when handling over a million"),
     .test = RG_CLAIM_RATE, .first = 5, .last = 5, .least = REAL_TIME, .is_ours = true},
    {SAID("creus-5.5", "full", "5.2.3", "the first row ... has worse performance"),
     .test = RG_CLAIM_SLOWEST, .first = 1, .knee = 1, .last = 6},
    // Row 6 is the last with packets below 200,000 that draws the printed number of particles, row
    // 9 the first above (docs/tables.md).
    {SAID("creus-5.5", "full", "5.2.3", "decrease notably ... beyond the 200000"),
     .test = RG_CLAIM_RATIO, .first = 6, .last = 9, .least = NOTABLY, .is_ours = true},
    {SAID("creus-5.5", "full", "5.2.3", "has a subtle effect"),
     .test = RG_CLAIM_ALIKE, .first = 2, .last = 6, .most = 1.3, .is_ours = true,
     .part = "1,000 to 100,000"},
    // Rows after 9 draw other numbers of particles.
    {PRINTED("creus-5.5", "full", "5.2.3", "packets of 1,000 are the fastest"),
     .test = RG_CLAIM_OPTIMUM, .first = 1, .knee = 2, .last = 9},
    {SAID("creus-5.6", "full", "5.2.4", "lights rapidly decrease performance"),
     .test = RG_CLAIM_FALLS, .first = 1, .last = 6},
    {PRINTED("creus-5.6", "full", "5.2.4", "six lights cost 14 times as much as one"),
     .test = RG_CLAIM_RATIO, .first = 1, .last = 6, .least = TIMES(14)},
    {"creus-5.6", "full", "no_geometry", RG_CLAIM_PRINTED, "5.2.4",
     "with geometry faster from four lights on",
     .test = RG_CLAIM_CROSSES, .first = 1, .knee = 4, .last = 6},

    // The grid has the fewest packets.
    {SAID("creus-packets", "rect", "4.3.3", "fewer packets ... better performance"),
     .test = RG_CLAIM_OPTIMUM, .first = 1, .knee = 1, .last = 3},
    {"creus-packets", "hull", "rect", RG_CLAIM_SAID, "5.5", "would increase the framerate",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 3, .least = 1},

    // Feng et al., "Real-time Rain Simulation in Cartoon Style" (2005)
    {SAID("feng-1", "gooch", "6", "varies with the quantity of geometries"),
     .test = RG_CLAIM_APART, .first = 1, .last = 7, .least = 1.1, .is_ours = true},
    {PRINTED("feng-1", "gooch", "6", "scenes differ by less than 5 %"),
     .test = RG_CLAIM_ALIKE, .first = 1, .last = 7, .most = 1.05},
    {SAID("feng-1", "gooch", "6", "runs between 10 and 45 frames"),
     .test = RG_CLAIM_RATE, .first = 1, .last = 7, .least = 10, .part = "at least"},
    {"feng-1", "cartoon", "cartoon_outlines", RG_CLAIM_PRINTED, "6",
     "cartoon is faster without outlines",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 7, .least = 1, .can_wait = true},
    {"feng-1", "cartoon_outlines", "outlines", RG_CLAIM_PRINTED, "6",
     "outlines alone are slower than cartoon",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 7, .least = 1, .can_wait = true},
    {"feng-1", "outlines", "gooch", RG_CLAIM_PRINTED, "6", "outlines alone are faster than Gooch",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 7, .least = 1, .can_wait = true},
    {"feng-1", "gooch", "gooch_outlines", RG_CLAIM_PRINTED, "6",
     "Gooch is faster without outlines",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 7, .least = 1, .can_wait = true},
    {SAID("feng-2", "full", "6", "varies with ... system complexity"),
     .test = RG_CLAIM_FALLS, .first = 1, .last = 5},
    {PRINTED("feng-2", "full", "6", "20,000 drops cost 4 times as much as 6,000"),
     .test = RG_CLAIM_RATIO, .first = 1, .last = 5, .least = TIMES(4)},

    // Stuppacher & Supan, "Rendering of Water Drops in Real-Time" (2007)
    {SAID("stuppacher-1", "full", "6", "models ... influence the frame rate"),
     .test = RG_CLAIM_OPTIMUM, .first = 1, .knee = 1, .last = 5},
    {PRINTED("stuppacher-1", "full", "6", "rates by model stand in print's order"),
     .test = RG_CLAIM_ORDER, .first = 1, .last = 5},
    {SAID("stuppacher-1", "full", "6", "complex models ... 25% slower"),
     .test = RG_CLAIM_TIMES, .first = 1, .last = 2, .least = SLOWER_25_LEAST,
     .most = SLOWER_25_MOST},
    {SAID("stuppacher-2", "full", "6", "influenced by the size of the height map"),
     .test = RG_CLAIM_FALLS, .first = 1, .last = 3},
    {SAID("stuppacher-2", "full", "6", "doubles the frame rate"),
     .test = RG_CLAIM_RATIO, .first = 1, .last = 2, .least = TIMES(2), .part = "at least"},
    {SAID("stuppacher-2", "full", "6", "only a third with the larger texture"),
     .test = RG_CLAIM_RATIO, .first = 2, .last = 3, .least = TO_A_THIRD},
    {PRINTED("stuppacher-2", "full", "6", "larger texture more than halves the rate"),
     .test = RG_CLAIM_RATIO, .first = 2, .last = 3, .least = 2},

    // With an exponent of 0.03, 400 times as many drops cost a sixth of the rate.
    {SAID("stuppacher-drops", "full", "6", "number of drops ... does not influence"),
     .test = RG_CLAIM_EXPONENT, .first = 1, .last = 4, .least = -0.03, .most = 0.03, .is_ours = true},

    // Ye, "Raining Simulation based on Improved Particle Systems algorithms"
    // The traditional system is the one that allocates and frees particles (III.D).
    {"ye-1", "improved", "heap", RG_CLAIM_SAID, "IV", "generated much faster",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 5, .least = NOTABLY, .is_ours = true},
    {"ye-1", "state", "traditional", RG_CLAIM_SAID, "III.A", "greatly reduce the speed",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 5, .least = NOTABLY, .is_ours = true,
     .part = "all attributes"},
    {"ye-1", "segments", "traditional", RG_CLAIM_SAID, "III.A", "greatly increase the cost",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 5, .least = NOTABLY, .is_ours = true,
     .part = "quads"},
    // Section III: "optimized and improved in the following several aspects".
    {"ye-1", "point", "traditional", RG_CLAIM_SAID, "III.B", "time cost ... is large",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 5, .least = 1, .can_wait = true,
     .part = "corners"},
    {"ye-1", "uniform", "traditional", RG_CLAIM_SAID, "III.C", "simplify the motion",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 5, .least = 1, .can_wait = true,
     .part = "uniform"},
    {"ye-1", "promotion", "heap", RG_CLAIM_SAID, "III.D", "greatly improved the performance",
     .test = RG_CLAIM_FASTER, .first = 1, .last = 5, .least = NOTABLY, .is_ours = true},
    {.table = NULL},
};
// clang-format on

const struct rg_claim *rg_claims = of_papers;

const struct rg_claim_form rg_claim_forms[RG_CLAIM_TESTS] = {
    [RG_CLAIM_FALLS] = {"falls", 0},
    [RG_CLAIM_ORDER] = {"order", 0},
    [RG_CLAIM_RATIO] = {"ratio", RG_CLAIM_LEAST},
    [RG_CLAIM_TIMES] = {"times", RG_CLAIM_LEAST | RG_CLAIM_MOST},
    [RG_CLAIM_ALIKE] = {"alike", RG_CLAIM_MOST},
    [RG_CLAIM_APART] = {"apart", RG_CLAIM_LEAST},
    [RG_CLAIM_EXPONENT] = {"exponent", RG_CLAIM_LEAST | RG_CLAIM_MOST},
    [RG_CLAIM_FASTER] = {"faster", RG_CLAIM_OTHER | RG_CLAIM_LEAST},
    [RG_CLAIM_RATE] = {"rate", RG_CLAIM_LEAST},
    [RG_CLAIM_OPTIMUM] = {"optimum", RG_CLAIM_KNEE},
    [RG_CLAIM_SLOWEST] = {"slowest", RG_CLAIM_KNEE},
    [RG_CLAIM_CROSSES] = {"crosses", RG_CLAIM_OTHER | RG_CLAIM_KNEE},
    [RG_CLAIM_FLATTENS] = {"flattens", RG_CLAIM_KNEE | RG_CLAIM_LEAST},
};

bool rg_claim_is_of_each_row(const struct rg_claim *claim)
{
    return claim->test == RG_CLAIM_FASTER || claim->test == RG_CLAIM_RATE;
}

void rg_claim_title(const struct rg_claim *claim, char title[RG_CLAIM_TITLE])
{
    const char *quote = claim->source == RG_CLAIM_SAID ? "\"" : "";
    snprintf(title, RG_CLAIM_TITLE, "%s%s%s%s%s", quote, claim->words, quote,
             claim->part ? ", " : "", claim->part ? claim->part : "");
}

// Characters other than letters and digits separate words, except commas within numbers.
void rg_claim_id(const struct rg_claim *claim, char id[RG_CLAIM_ID])
{
    char title[RG_CLAIM_TITLE];
    int used = snprintf(id, RG_CLAIM_ID, "%s", claim->table);
    char part = '/';
    rg_claim_title(claim, title);
    for (const char *c = title; *c && used + 2 < RG_CLAIM_ID; c++) {
        const bool is_of_word = isalnum((unsigned char)*c);
        if (is_of_word && part)
            id[used++] = part;
        if (is_of_word)
            id[used++] = (char)tolower((unsigned char)*c);
        part = is_of_word ? 0 : *c == ',' || part == '/' ? part : '-';
    }
    id[used] = 0;
}
