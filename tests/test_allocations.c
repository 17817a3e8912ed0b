/* SPDX-License-Identifier: Apache-2.0
 *
 * Memory that runs out at any allocation: whatever asks for it says so, gives back what it had, and
 * works when it is asked again. The n-th fails, and all after it, for n from 1 until nothing fails.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "allocations.h"
#include "catmull_clark.h"
#include "mesh_info.h"
#include "model.h"
#include "obj.h"
#include "reference.h"
#include "shape.h"

/* Fails at each allocation in turn. work says whether it was done; what it leaves is freed by it.
 */
typedef bool worker(hs_error *err);

static void assert_survives(worker *work, const char *what) {
    uint32_t n = 0;
    for (bool done = false; !done;) {
        hs_error err = {0};
        const size_t before = allocations.held;
        start_failing(++n, true);
        done = work(&err);
        const bool failed = stop_failing();
        if (allocations.held != before)
            fail_msg("%s: %td bytes are lost when allocation %u fails", what,
                     (ptrdiff_t)(allocations.held - before), n);
        if (!done && !failed) fail_msg("%s: fails for want of nothing: %s", what, err.text);
        if (!done && (err.code != HS_EXIT_INTERNAL || !strstr(err.text, "memory")))
            fail_msg("%s: allocation %u fails, and it says \"%s\" (%d)", what, n, err.text,
                     err.code);
    }
    print_message("%s: %u allocations\n", what, n);
    assert_true(n > 2);
}

/* --- What works on memory ------------------------------------------------------------------------
 */
static const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.5f, 3};
static const char *shape = "cube";
static hs_settings settings;

static bool shaped(hs_error *err) {
    hs_mesh mesh;
    if (!hs_shape_make(&mesh, shape, 0, 1, err)) return false;
    hs_mesh_info info;
    const bool good = hs_mesh_measure(&info, &mesh, err);
    hs_mesh_free(&mesh);
    return good;
}

static bool parsed(hs_error *err) {
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\n"
                               "f 1 2 3 4\nf 2 1 5\nt crease 2/1/0 1 2 3\nt crease 2/1/0 2 1 4\n"
                               "t corner 1/1/0 3 2\n";
    hs_mesh mesh;
    hs_obj_notes notes;
    if (!hs_obj_parse(&mesh, "text", text, sizeof text - 1, true, &notes, err)) return false;
    hs_mesh_free(&mesh);
    return true;
}

static bool in_packet(hs_packet *in, hs_mesh *mesh, hs_error *err) {
    if (!hs_shape_make(mesh, shape, 0, 1, err)) return false;
    if (hs_packet_encode(in, 0, mesh, matrix, &settings, err)) return true;
    hs_packet_free(in);
    hs_mesh_free(mesh);
    return false;
}

static bool by_golden(hs_error *err) {
    hs_packet in = {0}, out = {0};
    hs_mesh mesh;
    hs_golden_report report;
    if (!in_packet(&in, &mesh, err)) return false;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    bool good = golden || hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    good = good && hs_golden_run(golden, &in, &out, &report, err);
    if (good) {
        hs_output output = {0};
        good = hs_output_decode(&output, &out, err);
        hs_output_free(&output);
    }
    hs_golden_free(golden);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_mesh_free(&mesh);
    return good;
}

static bool by_model(hs_error *err) {
    hs_packet in = {0}, out = {0};
    hs_mesh mesh;
    hs_golden_report report;
    hs_cycle_report cycles;
    hs_log log = {0};
    if (!in_packet(&in, &mesh, err)) return false;
    hs_model *model = hs_model_new(HS_DEFAULT_LIMITS, HS_DEFAULT_CONFIG, err);
    bool good =
        model && hs_model_run(model, &in, (hs_stalls){0}, &out, &report, &cycles, &log, err);
    if (good) { /* a log that lacks entries is equal to none */
        const hs_log_comparison c = hs_log_compare(&log, "model", &log, "model", 0);
        good = !c.different || hs_fail(err, HS_EXIT_INTERNAL, "%s", c.text);
    }
    hs_model_free(model);
    hs_log_free(&log);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_mesh_free(&mesh);
    return good;
}

static bool by_reference(hs_error *err) {
    hs_mesh mesh;
    hs_reference reference = {0}, copy = {0};
    if (!hs_shape_make(&mesh, shape, 0, 1, err)) return false;
    const bool good =
        hs_reference_new(&reference, &mesh, NULL, HS_BOUNDARY_SMOOTH, err) &&
        hs_reference_copy(&copy, &reference, err) && hs_reference_catmull_clark(&copy, err) &&
        hs_reference_step(&reference, NULL, err) && hs_reference_step(&reference, NULL, err) &&
        hs_reference_finish(&reference, err);
    hs_reference_free(&reference);
    hs_reference_free(&copy);
    hs_mesh_free(&mesh);
    return good;
}

/* --- Claims --------------------------------------------------------------------------------------
 */
static void a_shape_survives(void **state) {
    (void)state;
    static const char *const name[] = {"cube", "die", "mixed", "spoon", "hand", "random"};
    for (uint32_t i = 0; i < sizeof name / sizeof *name; i++) {
        shape = name[i];
        assert_survives(shaped, shape);
    }
}

static void an_obj_file_survives(void **state) {
    (void)state;
    assert_survives(parsed, "obj");
}

static void golden_and_the_model_survive(void **state) {
    (void)state;
    shape = "spoon";
    for (uint32_t i = 0; i < 3; i++) {
        settings = i == 0 ? (hs_settings){.uniform = true, .uniform_depth = 4}
                          : (hs_settings){.front_depth = 2, .silhouette_depth = 4, .guard = true};
        settings.boundary = i == 1 ? HS_BOUNDARY_KEPT : HS_BOUNDARY_SMOOTH;
        settings.limit = i == 2;
        assert_survives(by_golden, "golden");
        assert_survives(by_model, "model");
    }
}

static void the_reference_survives(void **state) {
    (void)state;
    shape = "spoon";
    assert_survives(by_reference, "reference");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_survives),
        cmocka_unit_test(an_obj_file_survives),
        cmocka_unit_test(golden_and_the_model_survive),
        cmocka_unit_test(the_reference_survives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
