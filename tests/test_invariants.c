/* SPDX-License-Identifier: Apache-2.0
 *
 * The invariants of docs/refinement.md, on all built-in shapes, all of ../shared/meshes and its
 * tagged ones, poles, n-gons and cubes with random tags; each in twenty views (around, close,
 * inside, grazing, behind, singular, mirrored), depths 4/8, over all boundary modes, with limit
 * positions and without, with a least edge and without.
 */
#include "invariants.h"
#include "reference_shapes.h"
#include "view.h"

static const hs_limits limits = {1 << 22, 1 << 22};

/* --- Views ---------------------------------------------------------------------------------------
 */

enum { ORBIT = 8, MOST_VIEWS = 20 };

typedef struct {
    uint32_t count;
    hs_view view[MOST_VIEWS];
} view_set;

static void add_matrix(view_set *set, const float matrix[16]) {
    assert_true(set->count < MOST_VIEWS);
    memcpy(set->view[set->count++].matrix, matrix, 16 * sizeof *matrix);
}

/* Eye and target in units of the mesh's size from its middle. */
static void add_look(view_set *set, const double middle[3], double size, const double eye[3],
                     const double at[3], double fov, double near) {
    double e[3], a[3];
    for (int k = 0; k < 3; k++) {
        e[k] = middle[k] + size * eye[k];
        a[k] = middle[k] + size * at[k];
    }
    hs_error err;
    assert_true(set->count < MOST_VIEWS);
    if (!hs_view_look(&set->view[set->count++], e, a, (const double[3]){0, 1, 0.1}, fov, 1,
                      size * near, size * 10, &err))
        fail_msg("%s", err.text);
}

static void measure(const hs_mesh *mesh, double middle[3], double *size) {
    *size = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < mesh->vertices; v++) {
            low = fmin(low, (double)mesh->position[4 * v + k]);
            high = fmax(high, (double)mesh->position[4 * v + k]);
        }
        middle[k] = (low + high) / 2;
        *size = fmax(*size, (high - low) / 2);
    }
}

static view_set views_of(const hs_mesh *mesh) {
    view_set set = {0};
    hs_views orbit;
    hs_error err;
    if (!hs_views_orbit(&orbit, ORBIT, mesh, 1, &err)) fail_msg("%s", err.text);
    for (uint32_t i = 0; i < orbit.count; i++)
        add_matrix(&set, orbit.view[i].matrix);
    hs_views_free(&orbit);

    double m[3], size;
    measure(mesh, m, &size);
    static const struct {
        double eye[3], at[3], fov, near;
    } look[] = {
        {{0.4, 0.3, 1.3}, {0.2, 0.2, 0}, 15, 0.01},     /* close-ups: little of it is in view */
        {{-1.2, 0.6, 0.9}, {-0.5, 0.3, 0.3}, 10, 0.01}, /* */
        {{0.1, 1.6, 0.2}, {0.3, 0, 0.4}, 25, 0.01},     /* */
        {{0, 0, 0}, {1, 0.3, 0.2}, 90, 0.001},          /* from inside */
        {{0.3, -0.2, 0.1}, {-1, 0.1, 0.4}, 60, 0.001},  /* */
        {{4, 1, 0.05}, {0, 1, 0}, 40, 0.1},             /* along its top */
        {{-5, -0.98, 0.3}, {0, -1, 0}, 30, 0.1},        /* along its bottom */
        {{0, 0.2, 3}, {0, 0.3, 8}, 50, 0.1},            /* all of it behind the eye */
        {{0.2, 0, 0.5}, {3, 0.1, 0.6}, 80, 0.01},       /* half of it behind the eye */
    };
    for (size_t i = 0; i < sizeof look / sizeof *look; i++)
        add_look(&set, m, size, look[i].eye, look[i].at, look[i].fov, look[i].near);
    add_matrix(&set, perspective);
    add_matrix(&set,
               (const float[16]){-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2}); /* mirror */
    add_matrix(&set, (const float[16]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}); /* flat */
    return set;
}

