/* SPDX-License-Identifier: Apache-2.0
 *
 * The Verilated RTL with input streams that were tampered with: bits, words, records, whole
 * packets, with a CRC that was mended or not, while both sides pause. Behind each of them comes a
 * good view.
 *
 *   fuzz_rtl [STREAMS [SEED]]
 *
 * A stream is a packet of any words up to TLAST. Of each it is claimed that
 *
 *   it ends          within a limit of cycles that follows from its length, its depths and the
 *                    capacities
 *   format           what comes out keeps the rules of the bus, and decodes
 *   code             status and position are golden's
 *   words            and so are all words
 *   behind           the good view's words are those that it has alone
 *   cycles           both take as long as in the cycle-level model
 *
 * Streams go in rows, one behind the other without a pause between them; or, one in eight, alone,
 * with all counters looked at. Two processes share them; a row depends on the seed and its number
 * alone, but for what the rows before it left in the pipeline. Each status must occur.
 */
#define PROGRAM "fuzz_rtl"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file.h"
#include "mutate.h"
#include "quit.h"
#include "rtl_samples.h"
#include "trace.h"

/* Small, so that a view that asks for depth 250 soon stops; enough for a vertex of 256 corners. */
static const hs_limits limits = {.vertices = 120, .quads = 280};

enum { WORKERS = 2, BASES = 96, PAIRS = 3, LONGEST = 320, MOST_FAILURES = 20 };

typedef enum failure { HANG, ASSERTION, FORMAT, CODE, WORDS, BEHIND, CYCLES, FAILURES } failure;
static const char *const failure_name[FAILURES] = {
    "hangs",       "assertions",       "format breaks",         "wrong codes",
    "wrong words", "wrong next views", "cycles not the model's"};

/* In memory that the processes share. */
typedef struct tally {
    uint64_t rows, streams, behind, alone, stalled, mended, words, cycles, compared;
    uint64_t status[256], mutation[MUTATIONS], failure[FAILURES];
    double fullest; /* largest part of its limit of cycles that a row took */
} tally;

typedef struct worker {
    uint64_t random;
    hs_rtl *rtl;
    hs_golden *golden;
    hs_model *model;
    hs_flight *flight;
    bool single; /* one view in flight: it may run alone, with its counters */
    hs_packet base[BASES];
    /* A row: mutated and good packets in turn, what golden says, what RTL and model send. */
    hs_packet in[2 * PAIRS], expected[2 * PAIRS], out[2 * PAIRS], modelled[2 * PAIRS];
    hs_golden_report report[2 * PAIRS];
    uint32_t count;
    hs_stalls stalls;
    uint64_t row;
    tally *t;
} worker;

static uint32_t below(worker *w, uint32_t limit) {
    return mutate_below(&w->random, limit);
}

/* --- Good packets -------------------------------------------------------------------------------
 */

static void make_polygon(hs_mesh *mesh, uint32_t n) {
    float position[4 * HS_MAX_SIDES];
    uint32_t corner[HS_MAX_SIDES];
    make_ring(position, n, false);
    for (uint32_t i = 0; i < n; i++)
        corner[i] = n - 1 - i;
    make_soup(mesh, n, position, 1, &n, corner);
}

static void make_mesh(worker *w, uint32_t which, hs_mesh *mesh) {
    switch (which % 12) {
    case 0:
    case 1:
        make_polygon(mesh, 3);
        break;
    case 2:
        make_polygon(mesh, 4 + below(w, 4));
        break;
    case 3:
        make_pillow(mesh, 3 + below(w, 4));
        break;
    case 4:
        make_bicone(mesh, 3);
        break;
    case 5:
        make_shape(mesh, "cube", 0, 0);
        break;
    case 6:
    case 7:
        make_shape(mesh, "grid", 1 + below(w, 2), 0);
        break;
    default:
        make_shape(mesh, "tetrahedron", 0, 0);
    }
}

