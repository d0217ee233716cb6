"""verify and diff: states, images and laws compared, mutants judged, outcomes counted."""
from fault import Fault

TESTS = ("verify", "differing", "blame", "image diff", "exit", "command line, wrong", "command line, cases")

DEVICES, MUTANTS = "harness/compare/verify/proof.c", "harness/compare/verify/mutants.c"
POSES = "harness/compare/verify/poses.c"
SNAPSHOT, CHECKS = ("harness/compare/verify/snapshot.c", "harness/compare/verify/checks.c")
REPORT = "harness/compare/diff/report.c"
CASE, SHRINK = "harness/compare/shrink/case.c", "harness/compare/shrink/shrink.c"
REPLAY = "harness/compare/shrink/replay.c"
CULPRIT, FOLDER = "harness/compare/shrink/culprit.c", "harness/compare/shrink/folder.c"
SEARCH, ENTRIES, FILES = "harness/compare/shrink/search.c", "harness/compare/shrink/entries.c", "harness/compare/shrink/files.c"
RECORDER = "harness/devices/frames/recorder.c"
CONTENTS, STAGES = "core/techniques/stages/contents.c", "core/techniques/stages/stages.c"
BLAME, DIFFERENCE = "harness/compare/blame/blame.c", "harness/compare/blame/difference.c"

SHRINKING = ("command line, shrinking",)

