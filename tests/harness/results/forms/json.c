// Machine-readable forms, and how they and sheets show missing measurements.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>

#include "harness/record/schema/schema.h"
#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"

static void test_json(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 80, 20, 40, 0, 10});
    struct rg_record *second = sheet_record_at(&rig, 0, 1);
    sheet_tell(second, "particles", 70000);
    rg_named_set_text(&second->facts[second->fact_count++], "model", "no UTF-8: \xff");
    sheet_add_pass(second, "a", 3);
    sheet_add_pass(second, "b", 1);
    sheet_record_at(&rig, 0, 0)->truth_error =
        (struct rg_truth_error){.outcome = RG_UNSUPPORTED, .detail = "too much"};
    second->truth_error.flip_mask_mean = 0.5;
    rig.result.missing_count = 2;
    snprintf(rig.result.missing[0], sizeof(rig.result.missing[0]), "gl: none");
    snprintf(rig.result.missing[1], sizeof(rig.result.missing[1]), "vulkan: broken");
    json_t *json = rg_result_json(&rig.result);
    assert_non_null(json);
    const char *set, *variant, *model, *detail, *missing, *broken, *status;
    json_int_t radius, camera, fps, printed, told, fact;
    double a, b, measured_fps, flip;
    json_t *cells = json_object_get(json, "cells");
    assert_int_equal(json_array_size(cells), 6);
    json_t *cell = json_array_get(cells, 1);
    assert_int_equal(0, json_unpack(cell, "{ss, ss, s{sI, sI}, s{sI, sI}, s{sI, ss}}", "set", &set,
                                    "variant", &variant, "row", "radius_m", &radius, "camera",
                                    &camera, "published", "fps", &fps, "particles", &printed,
                                    "facts", "particles", &fact, "model", &model));
    assert_int_equal(0, json_unpack(cell, "{s{sF, sI, s{sF, sF}}, s{sF}}", "measured", "fps",
                                    &measured_fps, "particles", &told, "passes_share", "a", &a, "b",
                                    &b, "error", "flip_mask_mean", &flip));
    assert_int_equal(0, json_unpack(json, "{s[ss]}", "missing", &missing, &broken));
    assert_int_equal(0, json_unpack(json_array_get(cells, 4), "{ss}", "detail", &detail));
    assert_string_equal(set, "geometry=off");
    assert_string_equal(variant, "no_geometry");
    assert_equals(radius, 5);
    assert_equals(camera, 1);
    assert_equals(fps, 800);
    assert_equals(printed, 70303);
    assert_equals(told, 70000);
    assert_equals(fact, 70000);
    assert_string_equal(model, "no UTF-8: ?");
    assert_string_equal(missing, "gl: none");
    assert_string_equal(broken, "vulkan: broken");
    assert_string_equal(detail, "differs");
    assert_float_equal(measured_fps, 80, 1e-9);
    assert_equals(a, 0.75);
    assert_equals(b, 0.25);
    assert_equals(flip, 0.5);
    assert_int_equal(0, json_unpack(json_array_get(cells, 0), "{s{ss, ss}}", "error", "status",
                                    &status, "detail", &detail));
    assert_string_equal(status, "unsupported");
    assert_string_equal(detail, "too much");
    assert_null(json_object_get(json_array_get(cells, 4), "measured"));
    json_decref(json);
    rg_result_free(&rig.result);
}

// Rows after an interruption are left out, and the others get no shape.
static void test_missing_rows(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    rg_result_drop_row(&rig.result, 2);
    rg_result_drop_row(&rig.result, 3);
    rig.result.resumed_rows = 1;
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.row_count, 2);
    assert_true(sheet_has_note(&sheet, "Rows 3 to 4 are missing: the run was interrupted."));
    assert_true(sheet_has_note(&sheet, "Of its rows, 1 were measured by a run"));
    assert_false(sheet_has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    json_t *json = rg_result_json(&rig.result);
    assert_int_equal(json_array_size(json_object_get(json, "cells")), 2);
    assert_true(json_is_true(json_object_get(json, "interrupted")));
    json_decref(json);
    rg_result_free(&rig.result);
}

static void test_unsupported(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 0, 11, 20});
    sheet_record_at(&rig, 1, 0)->outcome = RG_UNSUPPORTED;
    rg_result_sheet(&rig.result, &sheet);
    sheet_expect_text(&sheet, 1, "fps", "unsupported");
    assert_true(sheet_has_note(&sheet, "dragon on cpu: differs"));
    rg_sheet_free(&sheet);
    const char *status;
    json_t *json = rg_result_json(&rig.result);
    assert_int_equal(0, json_unpack(json_array_get(json_object_get(json, "cells"), 1), "{ss}",
                                    "status", &status));
    assert_string_equal(status, "unsupported");
    json_decref(json);
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_json),
        cmocka_unit_test(test_missing_rows),
        cmocka_unit_test(test_unsupported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