/* Some edges and vertices of a packet become sharp. */
static void sharpen(worker *w, hs_packet *p) {
    static const uint32_t sharpness[] = {1, 2, 3, 9, HS_SHARP_INFINITE};
    uint32_t *corner = p->word + 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS + p->word[3]);
    for (uint32_t h = 0; h < p->word[5]; h++) {
        const uint32_t t = corner[4 * h + 1], s = sharpness[below(w, 5)];
        if (below(w, 4) == 0) corner[4 * h + 3] |= s << 4;
        if (t != HS_BORDER && t < h && below(w, 3) == 0) {
            corner[4 * h + 3] = (corner[4 * h + 3] & ~15u) | s;
            corner[4 * t + 3] = (corner[4 * t + 3] & ~15u) | s;
        }
    }
    mend_crc(p);
}

static void make_bases(worker *w) {
    hs_error err;
    for (uint32_t i = 0; i < BASES; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_mesh(w, i, &mesh);
        make_views(&mesh, view);
        hs_settings s = below(w, 3)
                            ? adaptive((uint8_t)below(w, 3), (uint8_t)below(w, 4), below(w, 2))
                            : uniform((uint8_t)below(w, 4));
        if (below(w, 10) == 0) s = uniform((uint8_t)(5 + below(w, 20))); /* until it is too large */
        s.boundary = modes[below(w, 3)];
        s.limit = below(w, 3) == 0;
        if (below(w, 4) == 0) {
            s.min_edge = (uint16_t)(1 + below(w, 9000));
            s.width = s.height = 640;
        }
        for (uint32_t f = 0; f < mesh.faces; f++)
            mesh.forced[f] = (uint8_t)(below(w, 12) ? 0 : below(w, 3));
        quit_on(hs_packet_encode(&w->base[i], 0, &mesh, view[below(w, VIEWS)].matrix, &s, &err),
                &err);
        if (below(w, 3) == 0) sharpen(w, &w->base[i]);
        hs_mesh_free(&mesh);
    }
}

/* 86 triangles, all of them around vertex 0 alone: one corner more than a vertex may have. */
static void make_fan(hs_packet *p, const hs_packet *triangle) {
    hs_error err;
    const uint32_t end[4] = {HS_MAGIC_END, 0, 0, 0};
    p->words = 0;
    hs_packet_append(p, triangle->word, HS_HEADER_RECORDS + HS_MATRIX_RECORDS + 3, &err);
    p->word[3] = 3;
    p->word[4] = 86;
    p->word[5] = 3 * 86;
    for (uint32_t h = 0; h < 3 * 86; h++) {
        const uint32_t corner[4] = {0, HS_BORDER, 3 | h % 3 << 16, 0};
        hs_packet_append(p, corner, 1, &err);
    }
    hs_packet_append(p, end, 1, &err);
    mend_crc(p);
}

/* --- A row --------------------------------------------------------------------------------------
 */

static void copy_packet(hs_packet *to, const hs_packet *from) {
    hs_error err;
    to->words = 0;
    quit_on(hs_packet_append(to, from->word, from->words / 4, &err), &err);
}

static void make_pair(worker *w, uint32_t at) {
    hs_packet *mutated = &w->in[at], *good = &w->in[at + 1];
    if (below(w, 250))
        copy_packet(mutated, &w->base[below(w, BASES)]);
    else
        make_fan(mutated, &w->base[0]);
    for (uint32_t n = 1 + below(w, 3) / 2 + below(w, 4) / 3; n > 0; n--)
        w->t->mutation[mutate_packet(mutated, &w->base[below(w, BASES)], LONGEST, &w->random)]++;
    const bool mend = below(w, 4) != 0;
    if (mend) mend_crc(mutated);
    w->t->mended += mend;
    copy_packet(good, &w->base[below(w, BASES)]);
    mutated->view = (uint32_t)(w->row * 2 * PAIRS + at) & 0xffff;
    good->view = (mutated->view + 1) & 0xffff;
}

