/* SPDX-License-Identifier: Apache-2.0
 *
 * The check of the twins (rtl/check_twins.sv) against the rules of docs/stream.md, section 3, taken
 * half-edge after half-edge: which half-edge is the first at fault, and is it its twin or its
 * sharpness?
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "check_twins_shim.h"

typedef struct mesh {
    uint32_t corners;
    check_corner corner[CHECK_CORNERS];
} mesh;

static uint32_t random_state;

static uint32_t random_below(uint32_t n) {
    random_state = random_state * 1664525 + 1013904223;
    return (random_state >> 8) % n;
}

/* --- Meshes -------------------------------------------------------------------------------------
 */

static uint32_t next_of(const mesh *m, uint32_t h) {
    if (!m->corner[h].last) return h + 1;
    while (!m->corner[h].first)
        h--;
    return h;
}

static void add_face(mesh *m, const uint8_t *vertex, uint32_t sides) {
    for (uint32_t i = 0; i < sides; i++)
        m->corner[m->corners++] = (check_corner){
            .origin = vertex[i], .border = true, .first = i == 0, .last = i + 1 == sides};
}

/* Twins where there are any, and for each edge a sharpness; border half-edges name twins that do
 * not count. */
static void find_twins(mesh *m) {
    for (uint32_t h = 0; h < m->corners; h++) {
        check_corner *c = &m->corner[h];
        c->twin = (uint8_t)random_below(m->corners);
        c->sharpness = (uint8_t)random_below(10);
        for (uint32_t t = 0; t < m->corners; t++)
            if (m->corner[t].origin == m->corner[next_of(m, h)].origin &&
                m->corner[next_of(m, t)].origin == c->origin) {
                c->twin = (uint8_t)t;
                c->border = false;
                if (t < h) c->sharpness = m->corner[t].sharpness;
            }
    }
}

/* A grid of 4 x 4 places, each with a quad, two triangles or nothing. */
static mesh random_grid(void) {
    mesh m = {0};
    for (uint8_t y = 0; y < 4; y++)
        for (uint8_t x = 0; x < 4; x++) {
            const uint8_t a = (uint8_t)(5 * y + x);
            const uint8_t quad[] = {a, (uint8_t)(a + 1), (uint8_t)(a + 6), (uint8_t)(a + 5)};
            const uint8_t half[] = {a, (uint8_t)(a + 6), (uint8_t)(a + 5)};
            const uint32_t kind = random_below(6);
            if (kind == 0) continue;
            add_face(&m, quad, kind < 3 ? 3 : 4);
            if (kind < 3) add_face(&m, half, 3);
        }
    if (m.corners == 0) add_face(&m, (const uint8_t[]){0, 1, 2}, 3);
    find_twins(&m);
    return m;
}

/* Closed: a quad and four triangles. */
static mesh pyramid(void) {
    mesh m = {0};
    add_face(&m, (const uint8_t[]){0, 3, 2, 1}, 4);
    for (uint8_t i = 0; i < 4; i++)
        add_face(&m, (const uint8_t[]){i, (uint8_t)((i + 1) % 4), 4}, 3);
    find_twins(&m);
    return m;
}

/* --- The rules ----------------------------------------------------------------------------------
 */

static bool twin_wrong(const mesh *m, uint32_t h) {
    const check_corner *c = &m->corner[h], *t = &m->corner[c->twin];
    return !c->border &&
           (t->border || t->twin != h || t->origin != m->corner[next_of(m, h)].origin);
}

static bool sharpness_wrong(const mesh *m, uint32_t h) {
    const check_corner *c = &m->corner[h];
    return !c->border && m->corner[c->twin].sharpness != c->sharpness;
}

static check_verdict verdict_of(const mesh *m) {
    for (uint32_t h = 0; h < m->corners; h++) {
        if (twin_wrong(m, h)) return (check_verdict){.error = true, .corner = h};
        if (sharpness_wrong(m, h))
            return (check_verdict){.error = true, .of_sharpness = true, .corner = h};
    }
    return (check_verdict){.error = false};
}

static check_verdict assert_agrees(check_twins_shim *shim, const mesh *m) {
    const check_verdict is = check_twins_run(shim, m->corner, m->corners);
    const check_verdict should = verdict_of(m);
    assert_int_equal(is.cycles, m->corners + 2); /* a corner a cycle, two more for the last one */
    assert_int_equal(is.error, should.error);
    if (should.error) {
        assert_int_equal(is.corner, should.corner);
        assert_int_equal(is.of_sharpness, should.of_sharpness);
    }
    return should;
}

