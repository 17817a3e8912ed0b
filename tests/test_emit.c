/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/emit.sv and rtl/pack.sv against the definition of the output stream, written here once more
 * in the simplest way. The RTL's own assertions (AXI rules) are armed in every case.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "emit_shim.h"
#include "stream.h"

enum { OPS = 4096, RECORDS = 4 * OPS };

/* --- Chance ----------------------------------------------------------------------------------- */
static uint32_t chance(uint32_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static uint32_t below(uint32_t *state, uint32_t bound) {
    return (uint32_t)((uint64_t)chance(state) * bound >> 32);
}

/* --- A packet's ops ----------------------------------------------------------------------------
 */
typedef struct script {
    emit_view view;
    size_t ops;
    emit_op op[OPS];
} script;

static emit_op *add(script *s, uint32_t kind, uint32_t generation) {
    assert_true(s->ops < OPS);
    emit_op *op = &s->op[s->ops++];
    *op = (emit_op){.kind = kind, .generation = generation};
    return op;
}

/* Fields that the op's kind doesn't use are filled as well: they must not matter. */
static void add_noise(emit_op *op, uint32_t *state) {
    op->number = chance(state) & 0xffffff;
    for (int i = 0; i < 4; i++)
        op->position[i] = (uint32_t)((int32_t)chance(state) >> (1 + below(state, 31)));
    op->at_level = below(state, 2);
    op->mask = below(state, 16);
    op->triangle = below(state, 16);
    op->child = below(state, 16);
    op->candidate = below(state, 16);
    for (int i = 0; i < 16; i++)
        op->vertex[i] = chance(state) & 0xffffff;
    op->sides = below(state, 256);
    op->first = below(state, 2);
    op->last = below(state, 2);
}

static void add_vertex(script *s, uint32_t generation, uint32_t *state) {
    add_noise(add(s, HS_OP_VERTEX, generation), state);
}

/* Of all that is noise, whether the vertex leaves at its level is not: a group never says so. */
static void add_group(script *s, uint32_t generation, uint32_t *state) {
    emit_op *op = add(s, HS_OP_GROUP, generation);
    add_noise(op, state);
    op->at_level = 0;
    for (uint32_t i = 0; i < 12; i++)
        op->group[i] = chance(state);
}

static void add_faces(script *s, uint32_t generation, uint32_t mask, uint32_t *state) {
    emit_op *op = add(s, HS_OP_FACES, generation);
    add_noise(op, state);
    op->mask = mask;
}

static void add_polygon(script *s, uint32_t generation, uint32_t sides, uint32_t *state) {
    uint32_t candidate = below(state, 2);
    for (uint32_t i = 0; i < sides; i++) {
        emit_op *op = add(s, HS_OP_CORNER, generation);
        add_noise(op, state);
        op->candidate = (op->candidate & 14) | candidate;
        op->sides = sides;
        op->first = i == 0;
        op->last = i + 1 == sides;
    }
}

static void begin(script *s, uint32_t *state) {
    s->ops = 0;
    s->view = (emit_view){.view = chance(state) & 0xffff,
                          .status = below(state, 34),
                          .position = chance(state),
                          .exponent = (int32_t)below(state, 276) - 148};
    add_noise(add(s, HS_OP_HEADER, chance(state) & 0xff), state);
}

static void end(script *s, uint32_t generation, uint32_t *state) {
    add_noise(add(s, HS_OP_TRAILER, generation), state);
}

static void random_script(script *s, uint32_t length, uint32_t *state) {
    uint32_t generation = 0;
    begin(s, state);
    while (s->ops < length) {
        uint32_t run = 1 + below(state, 9);
        switch (below(state, 9)) {
        case 0:
            generation = (generation + 1) & 0xff;
            break;
        case 1:
            add_polygon(s, generation, below(state, 20) ? 3 + below(state, 10) : 255, state);
            break;
        case 2:
            add_faces(s, generation, 0, state);
            break;
        case 3:
        case 4:
            for (uint32_t i = 0; i < run; i++)
                add_faces(s, generation, 1 + below(state, 15), state);
            break;
        case 5:
            for (uint32_t i = 0; i < run; i++)
                add_group(s, generation, state);
            break;
        default:
            for (uint32_t i = 0; i < run; i++)
                add_vertex(s, generation, state);
        }
    }
    end(s, generation, state);
}

/* --- The packet that they make ------------------------------------------------------------------
 */
typedef struct packet {
    size_t words;
    uint32_t word[4 * RECORDS];
    uint32_t vertices, at_level, faces, triangles;
} packet;

static void put(packet *p, uint32_t w0, uint32_t w1, uint32_t w2, uint32_t w3) {
    assert_true(p->words + 4 <= 4 * RECORDS);
    uint32_t *w = p->word + p->words;
    w[0] = w0, w[1] = w1, w[2] = w2, w[3] = w3;
    p->words += 4;
}

/* A record with up to four vertex numbers. */
static void put_numbers(packet *p, uint32_t w0, const uint32_t *number, uint32_t count) {
    uint8_t bytes[12] = {0};
    for (uint32_t i = 0; i < 3 * count; i++)
        bytes[i] = (uint8_t)(number[i / 3] >> 8 * (i % 3));
    uint32_t w[3];
    memcpy(w, bytes, sizeof w);
    put(p, w0, w[0], w[1], w[2]);
}

static void put_face(packet *p, const uint32_t *number, uint32_t sides, uint32_t candidate,
                     uint32_t generation) {
    put_numbers(p, hs_tag(HS_RECORD_FACE, candidate << 16 | sides << 8 | generation), number,
                sides < 4 ? sides : 4);
    for (uint32_t i = 4; i < sides; i += 4) {
        uint32_t count = sides - i < 4 ? sides - i : 4;
        put_numbers(p, hs_tag(HS_RECORD_MORE, count << 8 | generation), number + i, count);
    }
    p->faces++;
    p->triangles += sides == 3;
}

static uint32_t as_float(uint32_t q, int32_t exponent) {
    float c = (float)ldexp((double)(int32_t)q, exponent - 30);
    uint32_t bits;
    memcpy(&bits, &c, sizeof bits);
    return bits;
}

static void expect_packet(packet *p, const script *s) {
    p->words = 0;
    p->vertices = p->at_level = p->faces = p->triangles = 0;
    for (size_t i = 0; i < s->ops; i++) {
        const emit_op *op = &s->op[i];
        uint32_t number[255], count = 0;
        switch (op->kind) {
        case HS_OP_HEADER:
            put(p, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), s->view.view,
                (uint32_t)s->view.exponent, 0);
            break;
        case HS_OP_VERTEX:
            /* A FACES op without faces doesn't exist, so it doesn't end a group either. */
            for (size_t j = i; count < 4; j++) {
                if (s->op[j].kind == HS_OP_FACES && !s->op[j].mask) continue;
                if (s->op[j].kind != HS_OP_VERTEX || s->op[j].generation != op->generation) break;
                number[count++] = s->op[j].number;
            }
            put_numbers(p, hs_tag(HS_RECORD_VERTICES, count << 16 | op->generation), number, count);
            for (uint32_t k = 0; k < count; i++) {
                if (s->op[i].kind != HS_OP_VERTEX) continue;
                const uint32_t *q = s->op[i].position;
                int32_t e = s->view.exponent;
                p->at_level += s->op[i].at_level;
                put(p, as_float(q[0], e), as_float(q[1], e), as_float(q[2], e), as_float(q[3], e));
                k++;
            }
            i--; /* the loop's own step */
            p->vertices += count;
            break;
        case HS_OP_GROUP: {
            const int32_t e = s->view.exponent;
            number[0] = op->number;
            memcpy(number + 1, op->vertex, 3 * sizeof *number);
            put_numbers(p, hs_tag(HS_RECORD_VERTICES, 4u << 16 | op->generation), number, 4);
            for (uint32_t k = 0; k < 4; k++) {
                const uint32_t *q = k ? op->group + 4 * (k - 1) : op->position;
                put(p, as_float(q[0], e), as_float(q[1], e), as_float(q[2], e), as_float(q[3], e));
            }
            p->vertices += 4;
            break;
        }
        case HS_OP_FACES:
            for (uint32_t slot = 0; slot < 4; slot++)
                if (op->mask >> slot & 1)
                    put_face(p, op->vertex + 4 * slot, op->triangle >> slot & 1 ? 3 : 4,
                             op->candidate >> slot & 1,
                             (op->generation + (op->child >> slot & 1)) & 0xff);
            break;
        case HS_OP_CORNER:
            for (; count < op->sides; i++)
                number[count++] = s->op[i].number;
            i--;
            put_face(p, number, op->sides, op->candidate & 1, op->generation);
            break;
        default:
            put(p, hs_tag(HS_RECORD_TRAILER, s->view.status), s->view.position, p->vertices,
                p->faces);
            put(p, hs_tag(HS_RECORD_END, op->generation), p->triangles, p->at_level, 0);
            p->word[p->words - 1] = hs_crc(0, p->word, p->words - 1);
        }
    }
}