/* Cycles that a packet may take: its records, then in each generation that its depths allow at most
 * twice the faces of the one before, or what the limits let pass; some dozens an item, for a
 * division by an odd valence takes that long, and some hundreds a generation for the stages' ends.
 */
static uint64_t most_cycles(const hs_packet *p, hs_stalls stalls) {
    const uint64_t a_packet = 200, a_record = 4, a_generation = 200, an_item = 10;
    const uint64_t records = p->words / 4;
    uint32_t depth = 0;
    if (p->words >= 8)
        for (int i = 0; i < 24; i += 8)
            depth = (p->word[6] >> i & 255) > depth ? p->word[6] >> i & 255 : depth;
    for (uint64_t r = HS_HEADER_RECORDS + HS_MATRIX_RECORDS; r < records; r++) {
        const uint32_t forced = p->word[4 * r + 2] >> 8 & 255;
        if (forced > depth && forced <= HS_MAX_DEPTH) depth = forced;
    }
    uint64_t items = records, sum = a_packet + a_record * records;
    for (uint32_t g = 0; g <= depth && g <= HS_MAX_DEPTH; g++) {
        const uint64_t most = limits.quads + limits.vertices;
        sum += a_generation + an_item * items;
        items = 2 * items < most ? 2 * items : most;
    }
    return sum * 100 / (100u - stalls.input) * 100 / (100u - stalls.output);
}

static void note_failure(worker *w, failure what, uint32_t at, const char *text) {
    char path[100];
    hs_error err;
    w->t->failure[what]++;
    snprintf(path, sizeof path, "out/fuzz/rtl-%llu.hss", (unsigned long long)w->row);
    const hs_stream_file file = {w->count, w->in};
    if (!hs_stream_file_write(&file, path, &err)) printf("%s\n", err.text);
    printf("fuzz_rtl: row %llu, packet %u of %u, stalls %u, %u, %u: %s: %s (%s)\n",
           (unsigned long long)w->row, at, w->count, w->stalls.input, w->stalls.output,
           w->stalls.seed, failure_name[what], text, path);
    fflush(stdout);
    uint64_t failures = 0;
    for (uint32_t f = 0; f < FAILURES; f++)
        failures += w->t->failure[f];
    if (failures >= MOST_FAILURES) exit(HS_EXIT_DIFFERENT);
}

/* What the RTL sent for a packet. */
static void check_packet(worker *w, uint32_t i) {
    tally *t = w->t;
    const hs_packet *sent = &w->out[i];
    const hs_golden_report *r = &w->report[i];
    hs_output output;
    hs_error err;
    char text[500];
    if (!hs_output_decode(&output, sent, &err)) {
        note_failure(w, FORMAT, i, err.text);
        return;
    }
    if (output.status != r->status || output.error_position != r->error_position) {
        snprintf(text, sizeof text, "rtl %s at %u, golden %s at %u", hs_status_name(output.status),
                 output.error_position, hs_status_name(r->status), r->error_position);
        note_failure(w, CODE, i, text);
    }
    hs_output_free(&output);
    const hs_word_comparison c = hs_compare_words(&w->expected[i], sent);
    t->compared += c.compared;
    if (c.different) {
        hs_compare_describe(&w->expected[i], sent, c.first, "rtl", text, sizeof text);
        note_failure(w, i % 2 ? BEHIND : WORDS, i, text);
    }
    if (hs_compare_words(sent, &w->modelled[i]).different)
        note_failure(w, CYCLES, i, "its words are not the model's");
    t->words += w->in[i].words;
    if (i % 2) {
        t->behind++;
    } else {
        t->streams++;
        t->status[r->status & 255]++;
    }
}

static void note_cycles(worker *w, uint64_t cycles, uint64_t most) {
    const double part = (double)cycles / (double)most;
    w->t->cycles += cycles;
    if (part > w->t->fullest) w->t->fullest = part;
}

