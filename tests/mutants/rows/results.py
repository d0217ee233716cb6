"""Tables and claims: which rows are heard, how orders are judged, trends, costs and what is prepared."""
from fault import Fault

TESTS = ("claims", "papers", "figures", "sheets", "regenerate", "journal", "command line, tables", "command line, results")

JUDGE, HEARING, ORDER, PRINTED = ("harness/tables/claims/judge.c", "harness/tables/claims/hearing.c",
                                  "harness/tables/claims/order.c", "harness/tables/claims/printed.c")
TREND, COSTS, PREPARE, BEGIN = ("harness/tables/sheet/trend.c", "harness/tables/sheet/costs.c",
                                "harness/tables/prepare.c", "harness/tables/begin.c")

ROWS = [
    Fault(JUDGE, "if (!parts->count || «against > parts->against») {", "against < parts->against", "a claim is as sure as its surest part"),
    Fault(JUDGE, "h->judgement.in_favour = fmin(1, parts->in_favour «* parts->count»);", "* 1", "the number of parts is not corrected for"),
    Fault(JUDGE, "if (parts->count && «h->judgement.against <= ERROR_SHARE»)", "h->judgement.against <= 0.05", "a claim needs 90 % alone"),
    Fault(JUDGE, "rg_hearing_row(h, h->rows[i]), «rg_hearing_row(h, h->rows[i + 1])», 1);", "rg_hearing_row(h, h->rows[0])", "every row is held against the first"),
    Fault(JUDGE, "low = fmin(low, 1000 / «rg_hearing_row(h, h->rows[i])->frame_ms.high»);", "rg_hearing_row(h, h->rows[i])->frame_ms.median", "a rate's interval begins at its median"),
    Fault(JUDGE, "«1 / apart»);", "apart", "rows that are alike must differ"),
    Fault(JUDGE, "const double against = j.against;\n    «j.against = j.in_favour;»", ";", "apart is judged by alike's probability"),
    Fault(JUDGE, "first - knee >= «h->claim->least * (knee - last)» && first > knee;", "knee - last", "a knee need not be one"),
    Fault(JUDGE, "axis[i] = «log(axis_at(h, h->rows[i]))»;", "axis_at(h, h->rows[i])", "a power is a slope"),
    Fault(HEARING, "at.row = row «- 1»;", "- 0", "claims hear the row below"),
    Fault("harness/record/record.c", "ratio = «fmax(*due / *found, *found / *due)»;", "*due / *found", "more particles than in print are the same work"),
    Fault("harness/record/record.c", "return «ratio > SAME_COUNT»;", "false", "other work is judged"),
    Fault(HEARING, "if («can_miss(c, row)»)\n                continue;\n            rg_hearing_end(h, RG_CLAIM_UNDECIDED", "true", "a claim's first row may be missing"),
    Fault("harness/record/result.c", "if («!*result->works[i].saves» && strcmp", "true", "our own work is held for the printed one"),
    Fault(ORDER, "below += x < high[j] ? 1 : x > high[j] ? 0 : «0.5»;", "1", "a tie counts as below"),
    Fault(ORDER, "now[u] * i / «(i + j)» : 0;", "(i + j + 1)", "probabilities of orders do not add up to 1"),
    Fault(ORDER, "for (int u = m * n; «u >= pairs»; u--)", "u > pairs", "a probability leaves out its own outcome"),
    Fault(ORDER, "sqrt(mean * (low_count + high_count «+ 1») / 6)", "- 8", "the spread of many samples' orders is too small"),
    Fault(ORDER, "0.5 * erfc((pairs «- 0.5» - mean)", "- 0.0", "many samples' orders have no continuity correction"),
    Fault(PRINTED, "return «print_apart(h) > c->most»;", "false", "a table that contradicts its text is not told"),
    Fault(PRINTED, "least = fmin(least, «printed_fps(h, h->rows[i], h->at.variant)»);", "printed_fps(h, h->rows[0], h->at.variant)", "the slowest printed row is the first"),
    Fault(TREND, "trend->pairs += «order != 0»;", "1", "rows that are equal in print order something"),
    Fault(TREND, "trend->pairs_in_order += «order * (measured[row] - measured[other]) > 0»;", "order * (measured[row] - measured[other]) < 0", "trends are judged upside down"),
    Fault(TREND, "const double apart = «fabs(trend.slope - trend.published_slope)»;", "trend.slope - trend.published_slope", "a trend that falls too fast is reproduced"),
    Fault(TREND, "if (record->outcome != RG_OK)\n            «return false;»", ";", "a row without a time is part of a trend"),
    Fault(COSTS, "«rg_record_fps(first) / rg_record_fps(record)»,", "rg_record_fps(record) / rg_record_fps(first)", "costs are upside down"),
    Fault(PREPARE, "rg_job_open(job) && «rg_job_check(job, &p->expected)»", "true", "cells are timed without a look at their image"),
    Fault(PREPARE, "(is_open || (rg_job_open(job) && rg_job_check(job, &p->expected))) && rg_job_count(job))\n            «rg_job_warm_up(job, options);»", ";", "cells are timed without a warm-up",
          lives="tables run on the machine's clock, and no record tells of the frames before its samples; the warm-up itself is tested"),
    Fault(PREPARE, "p.jobs[d].record->truth_error = p.truth_error;", "", "the distance from the truth is not kept"),
    Fault(PREPARE, "for (int d = 0; d < p->count; d++)\n        if (p->jobs[d].record->outcome == RG_OK)\n            «rg_record_end(p->jobs[d].record, outcome, why);»", ";", "cells without an image to check them by count as ok"),
    Fault(BEGIN, "result->check_frames = table->check_frames ? «table->check_frames» : RG_CHECK_FRAMES;", "RG_CHECK_FRAMES", "each table is checked after ten frames"),
    Fault(BEGIN, "«result->full || !table->quick ? \"\" : table->quick»,", "\"\"", "quick rows are full ones"),
    Fault(BEGIN, "if («rg_table_is_extra(table, c)»)", "true", "keys are told as printed numbers"),
]