/* --- Playing a script ---------------------------------------------------------------------------
 */
typedef struct pauses {
    uint32_t seed, input, output; /* per cent of the cycles */
} pauses;

typedef struct result {
    packet got;
    uint64_t cycles, refused; /* cycles in which an op was offered and not taken */
    uint64_t busy, starved, blocked, in, out;
} result;

/* Plays one packet to its done pulse; checks the stream's rules on the way. */
static void play(emit_rtl *rtl, uint32_t port, const script *s, pauses pause, result *r) {
    uint32_t state = pause.seed | 1;
    size_t op = 0;
    bool offered = false, ended = false, done = false;
    emit_wires w;
    memset(r, 0, sizeof *r);
    while (!done) {
        assert_true(r->cycles < 100000 + 200 * (uint64_t)s->ops);
        if (op < s->ops && !offered) offered = below(&state, 100) >= pause.input;
        bool tready = below(&state, 100) >= pause.output;
        emit_rtl_cycle(rtl, offered ? &s->op[op] : NULL, &s->view, tready, &w);
        r->cycles++;
        r->busy += w.busy, r->starved += w.starved, r->blocked += w.blocked;
        r->in += w.items_in, r->out += w.items_out;
        assert_true(w.busy + w.starved + w.blocked <= 1);
        assert_int_equal(w.busy, offered && w.op_ready);
        if (offered && w.op_ready) {
            op++;
            offered = false;
        } else if (offered)
            r->refused++;

        assert_int_equal(w.done, ended); /* a pulse in the cycle behind the last beat, no other */
        done = w.done;
        assert_false(w.tvalid && ended);
        if (!w.tvalid || !tready) continue;
        assert_int_equal(w.tid, s->view.view);
        uint32_t records = 0;
        while (records < port && w.tkeep >> 16 * records & 1)
            records++;
        assert_true(records > 0);
        assert_true(w.tkeep == (records == 4 ? UINT64_MAX : (1ull << 16 * records) - 1));
        assert_true(w.tlast || records == port);
        assert_true(r->got.words + 4 * records <= 4 * RECORDS);
        memcpy(r->got.word + r->got.words, w.tdata, 16 * records);
        r->got.words += 4 * records;
        for (uint32_t i = 4 * records; i < 16; i++)
            assert_int_equal(w.tdata[i], 0);
        ended = w.tlast;
    }
    assert_int_equal(op, s->ops);
}