/* --- Claims -------------------------------------------------------------------------------------
 */

static void good_meshes_pass(void **state) {
    (void)state;
    check_twins_shim *shim = check_twins_new(1);
    random_state = 1;
    uint32_t inside = 0, border = 0;
    for (uint32_t round = 0; round < 200; round++) {
        const mesh m = round % 10 ? random_grid() : pyramid();
        assert_false(assert_agrees(shim, &m).error);
        for (uint32_t h = 0; h < m.corners; h++) {
            inside += !m.corner[h].border;
            border += m.corner[h].border;
        }
    }
    assert_true(inside > 1000 && border > 1000);
    check_twins_free(shim);
}

static void another_sharpness_of_the_twin_is_named_at_the_lower_half_edge(void **state) {
    (void)state;
    check_twins_shim *shim = check_twins_new(2);
    random_state = 2;
    for (uint32_t h = 0; h < 16; h++)
        for (uint32_t bit = 0; bit < 4; bit++) {
            mesh m = pyramid();
            m.corner[h].sharpness ^= (uint8_t)(1u << bit);
            const check_verdict v = assert_agrees(shim, &m);
            assert_true(v.error && v.of_sharpness);
            assert_int_equal(v.corner, h < m.corner[h].twin ? h : m.corner[h].twin);
        }
    check_twins_free(shim);
}

/* Exchanges the twins of h and k: four half-edges then have twins that point back but run along
 * another edge. */
static void cross(mesh *m, uint32_t h, uint32_t k) {
    const uint8_t t = m->corner[h].twin, u = m->corner[k].twin;
    m->corner[h].twin = u, m->corner[u].twin = (uint8_t)h;
    m->corner[k].twin = t, m->corner[t].twin = (uint8_t)k;
}

/* The direction of a half-edge's twin is known a corner later than its sharpness. */
static void a_wrong_direction_goes_before_a_wrong_sharpness(void **state) {
    (void)state;
    check_twins_shim *shim = check_twins_new(3);
    random_state = 3;
    uint32_t both = 0;
    for (uint32_t h = 0; h < 16; h++)
        for (uint32_t k = 0; k < 16; k++) {
            mesh m = pyramid();
            if (k == h || k == m.corner[h].twin) continue;
            cross(&m, h, k);
            /* sharpness that agrees nowhere */
            for (uint32_t i = 0; i < 16; i++)
                m.corner[i].sharpness = (uint8_t)i;
            m.corner[0].sharpness = m.corner[m.corner[0].twin].sharpness; /* an error less */
            const check_verdict v = assert_agrees(shim, &m);
            assert_true(v.error);
            both += !v.of_sharpness && sharpness_wrong(&m, v.corner);
        }
    assert_true(both > 10);
    check_twins_free(shim);
}

static void any_damage_gets_the_verdict_of_the_rules(void **state) {
    (void)state;
    check_twins_shim *shim = check_twins_new(4);
    random_state = 4;
    uint32_t of_twin = 0, of_sharpness = 0, both = 0;
    for (uint32_t round = 0; round < 4000; round++) {
        mesh m = round % 3 ? random_grid() : pyramid();
        for (uint32_t i = 0; i <= round % 4; i++) {
            const uint32_t h = random_below(m.corners), k = random_below(m.corners);
            switch (random_below(6)) {
            case 0:
                if (k != h) m.corner[h].twin = (uint8_t)k;
                break;
            case 1:
                m.corner[h].origin = (uint8_t)random_below(CHECK_VERTICES);
                break;
            case 2:
                m.corner[h].border = !m.corner[h].border;
                break;
            case 3:
                if (!m.corner[h].border && !m.corner[k].border && k != h && k != m.corner[h].twin)
                    cross(&m, h, k);
                break;
            default:
                m.corner[h].sharpness = (uint8_t)random_below(16);
            }
        }
        const check_verdict v = assert_agrees(shim, &m);
        of_twin += v.error && !v.of_sharpness;
        of_sharpness += v.error && v.of_sharpness;
        both += v.error && !v.of_sharpness && sharpness_wrong(&m, v.corner);
    }
    assert_true(of_twin > 500 && of_sharpness > 500 && both > 100);
    check_twins_free(shim);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_meshes_pass),
        cmocka_unit_test(another_sharpness_of_the_twin_is_named_at_the_lower_half_edge),
        cmocka_unit_test(a_wrong_direction_goes_before_a_wrong_sharpness),
        cmocka_unit_test(any_damage_gets_the_verdict_of_the_rules),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
