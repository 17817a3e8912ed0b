/* SPDX-License-Identifier: Apache-2.0
 *
 * The meshes of halfstep report's page: are they those of the run?
 */
#include "report_scene.h"

#include <math.h>
#include <zlib.h>

#include "decimate.h"
#include "refine.h"
#include "report_mesh.h"

/* --- Meshes -------------------------------------------------------------------------------------
 */

/* A step, read as report_mesh.h says. */
typedef struct unpacked {
    uint32_t vertices, faces;
    double *position;
    uint8_t *column; /* sides, generation, depth, facing and end */
    uint32_t *corner;
    uint32_t corners;
} unpacked;

static int digit(char c) {
    static const char all[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    return (int)(strchr(all, c) - all);
}

static uint32_t next_number(const uint8_t **at) {
    uint32_t number = 0;
    for (int shift = 0;; shift += 7) {
        number |= (uint32_t)(**at & 0x7f) << shift;
        if (!(*(*at)++ & 0x80)) return number;
    }
}

static unpacked unpack(const json_t *step, const json_t *box) {
    const char *text = json_string_value(json_object_get(step, "data"));
    assert_non_null(text);
    const size_t length = strlen(text);
    uint8_t *packed = malloc(length), *bytes = malloc(1 << 24);
    size_t count = 0;
    for (size_t i = 0; i + 3 < length; i += 4) {
        uint32_t four = 0;
        int pad = 0;
        for (size_t k = 0; k < 4; k++) {
            pad += text[i + k] == '=';
            four = four << 6 | (text[i + k] == '=' ? 0 : (uint32_t)digit(text[i + k]));
        }
        for (int k = 0; k < 3 - pad; k++)
            packed[count++] = (uint8_t)(four >> (16 - 8 * k));
    }
    uLongf size = 1 << 24;
    assert_int_equal(uncompress(bytes, &size, packed, count), Z_OK);
    const uint8_t *at = bytes;
    unpacked u = {0};
    u.vertices = next_number(&at);
    u.faces = next_number(&at);
    u.position = calloc(3 * (size_t)u.vertices + 1, sizeof *u.position);
    for (size_t axis = 0; axis < 3; axis++) {
        const double low = json_real_value(json_array_get(box, axis)),
                     high = json_real_value(json_array_get(box, 3 + axis));
        int64_t value = 0;
        for (uint32_t v = 0; v < u.vertices; v++) {
            const uint32_t twice = next_number(&at);
            value += twice & 1 ? -(int64_t)(twice / 2) - 1 : (int64_t)(twice / 2);
            assert_in_range(value, 0, 16383);
            u.position[3 * v + axis] = low + (high - low) * (double)value / 16383;
        }
    }
    u.column = malloc(4 * (size_t)u.faces + 1);
    memcpy(u.column, at, 4 * (size_t)u.faces);
    at += 4 * (size_t)u.faces;
    for (uint32_t f = 0; f < u.faces; f++)
        u.corners += u.column[f];
    u.corner = calloc(u.corners + 1, sizeof *u.corner);
    uint32_t used = 0;
    for (uint32_t c = 0; c < u.corners; c++) {
        const uint32_t back = next_number(&at);
        assert_true(back <= used);
        u.corner[c] = used - back;
        used += back == 0;
    }
    assert_int_equal(used, u.vertices);
    assert_int_equal(at - bytes, size);
    free(packed);
    free(bytes);
    return u;
}

static void free_unpacked(unpacked *u) {
    free(u->position);
    free(u->column);
    free(u->corner);
}

static json_t *mesh_of(uint32_t most, char why[200]) {
    hs_error err = {0};
    char path[400];
    snprintf(path, sizeof path, "%s", inside(&place, "view-000"));
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    const hs_report_mesh_request r = {path, most, golden};
    json_t *mesh = hs_report_mesh(&r, why, 200, &err);
    hs_golden_free(golden);
    if (!mesh && !why[0]) fail_msg("%s", err.text);
    return mesh;
}

static double distance_to_nearest(const unpacked *u, const double p[3]) {
    double nearest = INFINITY;
    for (uint32_t v = 0; v < u->vertices; v++) {
        double sum = 0;
        for (size_t k = 0; k < 3; k++)
            sum += (u->position[3 * v + k] - p[k]) * (u->position[3 * v + k] - p[k]);
        nearest = fmin(nearest, sqrt(sum));
    }
    return nearest;
}

/* What golden sends when it is asked for no more than so many steps. */
static hs_output halted(const scene *s, hs_settings settings, uint8_t step) {
    hs_error err = {0};
    if (settings.front_depth > step) settings.front_depth = step;
    if (settings.silhouette_depth > step) settings.silhouette_depth = step;
    if (settings.uniform_depth > step) settings.uniform_depth = step;
    hs_output output;
    assert_true(hs_refine(&output, &s->mesh, s->matrix, &settings, HS_DEFAULT_LIMITS, &err));
    return output;
}

static void count_generations(uint32_t count[16], const uint8_t *generation, uint32_t faces) {
    memset(count, 0, 16 * sizeof *count);
    for (uint32_t f = 0; f < faces; f++)
        count[generation[f] & 15]++;
}

/* All faces are quads and boundaries are kept, so that triangles are cut off. */
static void compare_steps(const char *shape, uint32_t size, hs_settings settings) {
    scene s = make_scene(shape, size, settings, false);
    char why[200];
    json_t *mesh = mesh_of(50000, why);
    const json_t *steps = json_object_get(mesh, "steps"), *box = json_object_get(mesh, "box");
    assert_int_equal(json_array_size(steps), 5);
    for (uint8_t k = 0; k < 5; k++) {
        const json_t *step = json_array_get(steps, k);
        unpacked u = unpack(step, box);
        hs_output o = halted(&s, settings, k);
        assert_int_equal(u.faces, o.faces);
        assert_int_equal(u.vertices, o.vertices);
        assert_int_equal(u.corners, o.corners);
        assert_int_equal(json_integer_value(json_object_get(step, "faces")), o.faces);
        assert_int_equal(json_integer_value(json_object_get(step, "stored")), o.faces);
        uint32_t expected[16], packed[16], cut = 0, last = 0;
        count_generations(expected, o.generation, o.faces);
        count_generations(packed, u.column + u.faces, u.faces);
        assert_memory_equal(expected, packed, sizeof expected);
        for (uint32_t f = 0; f < u.faces; f++) {
            const uint8_t end = u.column[3 * (size_t)u.faces + f] >> 2;
            const uint8_t generation = u.column[u.faces + f], depth = u.column[2 * u.faces + f];
            cut += end == HS_END_CUT;
            last += end == HS_END_LAST_STEP;
            assert_int_equal(u.column[f] == 3, end == HS_END_CUT);
            assert_int_equal(depth, generation + (end == HS_END_CUT));
        }
        assert_int_equal(cut, o.triangles);
        assert_int_equal(last, k ? expected[k] : 0);
        hs_output_free(&o);
        free_unpacked(&u);
    }
    json_decref(mesh);
    free_scene(&s);
}

static void a_step_is_the_run_halted_there(void **state) {
    (void)state;
    const hs_settings kept = {.uniform = true, .uniform_depth = 4, .boundary = HS_BOUNDARY_KEPT};
    compare_steps("cube", 0, adaptive);
    compare_steps("grid", 4, kept);
}

static void the_first_step_is_the_initial_mesh_in_its_own_space(void **state) {
    (void)state;
    scene s = make_scene("mixed", 0, adaptive, false);
    char why[200];
    json_t *mesh = mesh_of(50000, why);
    const json_t *box = json_object_get(mesh, "box");
    unpacked u = unpack(json_array_get(json_object_get(mesh, "steps"), 0), box);
    assert_int_equal(u.faces, s.mesh.faces);
    double side = 0;
    for (size_t k = 0; k < 3; k++)
        side = fmax(side, json_real_value(json_array_get(box, 3 + k)) -
                              json_real_value(json_array_get(box, k)));
    for (uint32_t v = 0; v < s.mesh.vertices; v++) {
        double p[3];
        for (size_t k = 0; k < 3; k++)
            p[k] = (double)s.mesh.position[4 * (size_t)v + k];
        assert_true(distance_to_nearest(&u, p) <= side / 16383);
    }
    for (int i = 0; i < 16; i++)
        assert_true(json_real_value(json_array_get(json_object_get(mesh, "matrix"), (size_t)i)) ==
                    (double)s.matrix[i]);
    free_unpacked(&u);
    json_decref(mesh);
    free_scene(&s);
}

static void a_large_mesh_is_decimated_and_says_so(void **state) {
    (void)state;
    scene s = make_scene("hand", 0, adaptive, false);
    char why[200];
    json_t *mesh = mesh_of(1000, why);
    const json_t *steps = json_object_get(mesh, "steps"), *step;
    size_t k;
    json_array_foreach(steps, k, step) {
        unpacked u = unpack(step, json_object_get(mesh, "box"));
        const json_int_t faces = json_integer_value(json_object_get(step, "faces"));
        assert_int_equal(json_integer_value(json_object_get(step, "stored")), u.faces);
        if (faces <= 1000)
            assert_int_equal(u.faces, faces);
        else
            assert_in_range(u.faces, 500, 1000);
        uint32_t first = 0;
        for (uint32_t f = 0; f < u.faces; first += u.column[f++])
            for (uint32_t i = 0; i < u.column[f]; i++)
                for (uint32_t j = 0; j < i; j++)
                    assert_int_not_equal(u.corner[first + i], u.corner[first + j]);
        free_unpacked(&u);
    }
    json_decref(mesh);
    free_scene(&s);
}

static void decimation_keeps_what_is_few_and_leaves_no_more_than_asked(void **state) {
    (void)state;
    enum { SIDE = 40 };
    static double position[3 * (SIDE + 1) * (SIDE + 1)];
    static uint32_t first[SIDE * SIDE + 1], corner[4 * SIDE * SIDE];
    for (uint32_t y = 0, v = 0; y <= SIDE; y++)
        for (uint32_t x = 0; x <= SIDE; x++, v++) {
            position[3 * v] = x;
            position[3 * v + 1] = y;
        }
    for (uint32_t f = 0; f < SIDE * SIDE; f++) {
        const uint32_t v = f / SIDE * (SIDE + 1) + f % SIDE;
        const uint32_t c[4] = {v, v + 1, v + SIDE + 2, v + SIDE + 1};
        memcpy(&corner[4 * f], c, sizeof c);
        first[f + 1] = first[f] + 4;
    }
    const uint32_t vertices = (SIDE + 1) * (SIDE + 1), faces = SIDE * SIDE;
    static const uint32_t most[] = {1, 7, 100, 1599, 1600, 5000};
    for (size_t i = 0; i < sizeof most / sizeof *most; i++) {
        hs_error err = {0};
        hs_decimated d;
        assert_true(hs_decimate(&d, vertices, position, faces, first, corner, most[i], &err));
        if (most[i] >= faces) {
            assert_int_equal(d.faces, faces);
            assert_memory_equal(d.corner, corner, sizeof corner);
        } else {
            assert_true(d.faces <= most[i]);
            assert_true(d.faces >= most[i] / 3);
        }
        for (uint32_t f = 1; f < d.faces; f++)
            assert_true(d.source[f] > d.source[f - 1]);
        for (uint32_t c = 0; c < d.first[d.faces]; c++)
            assert_true(d.corner[c] < d.vertices);
        for (uint32_t v = 0; v < 3 * d.vertices; v++)
            assert_true(d.position[v] >= 0 && d.position[v] <= SIDE);
        hs_decimated_free(&d);
    }
}

static void why_there_is_no_mesh_is_said(void **state) {
    (void)state;
    char why[200];
    assert_null(mesh_of(1000, why));
    assert_non_null(strstr(why, "view-000/input.hss"));
    scene s = make_scene("cube", 0, adaptive, true);
    assert_null(mesh_of(1000, why));
    assert_non_null(strstr(why, "singular"));
    write_text("view-000/output.hss", "HS2F");
    assert_null(mesh_of(1000, why));
    assert_non_null(strstr(why, "output.hss"));
    s.in.word[s.in.words - 1] ^= 1;
    write_packet(&s.in, "view-000/input.hss");
    write_packet(&s.out, "view-000/output.hss");
    assert_null(mesh_of(1000, why));
    assert_non_null(strstr(why, "refused, BAD_CRC"));
    unlink(inside(&place, "view-000/output.hss"));
    assert_null(mesh_of(1000, why));
    assert_non_null(strstr(why, "view-000/output.hss"));
    free_scene(&s);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)
    const struct CMUnitTest tests[] = {
        TEST(a_step_is_the_run_halted_there),
        TEST(the_first_step_is_the_initial_mesh_in_its_own_space),
        TEST(a_large_mesh_is_decimated_and_says_so),
        TEST(decimation_keeps_what_is_few_and_leaves_no_more_than_asked),
        TEST(why_there_is_no_mesh_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