static script the_script;
static packet expected;
static result the_result;

static void check_packet(const script *s, const packet *got) {
    expect_packet(&expected, s);
    for (size_t i = 0; i < got->words && i < expected.words; i++)
        if (got->word[i] != expected.word[i])
            fail_msg("word %zu of record %zu: 0x%08x, expected 0x%08x", i % 4, i / 4, got->word[i],
                     expected.word[i]);
    assert_int_equal(got->words, expected.words);
}

static void check_play(emit_rtl *rtl, uint32_t port, const script *s, pauses pause) {
    play(rtl, port, s, pause, &the_result);
    check_packet(s, &the_result.got);
    assert_int_equal(the_result.busy, s->ops);
    assert_int_equal(the_result.blocked, the_result.refused);
    assert_int_equal(the_result.in, the_result.out);
    assert_int_equal(the_result.in, expected.vertices + expected.faces);
}

/* --- Claims
 * --------------------------------------------------------------------------------------- */
static void every_word_is_as_defined_at_every_port_width_and_with_stalls(void **unused) {
    (void)unused;
    static const uint32_t stall[] = {0, 30, 85};
    for (uint32_t port = 1; port <= 4; port *= 2) {
        emit_rtl *rtl = emit_rtl_new(port, port);
        uint32_t state = 12345 + port;
        for (uint32_t i = 0; i < 9; i++)
            for (uint32_t k = 0; k < 4; k++) {
                random_script(&the_script, k ? 10 + below(&state, 300) : 2, &state);
                check_play(rtl, port, &the_script,
                           (pauses){chance(&state), stall[i % 3], stall[i / 3]});
            }
        emit_rtl_free(rtl);
    }
}

static void groups_of_vertices_end_with_four_another_op_or_another_generation(void **unused) {
    (void)unused;
    uint32_t state = 99;
    emit_rtl *rtl = emit_rtl_new(4, 7);
    for (uint32_t count = 0; count <= 9; count++)
        for (uint32_t how = 0; how < 4; how++) {
            begin(&the_script, &state);
            for (uint32_t i = 0; i < count; i++)
                add_vertex(&the_script, 6, &state);
            if (how == 1) add_faces(&the_script, 6, 5, &state);
            if (how == 2) add_polygon(&the_script, 6, 5, &state);
            for (uint32_t i = 0; i < 3; i++)
                add_vertex(&the_script, how == 3 ? 7 : 6, &state);
            end(&the_script, 7, &state);
            check_play(rtl, 4, &the_script, (pauses){count, 20 * how, 0});
        }
    emit_rtl_free(rtl);
}