/* The twelve combinations of boundary mode, limit and least edge take turns from view to view, and
 * start elsewhere with every mesh. In 20 views each combination has its turn at every mesh. */
static hs_settings settings_for(uint32_t mesh, uint32_t view, bool guard) {
    const uint32_t turn = mesh + view;
    return (hs_settings){.front_depth = 4,
                         .silhouette_depth = 8,
                         .guard = guard,
                         .boundary = (hs_boundary)(turn % 3),
                         .limit = turn / 3 % 2,
                         .min_edge = turn / 6 % 2 ? 6 * HS_PIXEL_FRACTION : 0,
                         .width = 640,
                         .height = 640};
}

/* --- Runs, any failure of which ends the test ----------------------------------------------------
 */

static hs_golden *new_golden(void) {
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    return golden;
}

static void run(hs_golden *golden, const hs_mesh *mesh, const hs_view *view,
                const hs_settings *settings, hs_packet *in, hs_packet *out) {
    hs_golden_report report;
    hs_error err;
    if (!hs_packet_encode(in, 0, mesh, view->matrix, settings, &err) ||
        !hs_golden_run(golden, in, out, &report, &err))
        fail_msg("%s", err.text);
    assert_int_equal(report.status, HS_STATUS_OK);
}

/* --- The claims ----------------------------------------------------------------------------------
 */

static void output_is_conforming_with_and_without_guard(void **state) {
    const samples *all = *state;
    hs_golden *golden = new_golden();
    hs_packet in = {0}, out = {0};
    uint64_t edges = 0, runs = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        const view_set set = views_of(mesh);
        for (uint32_t k = 0; k < 2 * set.count; k++) {
            const hs_settings settings = settings_for(i, k / 2, k % 2 == 0);
            run(golden, mesh, &set.view[k / 2], &settings, &in, &out);
            hs_output output;
            hs_error err;
            if (!hs_output_decode(&output, &out, &err) ||
                !invariant_conforming(&output, mesh, settings.boundary, &edges, &err))
                fail_msg("%s, view %u, guard %d: %s", all->item[i].name, k / 2, settings.guard,
                         err.text);
            hs_output_free(&output);
            runs++;
        }
    }
    print_message("I1: %u meshes, %llu runs, %llu edges\n", all->count, (unsigned long long)runs,
                  (unsigned long long)edges);
    assert_true(edges > 1000000);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_golden_free(golden);
}

static void what_a_view_refines_is_a_part_of_the_uniform_surface(void **state) {
    const samples *all = *state;
    hs_golden *golden = new_golden();
    hs_packet in = {0}, out = {0};
    uniform_record uniform = {0};
    invariant_watch watch = {0};
    uint64_t rings = 0, positions = 0, idle = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        const view_set set = views_of(mesh);
        const uint64_t before = rings + positions;
        for (uint32_t k = 0; k < set.count; k++) {
            const hs_settings settings = settings_for(i, k, true);
            hs_error err;
            if (!uniform_record_make(&uniform, golden, mesh, set.view[k].matrix, &settings, &err))
                fail_msg("%s", err.text);
            const hs_observer observer = invariant_watch_begin(&watch, &uniform);
            hs_golden_observe(golden, &observer);
            run(golden, mesh, &set.view[k], &settings, &in, &out);
            hs_golden_observe(golden, NULL);
            if (!watch.good) fail_msg("%s, view %u: %s", all->item[i].name, k, watch.error.text);
            rings += watch.rings;
            positions += watch.positions;
            idle += watch.positions == 0;
        }
        if (rings + positions == before) fail_msg("%s: nothing compared", all->item[i].name);
    }
    print_message(
        "I2: %llu vertices of selected faces; I3: %llu of refined ones; %llu views selected "
        "nothing\n",
        (unsigned long long)rings, (unsigned long long)positions, (unsigned long long)idle);
    assert_true(rings > 1000000 && positions > 1000000);
    assert_true(idle > 0); /* the mesh behind the eye */
    uniform_record_free(&uniform);
    invariant_watch_free(&watch);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_golden_free(golden);
}

