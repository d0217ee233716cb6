#include "harness/compare/diff/files.h"

#include <stdlib.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/compare/diff/beside.h"
#include "harness/compare/diff/pair.h"
#include "harness/console/exit.h"

static bool print_json(const struct rg_diff_request *request,
                       const struct rg_comparison *comparison, const struct rg_beside *beside)
{
    json_t *pair = rg_pair_json(request->a, request->b, comparison);
    if (pair)
        json_object_set_new(pair, "beside", rg_beside_json(beside));
    json_t *pairs = pair ? json_pack("[o]", pair) : NULL, *failures = json_array();
    const bool good = pairs && rg_pairs_print_json(NULL, NULL, pairs, failures);
    json_decref(pairs);
    json_decref(failures);
    return good;
}

static bool compare(const struct rg_diff_request *request, struct rg_picture *pictures,
                    struct rg_comparison *comparison, struct rg_beside *beside)
{
    struct rg_picture *a = &pictures[0], *b = &pictures[1];
    const char *const paths[] = {request->a, request->b, request->background};
    struct rg_compare_options options = request->options;
    options.hdr_flip = true;
    if (!rg_pictures_read(paths, pictures, request->background ? 3 : 2) ||
        !rg_beside_find(a, request->a, b, request->b, beside) ||
        !rg_picture_widen(a, b, request->a) || !rg_picture_widen(b, a, request->b) ||
        !rg_compare(a, request->a, b, request->b, request->background ? &pictures[2] : NULL,
                    &options, comparison))
        return false;
    rg_beside_judge(beside, comparison);
    return true;
}

int rg_diff_files(const struct rg_diff_request *request)
{
    struct rg_picture pictures[3] = {{0}};
    struct rg_comparison comparison = {0};
    struct rg_beside beside = {0};
    bool good = rg_pair_heatmaps_spare(request->heatmap_prefix, request->a) &&
                rg_pair_heatmaps_spare(request->heatmap_prefix, request->b) &&
                rg_pair_heatmaps_spare(request->heatmap_prefix, request->background) &&
                rg_pair_heatmaps_can_be_written(request->heatmap_prefix, 0) &&
                compare(request, pictures, &comparison, &beside);
    if (good && request->heatmap_prefix)
        good = rg_pair_heatmaps(request->heatmap_prefix, &pictures[0], &pictures[1], &comparison);
    if (good && request->json)
        good = print_json(request, &comparison, &beside);
    else if (good) {
        rg_pair_print(request->a, request->b, &comparison);
        rg_beside_print(&beside);
    }
    const enum rg_outcome outcome = good ? rg_comparison_outcome(&comparison, RG_T0) : RG_ERROR;
    int status = !good                   ? rg_exit_of_error()
                 : outcome == RG_NOTHING ? RG_EXIT_NOTHING
                 : outcome == RG_OK      ? RG_EXIT_PASS
                                         : RG_EXIT_FAIL;
    if (status == RG_EXIT_NOTHING)
        rg_error("%s: has no rain before %s, nor has %s, so that nothing is compared; name "
                 "pictures with rain, or leave --background out",
                 request->a, request->background, request->b);
    rg_comparison_destroy(&comparison);
    free(beside.items);
    for (int i = 0; i < 3; i++)
        rg_picture_destroy(&pictures[i]);
    return status;
}
