/* SPDX-License-Identifier: Apache-2.0
 *
 * Stream files: input packets through golden and the cycle-level model, output packets through the
 * decoder. Changes are made to the records of a packet (mutate.h); then frames, counts and CRC are
 * mended, mostly, or nothing would ever get behind them.
 */
#include "fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare.h"
#include "invariants.h"
#include "model.h"
#include "mutate.h"
#include "shape.h"

/* --- input: packets through the engines ---------------------------------------------------------
 */

/* Small, so that a view that asks for depth 250 soon stops; enough for a vertex of 256 corners. */
static const hs_limits limits = {.vertices = 300, .quads = 800};

enum { MODELS = 2 };
typedef struct engines {
    hs_golden *golden, *poisoned;
    hs_model *model[MODELS]; /* the default, and the smallest */
    uint8_t poison;
    hs_packet good, answer; /* a view, and what golden says before anything else */
    hs_packet out, other;
} engines;

static engines *new_engines(void) {
    static engines e;
    if (e.golden) return &e;
    hs_error err = {0};
    hs_mesh mesh;
    hs_golden_report report;
    const hs_model_config smallest = {.port = 1,
                                      .banks = 2,
                                      .window = 2,
                                      .lanes = 1,
                                      .latency = 1,
                                      .ops = 16,
                                      .views = 1,
                                      .capacity = HS_DEFAULT_LIMITS};
    const hs_settings settings = {.front_depth = 1, .silhouette_depth = 2, .guard = true};
    static const float matrix[16] = {1, 0, 0.2f, 0, 0, 1, 0.1f, 0, 0, 0, -1, 2, 0, 0, -1, 4};
    e.golden = hs_golden_new(limits);
    e.poisoned = hs_golden_new(limits);
    e.model[0] = hs_model_new(limits, HS_DEFAULT_CONFIG, &err);
    e.model[1] = hs_model_new(limits, smallest, &err);
    fuzz_claim(e.golden && e.poisoned && e.model[0] && e.model[1], "no engines: %s", err.text);
    const hs_observer poisoner = invariant_poisoner(&e.poison);
    hs_golden_observe(e.poisoned, &poisoner);
    fuzz_claim(hs_shape_make(&mesh, "tetrahedron", 0, 0, &err) &&
                   hs_packet_encode(&e.good, 7, &mesh, matrix, &settings, &err) &&
                   hs_golden_run(e.golden, &e.good, &e.answer, &report, &err) &&
                   report.status == HS_STATUS_OK,
               "no good view: %s", err.text);
    hs_mesh_free(&mesh);
    return &e;
}

static void claim_same_words(const hs_packet *a, const hs_packet *b, const char *what) {
    const hs_word_comparison c = hs_compare_words(a, b);
    fuzz_claim(c.different == 0, "%s: %llu of %llu words differ, from word %zu", what,
               (unsigned long long)c.different, (unsigned long long)c.compared, c.first);
}

/* The answer is a packet, and says what the report does. */
static void claim_answer(const hs_packet *in, const hs_packet *out, const hs_golden_report *r) {
    hs_output output;
    hs_error err;
    if (!hs_output_decode(&output, out, &err)) fuzz_claim(false, "%s", err.text);
    fuzz_claim(output.status == r->status && output.error_position == r->error_position &&
                   output.faces == r->faces && output.vertices == r->vertices &&
                   output.triangles == r->triangles && output.at_level == r->at_level,
               "the report of %s is not its packet's", hs_status_name(r->status));
    if (r->status > HS_STATUS_STOPPED)
        fuzz_claim(out->words == 12 && r->error_position <= in->words, "refused at %u of %zu",
                   r->error_position, in->words);
    else
        fuzz_claim(output.faces > 0, "no faces");
    hs_output_free(&output);
}

