"""The page: the records and pictures that it takes, its contents, and its short forms."""
from fault import Fault

TESTS = ("the page",)
VALUES = ("values of the page",)

RECORDS, PICTURES, PAGE = "harness/report/records.c", "harness/report/pictures/pictures.c", "harness/report/page.c"
CODES, LINEAR = "harness/report/pictures/codes.c", "harness/report/pictures/linear.c"
BRIEF, STANDS = "harness/report/brief.c", "harness/report/stands.c"

ROWS = [
    Fault(RECORDS, "if («json_integer_value(format) != RG_FORMAT_VERSION»)", "false", "a record of a newer format is shown as one of this"),
    Fault(RECORDS, "if («rg_page_is(record, \"machine\", machine)»)", "false", "a table of two files has two verdicts on each claim"),
    Fault(RECORDS, "if («++page->gates <= RG_PAGE_GATES»)", "true", "a thousand gates are a page that no browser opens"),
    Fault(RECORDS, "json_object_del(measured, \"samples_ms\");", ";", "every sample is in the page"),
    Fault(PICTURES, "realpath(path, found) && «(is_below(found, folder) || is_below(found, \".\"))»", "true", "a record has a private picture published"),
    Fault(PICTURES, "(path[length] == '/' || «whole[length - 1] == '/'»)", "true", "a folder whose name begins alike is below"),
    Fault(PICTURES, "«!memcmp(bytes, png_begins, sizeof(png_begins))»;", "true", "a text is taken for a picture"),
    Fault(PICTURES, "const bool is_smaller = «webp && (!png || webp_size < size)»;", "false", "pictures take a half more than they need"),
    Fault(PICTURES, "(mark == '>' && «**at == '>'» &&", "true", "the paper's caption loses letters"),
    Fault(LINEAR, "worst = «spreads[i] > spreads[worst]» ? i : worst;", "spreads[i] > 0", "the last texel that differs counts as the worst", tests=VALUES),
    Fault(LINEAR, "return !differs ? 0 : «is_finite» ? most - least : INFINITY;", "true", "a texel that is no number is not the worst", tests=VALUES),
    Fault(LINEAR, "(size_t)«window->width» * sizeof(*spreads)", "1", "the three worst are one place", tests=VALUES),
    Fault(LINEAR, "const bool is_told = «number» && is_same", "true", "the first picture's values are left out", tests=VALUES),
    Fault(CODES, "config.exact = «1»;", "0", "colours of a transparent pixel are lost", tests=("pictures of the page",)),
    Fault(CODES, "if («memmem(png, size, \"acTL\", 4)»)", "false", "of an animation one frame is left", tests=("pictures of the page",)),
    Fault(PAGE, "if («buffer[i] == '<'»)", "false", "a text of a record ends the page's data"),
    Fault(BRIEF, "if («c == '@'»)", "false", "a text calls a user"),
    Fault(BRIEF, "«brief->size + (size_t)length > RG_PAGE_BRIEF - ROOM_FOR_END»", "false", "a merge request is told more than it takes"),
    Fault(BRIEF, "(rg_page_is(record, \"kind\", \"gate\") && «i != last_gate»)", "false", "gates of earlier runs are told as found now"),
    Fault(BRIEF, "for (int i = 0; i < «4»; i++) {\n        f.wanted = statuses[i];", "3", "a merge request is not told which checks fail"),
    Fault(STANDS, "if («holds || fails»)", "holds && fails", "figures of one launch go before verdicts"),
    Fault("harness/report/brief.c", "(«i && strcmp(title, paper) != 0»)", "i > 1 && strcmp(title, paper) != 0", "a badge of two papers has the name of one", tests=("the page",)),
]