static void two_uniform_steps_are_one_catmull_clark_level(void **state) {
    const samples *all = *state;
    hs_golden *golden = new_golden();
    hs_packet in = {0}, out = {0};
    uint64_t corners[2] = {0}, open_corners = 0, runs = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        const view_set set = views_of(mesh);
        const uint32_t chosen[] = {1, ORBIT + 3, ORBIT + 9}; /* orbit, inside, perspective */
        for (uint32_t k = 0; k < 6; k++) {
            const hs_boundary boundary = k % 2 ? HS_BOUNDARY_EDGE_ONLY : HS_BOUNDARY_SMOOTH;
            const hs_settings settings = {
                .uniform = true, .uniform_depth = 7, .boundary = boundary, .limit = k < 2};
            invariant_levels check;
            const hs_observer observer = invariant_levels_begin(&check, mesh, boundary);
            hs_golden_observe(golden, &observer);
            run(golden, mesh, &set.view[chosen[k / 2]], &settings, &in, &out);
            if (!check.good) fail_msg("%s: %s", all->item[i].name, check.error.text);
            assert_int_equal(check.surface.level, 3);
            invariant_levels_free(&check);
            corners[k % 2] += check.corners;
            open_corners += all->item[i].closed ? 0 : check.corners;
            runs++;
        }
    }
    print_message("I4: %u meshes, %llu runs, levels 1 to 3, %llu + %llu corners, %llu of them on "
                  "open meshes\n",
                  all->count, (unsigned long long)runs, (unsigned long long)corners[0],
                  (unsigned long long)corners[1], (unsigned long long)open_corners);
    assert_true(corners[0] > 1000000 && corners[1] > 1000000 && open_corners > 1000000);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_golden_free(golden);
}

static void output_depends_on_its_packet_alone(void **state) {
    const samples *all = *state;
    hs_golden *golden = new_golden(), *other = new_golden();
    uint8_t poison = 1;
    const hs_observer poisoner = invariant_poisoner(&poison);
    hs_golden_observe(other, &poisoner);
    hs_packet in = {0}, out = {0}, refused = {0};
    uint64_t compared = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        const view_set set = views_of(mesh);
        hs_packet first[2 * MOST_VIEWS] = {0};
        for (uint32_t k = 0; k < 2 * set.count; k++) {
            const hs_settings settings = settings_for(i, k / 2, k % 2 == 0);
            run(golden, mesh, &set.view[k / 2], &settings, &in, &first[k]);
        }
        for (uint32_t k = 2 * set.count; k-- > 0;) { /* the other way round */
            const hs_settings settings = settings_for(i, k / 2, k % 2 == 0);
            run(other, mesh, &set.view[k / 2], &settings, &in, &out);
            assert_int_equal(out.words, first[k].words);
            if (memcmp(out.word, first[k].word, 4 * out.words) != 0)
                fail_msg("%s, view %u: another output", all->item[i].name, k / 2);
            compared += out.words;
            hs_packet_free(&first[k]);

            hs_golden_report report; /* and a packet with a wrong bit in between */
            hs_error err;
            in.word[(k * 977u) % in.words] ^= 1u << k % 32;
            assert_true(hs_golden_run(other, &in, &refused, &report, &err));
            assert_true(report.status >= HS_STATUS_BAD_MAGIC);
        }
    }
    print_message("I5: %llu words\n", (unsigned long long)compared);
    assert_true(compared > 1000000);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_packet_free(&refused);
    hs_golden_free(golden);
    hs_golden_free(other);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(output_is_conforming_with_and_without_guard),
        cmocka_unit_test(what_a_view_refines_is_a_part_of_the_uniform_surface),
        cmocka_unit_test(two_uniform_steps_are_one_catmull_clark_level),
        cmocka_unit_test(output_depends_on_its_packet_alone),
    };
    return cmocka_run_group_tests_name("invariants", tests, make_all_samples, free_samples);
}
