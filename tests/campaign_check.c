/* SPDX-License-Identifier: Apache-2.0
 *
 * Everything that follows from a packet is taken from the packet, so that a trace is checked as the
 * case was that it was made of.
 */
#include "campaign_check.h"

#include "reference.h"

static const hs_limits wide_limits = {1 << 22, 1 << 22};

/* --- What a packet says -------------------------------------------------------------------------
 */

enum { MATRIX_AT = 4 * HS_HEADER_RECORDS, VERTICES_AT = MATRIX_AT + 4 * HS_MATRIX_RECORDS };

static void *new_array(size_t count, size_t element) {
    void *array = calloc(count, element);
    assert_non_null(array);
    return array;
}

void checker_mesh(hs_mesh *mesh, const hs_packet *packet) {
    const uint32_t *word = packet->word, vertices = word[3], faces = word[4], halfedges = word[5];
    *mesh = (hs_mesh){.vertices = vertices,
                      .faces = faces,
                      .halfedges = halfedges,
                      .position = new_array(4 * (size_t)vertices, sizeof(float)),
                      .first = new_array(faces + (size_t)1, sizeof(uint32_t)),
                      .origin = new_array(halfedges, sizeof(uint32_t)),
                      .twin = new_array(halfedges, sizeof(uint32_t)),
                      .face = new_array(halfedges, sizeof(uint32_t)),
                      .forced = new_array(faces, 1),
                      .sharpness = new_array(halfedges, 1),
                      .vertex_sharpness = new_array(vertices, 1)};
    memcpy(mesh->position, word + VERTICES_AT, 4 * (size_t)vertices * sizeof(float));
    uint32_t f = UINT32_MAX;
    for (uint32_t h = 0; h < halfedges; h++) {
        const uint32_t *corner = word + VERTICES_AT + 4 * ((size_t)vertices + h);
        const uint32_t origin = corner[0], own = corner[3] >> 4 & 15;
        if ((corner[2] >> 16 & 0xff) == 0) mesh->first[++f] = h;
        mesh->origin[h] = origin;
        mesh->twin[h] = corner[1];
        mesh->face[h] = f;
        mesh->forced[f] = (uint8_t)(corner[2] >> 8);
        mesh->sharpness[h] = corner[3] & 15;
        if (own > mesh->vertex_sharpness[origin]) mesh->vertex_sharpness[origin] = (uint8_t)own;
    }
    mesh->first[faces] = halfedges;
}

hs_settings checker_settings(const hs_packet *packet) {
    const uint32_t *word = packet->word, flags = word[2];
    return (hs_settings){.front_depth = (uint8_t)word[6],
                         .silhouette_depth = (uint8_t)(word[6] >> 8),
                         .uniform_depth = (uint8_t)(word[6] >> 16),
                         .uniform = flags & HS_FLAG_UNIFORM,
                         .guard = flags & HS_FLAG_GUARD,
                         .limit = flags & HS_FLAG_LIMIT,
                         .boundary = flags & HS_FLAG_SMOOTH      ? HS_BOUNDARY_SMOOTH
                                     : flags & HS_FLAG_EDGE_ONLY ? HS_BOUNDARY_EDGE_ONLY
                                                                 : HS_BOUNDARY_KEPT,
                         .min_edge = (uint16_t)word[8],
                         .width = (uint16_t)word[9],
                         .height = (uint16_t)(word[9] >> 16)};
}

/* --- Beginning and end --------------------------------------------------------------------------
 */

static hs_golden *new_golden(hs_limits limits) {
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    return golden;
}

void checker_begin(checker *c) {
    *c = (checker){.bench = new_bench(HS_DEFAULT_LIMITS, 1),
                   .other = new_golden(HS_DEFAULT_LIMITS),
                   .wide = new_golden(wide_limits)};
    c->bench->keeps_packet = false;
}

void checker_end(checker *c) {
    free_bench(c->bench);
    hs_golden_free(c->other);
    hs_golden_free(c->wide);
    uniform_record_free(&c->uniform);
    invariant_watch_free(&c->watch);
    hs_packet_free(&c->again);
}

/* --- Checks -------------------------------------------------------------------------------------
 */

/* Everything that the checks of an accepted packet look at. */
typedef struct subject {
    const hs_packet *in;
    hs_mesh mesh;
    float matrix[16];
    hs_settings settings;
    hs_output output;
    bool closed;
} subject;

static bool fail_check(checker *c, const char *what, const char *why) {
    c->failed = what;
    snprintf(c->text, sizeof c->text, "%s: %s", what, why);
    return false;
}