static void polygons_of_any_number_of_sides_go_out_whole(void **unused) {
    (void)unused;
    uint32_t state = 4;
    emit_rtl *rtl = emit_rtl_new(4, 8);
    begin(&the_script, &state);
    for (uint32_t sides = 3; sides <= 18; sides++)
        add_polygon(&the_script, 0, sides, &state);
    add_polygon(&the_script, 0, 254, &state);
    add_polygon(&the_script, 0, 255, &state);
    end(&the_script, 0, &state);
    check_play(rtl, 4, &the_script, (pauses){1, 0, 0});
    emit_rtl_free(rtl);
}

static void a_packet_without_geometry_is_header_trailer_and_end(void **unused) {
    (void)unused;
    uint32_t state = 17;
    for (uint32_t port = 1; port <= 4; port *= 2) {
        emit_rtl *rtl = emit_rtl_new(port, 9);
        begin(&the_script, &state);
        end(&the_script, 0, &state);
        check_play(rtl, port, &the_script, (pauses){1, 0, 0});
        assert_int_equal(the_result.got.words, 12);
        emit_rtl_free(rtl);
    }
}

/* The rate that the interface promises: five records per four vertices, four faces a cycle. */
static void no_op_is_refused_while_the_widest_output_is_taken(void **unused) {
    (void)unused;
    emit_rtl *rtl = emit_rtl_new(4, 10);
    for (uint32_t how = 0; how < 12; how++) {
        uint32_t state = 1 + how;
        if (how >= 4)
            random_script(&the_script, 2000, &state);
        else {
            begin(&the_script, &state);
            for (uint32_t i = 0; i < 2000; i++)
                if (how == 0 || (how == 2 && i % 2) || (how == 3 && i % 5))
                    add_vertex(&the_script, 3, &state);
                else
                    add_faces(&the_script, 3, 15, &state);
            end(&the_script, 3, &state);
        }
        check_play(rtl, 4, &the_script, (pauses){1, 0, 0});
        /* What four groups leave over goes out in a cycle of its own, and so does what is left over
         * when another op ends a run of them. */
        uint32_t carries = 0, run = 0;
        for (size_t i = 0; i < the_script.ops; i++) {
            const emit_op *op = &the_script.op[i];
            if (op->kind == HS_OP_FACES && !op->mask) continue; /* leaves no trace */
            const bool group = op->kind == HS_OP_GROUP;
            carries += run == 4 || (run && !group);
            run = group ? run % 4 + 1 : 0;
        }
        assert_int_equal(carries > 0, how >= 4);
        assert_true(the_result.refused <= carries);
        /* Reading, converting, making records, a row, a beat: a handful of cycles, and done. */
        assert_in_range(the_result.cycles, the_script.ops, the_script.ops + carries + 8);
    }
    emit_rtl_free(rtl);
}

static void a_narrow_output_is_never_idle_while_there_is_work(void **unused) {
    (void)unused;
    for (uint32_t port = 1; port <= 2; port *= 2) {
        uint32_t state = port;
        emit_rtl *rtl = emit_rtl_new(port, 11);
        begin(&the_script, &state);
        for (uint32_t i = 0; i < 1000; i++)
            add_faces(&the_script, 3, 15, &state);
        end(&the_script, 3, &state);
        check_play(rtl, port, &the_script, (pauses){1, 0, 0});
        assert_in_range(the_result.cycles, 4000 / port, 4000 / port + 12);
        emit_rtl_free(rtl);
    }
}

static void a_beat_is_offered_without_waiting_for_ready(void **unused) {
    (void)unused;
    uint32_t state = 5;
    emit_rtl *rtl = emit_rtl_new(4, 12);
    emit_wires w;
    begin(&the_script, &state);
    for (uint32_t i = 0; i < 100; i++)
        add_faces(&the_script, 1, 15, &state);
    uint32_t op = 0, first[16];
    bool seen = false;
    for (uint32_t cycle = 0; cycle < 50; cycle++) {
        emit_rtl_cycle(rtl, &the_script.op[op], &the_script.view, false, &w);
        op += w.op_ready;
        assert_true(!seen || w.tvalid);
        if (seen) assert_memory_equal(first, w.tdata, sizeof first);
        if (w.tvalid && !seen) {
            seen = true;
            memcpy(first, w.tdata, sizeof first);
        }
    }
    assert_true(seen);
    assert_false(w.op_ready); /* and a stalled output reaches back to the ops */
    assert_true(w.blocked);
    emit_rtl_free(rtl);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_packet_without_geometry_is_header_trailer_and_end),
        cmocka_unit_test(groups_of_vertices_end_with_four_another_op_or_another_generation),
        cmocka_unit_test(polygons_of_any_number_of_sides_go_out_whole),
        cmocka_unit_test(every_word_is_as_defined_at_every_port_width_and_with_stalls),
        cmocka_unit_test(no_op_is_refused_while_the_widest_output_is_taken),
        cmocka_unit_test(a_narrow_output_is_never_idle_while_there_is_work),
        cmocka_unit_test(a_beat_is_offered_without_waiting_for_ready),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