/* What the simulation says of the row's end. */
static void note_run(worker *w, uint32_t at, const hs_error *err) {
    static const char *const hang[] = {"hangs", "come to an end", "does not answer", "stays busy"};
    failure what = strstr(err->text, "breaks a rule") ? FORMAT : ASSERTION; /* or a counter */
    for (size_t i = 0; i < sizeof hang / sizeof *hang; i++)
        if (strstr(err->text, hang[i])) what = HANG;
    note_failure(w, what, at, err->text);
}

/* The packets one by one. */
static void run_alone(worker *w) {
    hs_cycle_report rtl, model;
    hs_golden_report report;
    hs_error err = {0};
    char text[200];
    for (uint32_t i = 0; i < w->count; i++) {
        const uint64_t most = most_cycles(&w->in[i], w->stalls);
        hs_rtl_cycle_limit(w->rtl, most);
        if (!hs_rtl_run(w->rtl, &w->in[i], w->stalls, &w->out[i], &rtl, &err)) {
            note_run(w, i, &err);
            continue;
        }
        note_cycles(w, rtl.cycles, most);
        quit_on(hs_model_run(w->model, &w->in[i], w->stalls, &w->modelled[i], &report, &model, NULL,
                             &err),
                &err);
        if (!hs_cycle_report_equal(&rtl, &model, text, sizeof text))
            note_failure(w, CYCLES, i, text);
        check_packet(w, i);
        w->t->alone++;
    }
}

/* The packets in a row, without waiting for answers. */
static void run_row(worker *w) {
    hs_flight_view rtl_view[2 * PAIRS], model_view[2 * PAIRS];
    hs_golden_report report[2 * PAIRS];
    uint64_t rtl_cycles, model_cycles, most = 0;
    hs_error err = {0};
    for (uint32_t i = 0; i < w->count; i++)
        most += most_cycles(&w->in[i], w->stalls);
    hs_rtl_cycle_limit(w->rtl, most);
    if (!hs_rtl_stream(w->rtl, w->in, w->count, w->stalls, w->out, rtl_view, &rtl_cycles, &err)) {
        note_run(w, 0, &err);
        return;
    }
    note_cycles(w, rtl_cycles, most);
    quit_on(hs_flight_run(w->flight, w->in, w->count, w->stalls, w->modelled, report, model_view,
                          &model_cycles, NULL, &err),
            &err);
    for (uint32_t i = 0; i < w->count; i++) {
        if (rtl_view[i].start != model_view[i].start || rtl_view[i].end != model_view[i].end)
            note_failure(w, CYCLES, i, "begins or ends in another cycle");
        check_packet(w, i);
    }
}

static void make_row(worker *w, uint64_t seed) {
    hs_error err;
    w->random = seed * 0x9e3779b97f4a7c15u + w->row;
    w->count = 2 * (1 + below(w, PAIRS));
    for (uint32_t i = 0; i < w->count; i += 2)
        make_pair(w, i);
    w->stalls = no_stalls;
    if (below(w, 4) == 0)
        w->stalls = (hs_stalls){.seed = below(w, 1u << 30),
                                .input = (uint8_t)below(w, 80),
                                .output = (uint8_t)below(w, 80)};
    w->t->stalled += w->stalls.input + w->stalls.output > 0;
    for (uint32_t i = 0; i < w->count; i++)
        quit_on(hs_golden_run(w->golden, &w->in[i], &w->expected[i], &w->report[i], &err), &err);
}

static void work(uint32_t number, uint64_t streams, uint64_t seed, tally *t) {
    static worker w;
    hs_error err = {0};
    w.t = t;
    w.random = seed;
    w.rtl = hs_rtl_new(limits, (uint32_t)seed + number, &err);
    quit_on(w.rtl != NULL, &err);
    const hs_model_config c = hs_rtl_config(w.rtl);
    w.single = c.views == 1;
    w.golden = hs_golden_new(limits);
    w.model = hs_model_new(limits, c, &err);
    w.flight = hs_flight_new(limits, c, &err);
    quit_on(w.golden && w.model && w.flight, &err);
    make_bases(&w);
    for (w.row = number; t->streams < streams; w.row += WORKERS) {
        make_row(&w, seed);
        if (w.single && below(&w, 8) == 0)
            run_alone(&w);
        else
            run_row(&w);
        t->rows++;
    }
    hs_rtl_free(w.rtl);
}