static bool check_reference(checker *c, const subject *s) {
    hs_reference reference;
    hs_reference_decisions decisions;
    hs_reference_comparison comparison;
    hs_error err;
    double matrix[16];
    for (int i = 0; i < 16; i++)
        matrix[i] = (double)s->matrix[i];
    if (!hs_reference_new(&reference, &s->mesh, matrix, s->settings.boundary, &err))
        return fail_check(c, "reference", err.text);
    bool good =
        hs_reference_replay(&reference, &s->settings, &c->bench->golden_report, &decisions, &err);
    if (!good) {
        fail_check(c, "reference", err.text);
    } else if (!hs_reference_compare(&reference, &s->output, &comparison)) {
        good = fail_check(c, "reference", comparison.first);
    } else {
        c->tally.reference_faces += comparison.faces;
        c->tally.reference_vertices += comparison.vertices;
        c->tally.decisions += decisions.faces;
        c->tally.decided_otherwise += decisions.refined_different;
    }
    hs_reference_free(&reference);
    return good;
}

/* Golden once more, looked into; what comes out must be the same. */
static bool run_again(checker *c, const subject *s, const hs_observer *observer, const char *what) {
    hs_golden_report report;
    hs_error err;
    hs_golden_observe(c->other, observer);
    const bool good = hs_golden_run(c->other, s->in, &c->again, &report, &err);
    hs_golden_observe(c->other, NULL);
    if (!good) return fail_check(c, what, err.text);
    const hs_word_comparison words = hs_compare_words(&c->bench->expected, &c->again);
    if (words.different == 0) return true;
    char text[500];
    hs_compare_describe(&c->bench->expected, &c->again, words.first, "golden, looked into,", text,
                        sizeof text);
    return fail_check(c, what, text);
}

static bool check_rings(checker *c, const subject *s) {
    const hs_settings *settings = &s->settings;
    hs_error err;
    if (settings->uniform || !settings->guard || settings->front_depth > UNIFORM_GENERATIONS ||
        settings->silhouette_depth > UNIFORM_GENERATIONS)
        return true;
    if (!uniform_record_make(&c->uniform, c->wide, &s->mesh, s->matrix, settings, &err))
        return fail_check(c, "I2", err.text);
    const hs_observer observer = invariant_watch_begin(&c->watch, &c->uniform);
    if (!run_again(c, s, &observer, "I5")) return false;
    c->tally.rings += c->watch.rings;
    c->tally.positions += c->watch.positions;
    return c->watch.good ||
           fail_check(c, c->watch.error.text[1] == '2' ? "I2" : "I3", c->watch.error.text);
}

static bool check_levels(checker *c, const subject *s) {
    if (!s->settings.uniform || (!s->closed && s->settings.boundary == HS_BOUNDARY_KEPT))
        return true;
    invariant_levels levels;
    const hs_observer observer = invariant_levels_begin(&levels, &s->mesh, s->settings.boundary);
    const bool good =
        run_again(c, s, &observer, "I5") && (levels.good || fail_check(c, "I4", levels.error.text));
    c->tally.corners += levels.corners;
    invariant_levels_free(&levels);
    return good;
}

static bool check_accepted(checker *c, subject *s) {
    hs_error err;
    if (!hs_output_decode(&s->output, &c->bench->expected, &err))
        return fail_check(c, "output", err.text);
    c->tally.faces_in += s->mesh.faces;
    c->tally.faces_out += s->output.faces;
    if (!invariant_conforming(&s->output, &s->mesh, s->settings.boundary, &c->tally.edges, &err))
        return fail_check(c, "I1", err.text);
    const hs_observer poisoner = invariant_poisoner(&c->poison);
    if (!run_again(c, s, &poisoner, "I5")) return false;
    c->tally.poisoned += c->again.words;
    return check_rings(c, s) && check_levels(c, s) && check_reference(c, s);
}

static void set_limits(checker *c, hs_limits limits) {
    if (limits.vertices == c->bench->limits.vertices && limits.quads == c->bench->limits.quads)
        return;
    limit_bench(c->bench, limits);
    hs_golden_free(c->other);
    c->other = new_golden(limits);
}

/* --- Packets in a row ---------------------------------------------------------------------------
 */

enum { ROW = 3 };

typedef struct row {
    hs_packet in[ROW], wanted[ROW], rtl_out[ROW], model_out[ROW];
    hs_golden_report report[ROW];
    hs_flight_view rtl_view[ROW], model_view[ROW];
    uint64_t rtl_cycles, model_cycles;
    hs_log rtl_log, model_log;
} row;