static bool run_packet(engines *e, const hs_packet *in) {
    hs_golden_report report, other;
    hs_cycle_report cycles;
    hs_error err = {0};
    hs_model *model = e->model[in->view % MODELS];
    const hs_stalls stalls = {.seed = in->view,
                              .input = (uint8_t)(in->view >> 1 & 31),
                              .output = (uint8_t)(in->view >> 6 & 31)};
    fuzz_claim(hs_golden_run(e->golden, in, &e->out, &report, &err), "golden: %s", err.text);
    claim_answer(in, &e->out, &report);
    fuzz_claim(hs_golden_run(e->poisoned, in, &e->other, &other, &err), "golden: %s", err.text);
    claim_same_words(&e->out, &e->other, "golden, its memory overwritten");
    fuzz_claim(hs_model_run(model, in, stalls, &e->other, &other, &cycles, NULL, &err), "model: %s",
               err.text);
    claim_same_words(&e->out, &e->other, "model");
    return report.status <= HS_STATUS_STOPPED;
}

/* The view behind hostile ones. */
static void run_good(engines *e) {
    hs_golden_report report;
    hs_cycle_report cycles;
    hs_error err = {0};
    const hs_stalls stalls = {0};
    fuzz_claim(hs_golden_run(e->golden, &e->good, &e->out, &report, &err), "golden: %s", err.text);
    claim_same_words(&e->answer, &e->out, "golden, the view behind");
    for (uint32_t m = 0; m < MODELS; m++) {
        fuzz_claim(
            hs_model_run(e->model[m], &e->good, stalls, &e->other, &report, &cycles, NULL, &err),
            "model: %s", err.text);
        claim_same_words(&e->answer, &e->other, "model, the view behind");
    }
}

static fuzz_verdict run_input(const uint8_t *bytes, size_t size) {
    engines *e = new_engines();
    fuzz_verdict verdict = FUZZ_REFUSED;
    uint8_t *copy = (uint8_t *)fuzz_copy(bytes, size);
    hs_error err = {0};
    for (size_t at = 0; at < size;) {
        hs_packet in = {0}; /* anew, so that its memory ends where it ends */
        const bool good = hs_frame_read(&in, copy, size, &at, "fuzz.hss", &err);
        if (!good) fuzz_claim_error(&err, HS_EXIT_STREAM, "fuzz.hss:");
        fuzz_claim(good || in.words == 0, "words behind a failure");
        if (good && run_packet(e, &in)) verdict = FUZZ_TAKEN;
        hs_packet_free(&in);
        if (!good) break;
    }
    run_good(e);
    free(copy);
    return verdict;
}

/* --- output: the decoder ------------------------------------------------------------------------
 */