ROWS = [
    Fault("harness/commands/comparing/verify.c", "if («check_frames(o)» && choose_all(arguments", "true", "stages of no frame are compared, and pass"),
    Fault("harness/compare/diff/devices.c", "rg_outcome_set(row, «outcome»);", "RG_OK", "diff tells that a driver which fell is well", tests=("command line, misbehaving",)),
    Fault(REPORT, "rg_plain(plain);", ";", "a file's name steers the terminal"),
    Fault(SNAPSHOT, "for (int i = 0; equal && i < «a->state_count»; i++)", "0", "states are never compared"),
    Fault(SNAPSHOT, "return a_bytes == b_bytes && «!memcmp(a, b, a_bytes)»;", "true", "states of one size are the same"),
    Fault(SNAPSHOT, "return «same(a->texels, a->texels_bytes, b->texels, b->texels_bytes)»;", "true", "images are never compared"),
    Fault(CONTENTS, "(int)(word % (size_t)state->row) «- state->margin»,", "+ 0", "an element's place is told with the margin"),
    Fault(CONTENTS, "first = «differing ? first : i»;", "i", "the last element is told as the first that differs"),
    Fault(CONTENTS, "const char letter = *words ? words[«word % (int64_t)strlen(words)»] : RG_WORD_UINT;", "0", "all words of a struct are as its first"),
    Fault(CONTENTS, "words[word % (int64_t)strlen(words)] : «RG_WORD_UINT»;", "RG_WORD_FLOAT", "words that nobody tells of are floats"),
    Fault(CONTENTS, "(uint16_t)(value << «(15 - bits)»)", "4", "all small floats have 11 bits"),
    Fault(STAGES, "const char *words = by && asset->buf ? words_of(by, asset->buf) : NULL;\n    for (int i = 0; «!words» && asset->buf", "false", "no other stage tells of the words"),
    Fault(CULPRIT, "const bool keeps = «differs(p)»;", "true", "a kernel's inputs are zeroed whether it needs them or not", tests=SHRINKING),
    Fault(CULPRIT, "    culprit->items = items_of(p->due);\n    «shrink_inputs(p);»", "", "a kernel's inputs stay whole", tests=SHRINKING),
    Fault(DEVICES, "if («rg_snapshot_same_state(now, &c->expected)»)", "true", "a state that differs passes"),
    Fault(DEVICES, "if («row->tier != RG_T0») {\n        tally->unlike++;", "true", "a state that differs is left to the image on every tier"),
    Fault(DEVICES, "if («rg_snapshot_same_image(now, &c->expected)»)", "true", "an image that differs passes"),
    Fault(DEVICES, "else if («row->tier == RG_T0»)\n        check_t0", "false", "an image that owes T0 is judged by the tier's rule"),
    Fault(DEVICES, "if (rg_comparison_outcome(&comparison, «tier») == RG_FAIL)", "RG_T2", "every image is judged by T2"),
    Fault(DEVICES, "«blame(tally, c, \"%s (%s)\", comparison.tiers.of[tier].why, rg_tier_name(tier))»;", "(void)c", "a tier that does not hold passes"),
    Fault(DEVICES, "if («rg_session_obeys(session, &v->technique->proof->laws[i], detail, sizeof(detail))»)", "true", "laws are not asked"),
    Fault(DEVICES, "while (count < MAX_LAWS && v->technique->proof->laws[count].name)\n        count++;", ";", "a technique's laws are not counted"),
    Fault(DEVICES, "if (session && «rg_session_draw(session)» && rg_snapshot_take", "true", "the image is that before the last draw"),
    Fault(DEVICES, "if (!c->with_dry || «memcmp(c->dry.texels, c->expected_picture.texels, bytes)»)", "true", "an image without rain proves something"),
    Fault(DEVICES, "const double value = first + seed <= param->max ? «first + seed» : first - seed;", "first", "each seed is the first one"),
    Fault(DEVICES, "if (t->is_bad_input)\n        return RG_EXIT_USAGE;", ";", "bad input ends as a device's error"),
    Fault(DEVICES, "return is_reference && t->errors ? «rg_exit_of(t->ended)» : RG_EXIT_PASS;", "RG_EXIT_PASS", "a reference that failed proves something"),
    Fault(DEVICES, "if («t->failed»)\n        rg_checks_add", "t->failed > 1", "one failure passes"),
    Fault(DEVICES, "for (int seed = 0; seed < «RG_VERIFY_SEEDS»; seed++) {", "1", "one seed is verified"),
    Fault(MUTANTS, "bool rejected = «!comparison.tiers.of[verdicts->told.tier].holds» &&", "true", "every mutant counts as killed"),
    Fault(MUTANTS, "bool rejected = «!comparison.tiers.of[verdicts->told.tier].holds» &&", "!comparison.tiers.of[RG_T0].holds", "a rounding counts as a mutant's death"),
    Fault(MUTANTS, "const double own = strtod(value, NULL), mutated = own * mutant->factor «+ mutant->offset»;", "+ 0", "mutants have no offset"),
    Fault(MUTANTS, "const bool is_one = «mutated != own» && mutated >= param->min", "true", "the model itself is tried as a mutant"),
    Fault(MUTANTS, "if («!is_one» && !*verdicts->fault)", "false", "a mutant out of its parameter's range is passed over"),
    Fault(MUTANTS, "if («verdicts->error»)\n        rg_checks_add_failure", "false", "a mutant that fails passes"),
    Fault(DEVICES, "else if («t->errors»)\n        rg_checks_add", "false", "a run that fails passes"),
    Fault(POSES, "const int steps = «quick > part ? quick : part»;", "part", "usual runs are shorter than quick ones"),
    Fault(POSES, "(«full + USUAL_PART - 1») / USUAL_PART;", "full", "a part of the steps is cut off, not rounded up"),
    Fault(POSES, "return «full == RG_POSE_LEFT_OUT || steps > full» ? full : steps;", "false", "usual runs may be longer than full ones"),
    Fault(POSES, "return length == RG_VERIFY_QUICK ? «quick» : full;", "full", "quick runs are full ones"),
    Fault(POSES, "return «v->length == RG_VERIFY_FULL» || place == 0", "false", "full runs have one seed of most poses"),
    Fault(POSES, "own == RG_POSE_LEFT_OUT || v->steps < 0 ? own : «v->steps»;", "own", "the user's steps are ignored"),
    Fault(MUTANTS, "else if («killed == told->run && told->run»)", "told->run", "a mutant that lives passes"),
    Fault(CHECKS, "counts[checks->rows[i].status]++;", "counts[RG_OK]++;", "every check counts as ok"),
    Fault(CHECKS, "const int exit = rg_exit_worse(«checks->exit», rg_exit_of_all(counts));", "RG_EXIT_PASS", "an error that no check tells is forgotten"),
    Fault(CHECKS, "if («failure->fault == RG_FAULT_INPUT»)", "false", "the user's error is a device's"),
    Fault(BLAME, "if («p->hash != q->hash» || p->stages_run", "false", "a stage's contents are not compared"),
    Fault(BLAME, "return a->count == b->count ? -1 : «count»;", "-1", "a run of fewer stages is the same"),
    Fault(BLAME, "blame->x = «(int)(byte % layer / texel % width)»;", "(int)(byte % layer / texel)", "a texel's column is told as its number"),
    Fault(BLAME, "blame->y = (int)(byte % layer / texel / «width»);", "1", "a texel's row is told as its number"),
    Fault(BLAME, "(int)d->frame «+ 1» : run->frames", "- 1", "a second run ends before what is asked for"),
    Fault(BLAME, "if (part.frames == run->frames)\n            break;", "break;", "only the first frame is blamed"),
    Fault(DIFFERENCE, "if («any(&p, has_nan)»)", "false", "a NaN is another value"),
    Fault(DIFFERENCE, "number != RG_NUMBER_CODE && «(bits & exponent) == exponent»;", "false", "no float is endless"),
    Fault(DIFFERENCE, "if (has_before && «all(&p, is_left)»)", "any(&p, is_left)", "one missing item makes all missing"),
    Fault(DIFFERENCE, "if (has_before && «all(&p, was_due_so)»)", "false", "surplus is not told"),
    Fault(DIFFERENCE, "const bool same = count && «!memcmp(now, due, (size_t)(count * element_bytes))»;", "true", "all elements are the same"),
    Fault(DIFFERENCE, "qsort(now, (size_t)count, (size_t)element_bytes, by_bytes);", ";", "elements are compared as they lie"),
    Fault(DIFFERENCE, "bits & sign ? «-(int64_t)(bits & ~sign)» : (int64_t)bits", "(int64_t)bits", "small floats on both sides of zero are far apart"),
    Fault(DIFFERENCE, "if («all(&p, is_in_last_bits)»)", "any(&p, is_in_last_bits)", "one float in the last bits makes all so"),
    Fault(DIFFERENCE, "«!has_near(p->due, a, x, y)» || !has_near(p->now, b, x, y)", "false", "a value that the truth has nowhere lies at an edge"),
    Fault(DIFFERENCE, "for (int v = y > 0 ? y - 1 : 0; «v <= y + 1» && v < c->desc.height; v++)", "true", "an edge may lie anywhere below"),
    Fault(DIFFERENCE, "bool is = «!is_whole(number)»;", "true", "integers are last bits from each other"),
    Fault(DIFFERENCE, "return «state->words ? 4 * (int)strlen(state->words) : 4»;", "4", "an element is a word"),
    Fault(SHRINK, "run.frames = «s->blame.first.frame > 1 ? (int)s->blame.first.frame : 1»;", "s->best.frames", "frames are not shrunk", tests=SHRINKING),
    Fault(REPLAY, "const bool is_same = «hash == c->expected»;", "true", "every device leaves what is expected", tests=SHRINKING),
    Fault(REPLAY, "return «knows_asset(digests, c->asset)» ||", "true", "a case of an asset that is no more is a device that draws otherwise", tests=SHRINKING),
    Fault(REPLAY, "while (row < digests->count && («digests->rows[row].stages_run != c->stages_run» ||", "false", "a case is judged behind the first stage that wrote the asset", tests=SHRINKING),
    Fault(CULPRIT, "return !p->has_failed && !p->falls && «!leaves_same(&p->now, p->due)»;", "true", "every kernel is the one", tests=SHRINKING),
    Fault(CULPRIT, "keeps = «differs(p)»;\n        if (!keeps) {\n            *origin = first + half;", "false", "the first half of the items is never kept", tests=SHRINKING),
    Fault(CULPRIT, "halve(p, &origin->width, &extent->width);", ";", "items along x stay as they are", tests=SHRINKING),
    Fault(RECORDER, "return r->ok && «r->stages_run == r->watched - 1»;", "r->stages_run == r->watched", "the next stage is kept", tests=SHRINKING),
    Fault(FOLDER, "d->origin.width «+ d->extent.width»,", "+ 0", "the block ends where it begins", tests=SHRINKING),
    Fault(FOLDER, "memcpy(block + sizeof(at), d->params, (size_t)d->kernel->params_size);", ";", "a kernel's parameters are all 0", tests=SHRINKING),
    Fault(SHRINK, "if («try_size(s, LEAST_PX, LEAST_PX)»)", "true", "the picture is not shrunk", tests=SHRINKING),
    Fault(SHRINK, "shrink_kind(s, RG_PARAM_INT, shrink_count);", ";", "counts are not shrunk", tests=SHRINKING),
    Fault(SHRINK, "«restore_defaults(s);»\n    shrink_kind(s, RG_PARAM_CHOICE", ";", "what does not matter stays", tests=SHRINKING),
    Fault(SHRINK, "shrink_kind(s, RG_PARAM_CHOICE, shrink_choice);", ";", "stages that do not matter stay", tests=SHRINKING),
    Fault(SEARCH, "«now->rows[row].weight <= most_weight» &&", "true", "values that change nothing are taken", tests=SHRINKING),
    Fault(SEARCH, "!strcmp(now->rows[row].stage, s->blame.first.stage)", "true", "another stage is as good", tests=SHRINKING),
    Fault(ENTRIES, "if (!any || «!try_without(s, param, e, ending)»)", "true", "files stay as they are", tests=SHRINKING),
    Fault(FILES, "strchr(name, '/')", "NULL", "a case reads files from anywhere", tests=SHRINKING),
    Fault(CASE, "if («!comes_once(text, keys)»)", "false", "the last of two settings of a case counts", tests=("command line, shrinking",)),
    Fault(CASE, "if (!strcmp(value, initial))\n        return;", "return;", "a case tells no settings", tests=SHRINKING),
    Fault(CULPRIT, "«!is_packer(p->due->kernel)») && differs(p)", "true", "what packs is tried where it cannot run", tests=SHRINKING),
    Fault("core/image/compare/tiers.c", "«!tiers->of[tier].holds»)\n        tier++", "tiers->of[tier].holds", "a tier that fails would hold", tests=SHRINKING),
    Fault("harness/compare/diff/accepts.c", "rg_verify_mutants_at(&verify, «tier», &accepts->of[tier])", "RG_T1", "mutants are told of T1, whichever tier holds", tests=SHRINKING),
]