static bool same_row(checker *c, row *r) {
    const bool refused = r->report[1].status > HS_STATUS_STOPPED;
    const hs_log_comparison logs = hs_log_compare(&r->rtl_log, "rtl", &r->model_log, "model",
                                                  refused ? HS_LOG_DATA_OF_REFUSED : 0);
    c->tally.row_transactions += logs.compared;
    c->tally.row_cycles += r->rtl_cycles;
    for (uint32_t i = 0; i < ROW; i++) {
        char text[600], place[500];
        const hs_word_comparison words = hs_compare_words(&r->wanted[i], &r->rtl_out[i]);
        hs_compare_describe(&r->wanted[i], &r->rtl_out[i], words.first, "rtl", place, sizeof place);
        snprintf(text, sizeof text, "packet %u of %d: %s", i, ROW, place);
        if (words.different) return fail_check(c, "row", text);
        if (hs_compare_words(&r->rtl_out[i], &r->model_out[i]).different)
            return fail_check(c, "row", "the words of the model are not the RTL's");
        if (r->rtl_view[i].start != r->model_view[i].start ||
            r->rtl_view[i].end != r->model_view[i].end)
            return fail_check(c, "row", "a packet begins or ends in other cycles");
    }
    if (logs.different) return fail_check(c, "row", logs.text);
    return r->rtl_cycles == r->model_cycles || fail_check(c, "row", "other cycles in all");
}

static bool check_row(checker *c, const hs_packet *packet, hs_stalls stalls) {
    static row r;
    bench *b = c->bench;
    hs_error err = {0};
    const size_t half = packet->words / 8 * 4;
    if (b->rtl_report.cycles > ROW_CYCLES) return true;
    hs_flight *flight = hs_flight_new(b->limits, hs_rtl_config(b->rtl), &err);
    bool good = flight != NULL;
    for (uint32_t i = 0; i < ROW && good; i++) {
        r.in[i].view = (packet->view + i) & 0xffff;
        r.in[i].words = 0;
        good = hs_packet_append(&r.in[i], packet->word, (i == 1 && half ? half : packet->words) / 4,
                                &err) &&
               hs_golden_run(c->other, &r.in[i], &r.wanted[i], &r.report[i], &err);
    }
    hs_log_clear(&r.rtl_log);
    hs_rtl_logs(b->rtl, &r.rtl_log);
    good = good &&
           hs_rtl_stream(b->rtl, r.in, ROW, stalls, r.rtl_out, r.rtl_view, &r.rtl_cycles, &err) &&
           hs_flight_run(flight, r.in, ROW, stalls, r.model_out, r.report, r.model_view,
                         &r.model_cycles, &r.model_log, &err);
    hs_rtl_logs(b->rtl, NULL);
    hs_flight_free(flight);
    c->tally.rows++;
    return good ? same_row(c, &r) : fail_check(c, "row", err.text);
}

/* --- Everything ---------------------------------------------------------------------------------
 */

static bool is_planned(uint32_t wanted, uint32_t status) {
    /* What is spoiled anywhere behind may be beyond binary32 before. */
    if (wanted == CHECK_ANY_STATUS) return true;
    if (wanted != HS_STATUS_OK) return status == wanted || status == HS_STATUS_OVERFLOW;
    return status <= HS_STATUS_STOPPED || status == HS_STATUS_OVERFLOW;
}

static bool check_engines(checker *c, const hs_packet *packet, hs_stalls stalls) {
    bench *b = c->bench;
    const bench before = *b;
    const bool good = same_words(b, packet, stalls, "case", c->text, sizeof c->text);
    c->failed = b->failed;
    c->tally.words += b->words - before.words;
    c->tally.transactions += b->transactions - before.transactions;
    c->tally.cycles += b->cycles - before.cycles;
    return good;
}

bool checker_check(checker *c, const hs_packet *packet, hs_limits limits, hs_stalls stalls,
                   uint32_t wanted) {
    c->failed = NULL;
    c->status = HS_STATUS_OK;
    c->tally.cases++;
    set_limits(c, limits);
    if (!check_engines(c, packet, stalls)) return false;
    const hs_golden_report *report = &c->bench->golden_report;
    c->status = report->status;
    c->generations = report->generations;
    c->largest_generation = 0;
    for (uint32_t g = 0; g < report->generations; g++)
        if (report->generation[g].active > c->largest_generation)
            c->largest_generation = report->generation[g].active;
    if (!is_planned(wanted, c->status)) {
        char why[200];
        snprintf(why, sizeof why, "%s instead of %s", hs_status_name(c->status),
                 hs_status_name(wanted));
        return fail_check(c, "status", why);
    }
    if (!check_row(c, packet, stalls)) return false;
    if (c->status > HS_STATUS_STOPPED) return true;
    subject s = {.in = packet, .settings = checker_settings(packet), .closed = true};
    checker_mesh(&s.mesh, packet);
    memcpy(s.matrix, packet->word + MATRIX_AT, sizeof s.matrix);
    for (uint32_t h = 0; h < s.mesh.halfedges; h++)
        s.closed &= s.mesh.twin[h] != HS_BORDER;
    const bool good = check_accepted(c, &s);
    hs_output_free(&s.output);
    hs_mesh_free(&s.mesh);
    return good;
}