/* --- The report ---------------------------------------------------------------------------------
 */

static tally add_up(const tally *part) {
    tally sum = {0};
    uint64_t *to = (uint64_t *)&sum;
    for (uint32_t p = 0; p < WORKERS; p++) {
        const uint64_t *from = (const uint64_t *)&part[p];
        for (size_t i = 0; i < offsetof(tally, fullest) / sizeof *to; i++)
            to[i] += from[i];
        if (part[p].fullest > sum.fullest) sum.fullest = part[p].fullest;
    }
    return sum;
}

/* Whether every claim was held up, and something was claimed. */
static bool print_report(const char *name, const tally *t, uint64_t streams, uint64_t seed) {
    bool good = t->streams >= streams && t->behind > 0 && t->compared > 0;
    for (uint32_t m = 0; m < MUTATIONS; m++)
        printf("%10llu %s\n", (unsigned long long)t->mutation[m], mutation_name((mutation)m));
    for (uint32_t s = 0; s < 256; s++) {
        if (strcmp(hs_status_name(s), "?") == 0) continue;
        printf("%10llu %s\n", (unsigned long long)t->status[s], hs_status_name(s));
        /* Whether a memory fails is no matter of the stream. */
        if (t->status[s] == 0 && s != HS_STATUS_MEMORY_FAULT) {
            printf("fuzz_rtl: no stream had the status %s\n", hs_status_name(s));
            good = false;
        }
    }
    printf("result: %s: %llu streams, %llu with their CRC mended, in %llu rows, %llu of them "
           "with stalls; %llu packets alone; seed %llu\n",
           name, (unsigned long long)t->streams, (unsigned long long)t->mended,
           (unsigned long long)t->rows, (unsigned long long)t->stalled,
           (unsigned long long)t->alone, (unsigned long long)seed);
    printf("result: %s: %llu words in, %llu words out compared, %llu good views behind, %llu "
           "cycles, at most %.0f%% of a limit\n",
           name, (unsigned long long)t->words, (unsigned long long)t->compared,
           (unsigned long long)t->behind, (unsigned long long)t->cycles, 100 * t->fullest);
    printf("result: %s:", name);
    for (uint32_t f = 0; f < FAILURES; f++) {
        printf("%s %llu %s", f ? "," : "", (unsigned long long)t->failure[f], failure_name[f]);
        good = good && t->failure[f] == 0;
    }
    printf("\n");
    return good;
}

int main(int argc, char **argv) {
    const uint64_t streams = argc > 1 ? strtoull(argv[1], NULL, 0) : 100000;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 0) : 1;
    hs_error err;
    quit_on(hs_folder_make("out/fuzz", &err), &err);
    tally *part = mmap(NULL, WORKERS * sizeof *part, PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (part == MAP_FAILED) return HS_EXIT_INTERNAL;
    bool good = streams > 0;
    for (uint32_t i = 0; i < WORKERS; i++)
        if (fork() == 0) {
            work(i, (streams + WORKERS - 1) / WORKERS, seed, &part[i]);
            exit(HS_EXIT_OK);
        }
    for (int status; wait(&status) > 0;)
        good = WIFEXITED(status) && WEXITSTATUS(status) == HS_EXIT_OK && good;
    const tally all = add_up(part);
    const char *slash = strrchr(argv[0], '/'); /* the name tells the architecture */
    good = print_report(slash ? slash + 1 : argv[0], &all, streams, seed) && good;
    return good ? HS_EXIT_OK : HS_EXIT_DIFFERENT;
}