static int compare_numbers(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* What stream.h promises of an output. */
static void claim_output(const hs_output *o) {
    const double bound = ldexp(1, o->exponent);
    uint32_t triangles = 0;
    for (uint64_t i = 0; i < 4 * (uint64_t)o->vertices; i++)
        fuzz_claim(fabs((double)o->position[i]) < bound, "position %llu", (unsigned long long)i);
    for (uint32_t f = 0; f < o->faces; f++) {
        const uint32_t sides = o->first[f + 1] - o->first[f];
        fuzz_claim(sides >= HS_MIN_SIDES && sides <= HS_MAX_SIDES, "%u sides", sides);
        fuzz_claim(o->candidate[f] <= 1, "candidate");
        fuzz_claim(o->generation[f] <= o->generations, "generation of face %u", f);
        triangles += sides == 3;
    }
    fuzz_claim(triangles == o->triangles && o->first[o->faces] == o->corners, "counts");
    fuzz_claim(o->at_level <= o->vertices, "%u at their level", o->at_level);
    for (uint32_t c = 0; c < o->corners; c++)
        fuzz_claim(o->corner[c] < o->vertices, "corner %u", c);
    qsort(o->number, o->vertices, sizeof *o->number, compare_numbers);
    for (uint32_t v = 0; v < o->vertices; v++)
        fuzz_claim(o->number[v] >> HS_INDEX_BITS == 0 &&
                       (v == 0 || o->number[v - 1] != o->number[v]),
                   "number %u", o->number[v]);
    const bool refused = o->status > HS_STATUS_STOPPED;
    fuzz_claim(!refused || (o->generations <= HS_MAX_DEPTH && o->vertices == 0), "a refused view");
    fuzz_claim(refused == (o->faces == 0), "%u faces with status %u", o->faces, o->status);
}

static bool run_answer(const hs_packet *packet) {
    hs_output output;
    hs_error err = {0};
    char text[200];
    for (size_t w = 0; w <= packet->words; w += 1 + packet->words / 20) {
        hs_output_describe(packet, w, text, sizeof text);
        fuzz_claim(*text != 0, "word %zu is nothing", w);
    }
    if (!hs_output_decode(&output, packet, &err)) {
        fuzz_claim_error(&err, HS_EXIT_STREAM, "output packet of view ");
        fuzz_claim(!output.position && !output.faces, "an output behind a failure");
        return false;
    }
    claim_output(&output);
    hs_output_free(&output);
    return true;
}

static fuzz_verdict run_output(const uint8_t *bytes, size_t size) {
    fuzz_verdict verdict = FUZZ_REFUSED;
    hs_stream_file file = {0};
    hs_error err = {0};
    uint8_t *copy = (uint8_t *)fuzz_copy(bytes, size);
    for (size_t at = 0; at < size;) {
        hs_packet *packet;
        if (!hs_stream_file_grow(&file, &packet, &err)) fuzz_claim(false, "%s", err.text);
        if (!hs_frame_read(packet, copy, size, &at, "fuzz.hss", &err)) {
            fuzz_claim_error(&err, HS_EXIT_STREAM, "fuzz.hss:");
            hs_packet_free(packet);
            file.packets--;
            break;
        }
        if (run_answer(packet)) verdict = FUZZ_TAKEN;
    }
    if (file.packets) fuzz_claim_packets(&file);
    hs_stream_file_free(&file);
    free(copy);
    return verdict;
}

/* --- Changes ------------------------------------------------------------------------------------
 */

/* As many packets as there are behind good frames. */
static hs_stream_file take_apart(const uint8_t *bytes, size_t size) {
    hs_stream_file file = {0};
    hs_packet *packet;
    hs_error err;
    for (size_t at = 0; at < size && hs_stream_file_grow(&file, &packet, &err);)
        if (!hs_frame_read(packet, bytes, size, &at, "", &err)) {
            hs_packet_free(packet);
            file.packets--;
            break;
        }
    return file;
}

/* The packets that fit, whole records of the last one. */
static size_t put_together(uint8_t *bytes, size_t room, const hs_stream_file *file) {
    size_t at = 0;
    for (uint32_t i = 0; i < file->packets && room - at >= 32; i++) {
        const hs_packet *p = &file->packet[i];
        const size_t most = (room - at) / 16 * 4 - 4, words = p->words < most ? p->words : most;
        const uint32_t frame[4] = {HS_MAGIC_FRAME, p->view, (uint32_t)words, 0};
        memcpy(bytes + at, frame, 16);
        memcpy(bytes + at + 16, p->word, 4 * words);
        at += 16 + 4 * words;
    }
    return at;
}

static size_t mutate(uint8_t *bytes, size_t size, size_t room, uint64_t seed) {
    hs_stream_file file = take_apart(bytes, size);
    if (file.packets) {
        hs_packet *p = &file.packet[mutate_below(&seed, file.packets)], other = {0};
        const hs_packet *from = &file.packet[mutate_below(&seed, file.packets)];
        hs_error err;
        if (hs_packet_append(&other, from->word, from->words / 4, &err))
            for (uint32_t n = 1 + mutate_below(&seed, 3); n > 0; n--)
                mutate_packet(p, &other, room / 16, &seed);
        hs_packet_free(&other);
        if (mutate_below(&seed, 8) == 0) p->view = mutate_below(&seed, 65536);
        if (mutate_below(&seed, 16) == 0 && file.packets > 1)
            hs_packet_free(&file.packet[--file.packets]);
        size = put_together(bytes, room, &file);
    }
    hs_stream_file_free(&file);
    return size;
}

/* The head of a packet of one file, the tail of one of the other; or both files. */
static size_t cross(uint8_t *out, size_t room, const uint8_t *a, size_t a_size, const uint8_t *b,
                    size_t b_size, uint64_t seed) {
    hs_stream_file left = take_apart(a, a_size), right = take_apart(b, b_size);
    size_t size = 0;
    hs_error err;
    if (left.packets && right.packets) {
        hs_packet *p = &left.packet[mutate_below(&seed, left.packets)];
        const hs_packet *q = &right.packet[mutate_below(&seed, right.packets)];
        if (mutate_below(&seed, 4)) {
            const size_t from = mutate_below(&seed, q->words / 4);
            p->words = 4 * (size_t)mutate_below(&seed, p->words / 4 + 1);
            hs_packet_append(p, q->word + 4 * from, q->words / 4 - from, &err);
            size = put_together(out, room, &left);
        } else {
            size = put_together(out, room, &left);
            size += put_together(out + size, room - size, &right);
        }
    }
    hs_stream_file_free(&left);
    hs_stream_file_free(&right);
    return size;
}

static void mend_with(uint8_t *bytes, size_t size, void (*counts)(hs_packet *)) {
    for (size_t at = 0; size - at >= 32;) {
        uint32_t frame[4];
        memcpy(frame, bytes + at, sizeof frame);
        const size_t most = (size - at - 16) / 16 * 4;
        frame[0] = HS_MAGIC_FRAME;
        frame[1] &= 0xffff;
        frame[2] &= ~3u;
        if (frame[2] == 0 || frame[2] > most) frame[2] = (uint32_t)most;
        frame[3] = 0;
        memcpy(bytes + at, frame, sizeof frame);
        hs_packet p = {.view = frame[1], .words = frame[2], .word = malloc(4 * (size_t)frame[2])};
        fuzz_claim(p.word != NULL, "no memory");
        memcpy(p.word, bytes + at + 16, 4 * p.words);
        if (counts) counts(&p);
        p.word[p.words - 1] = hs_packet_crc(&p);
        memcpy(bytes + at + 16, p.word, 4 * p.words);
        at += 16 + 4 * p.words;
        hs_packet_free(&p);
    }
}

static void mend_input(uint8_t *bytes, size_t size) {
    mend_with(bytes, size, NULL);
}

/* The header's view, TRAILER and END with the counts of what is there. */
static void mend_counts(hs_packet *p) {
    if (p->words < 12) return;
    uint32_t *trailer = p->word + p->words - 8, *end = trailer + 4;
    uint32_t vertices = 0, faces = 0, triangles = 0, generation = 0;
    for (const uint32_t *w = p->word + 4; w < trailer; w += 4) {
        const uint32_t kind = w[0] >> 20;
        if (kind == hs_tag(HS_RECORD_VERTICES, 0) >> 20 ||
            kind == hs_tag(HS_RECORD_FACE, 0) >> 20) {
            const bool face = kind == hs_tag(HS_RECORD_FACE, 0) >> 20;
            generation = (w[0] & 255) > generation ? w[0] & 255 : generation;
            vertices += face ? 0 : w[0] >> 16 & 15;
            faces += face;
            triangles += face && (w[0] >> 8 & 255) == 3;
        }
    }
    p->word[1] = p->view;
    trailer[2] = vertices;
    trailer[3] = faces;
    if ((end[0] & 255) != generation + 1) end[0] = hs_tag(HS_RECORD_END, generation);
    end[1] = triangles;
}

static void mend_output(uint8_t *bytes, size_t size) {
    mend_with(bytes, size, mend_counts);
}

const fuzz_target fuzz_input = {.name = "input",
                                .longest = 4608,
                                .run = run_input,
                                .mutate = mutate,
                                .cross = cross,
                                .mend = mend_input};
const fuzz_target fuzz_output = {.name = "output",
                                 .longest = 2048,
                                 .run = run_output,
                                 .mutate = mutate,
                                 .cross = cross,
                                 .mend = mend_output};
