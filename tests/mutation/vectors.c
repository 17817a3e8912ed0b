/* SPDX-License-Identifier: Apache-2.0 */
#include "vectors.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "compare.h"

/* --- Answers ------------------------------------------------------------------------------------
 */
static bool fit_engines(engines *e, const hs_model_config *config, hs_limits limits,
                        hs_error *err) {
    if (e->golden && e->limits.vertices == limits.vertices && e->limits.quads == limits.quads)
        return true;
    hs_golden_free(e->golden);
    hs_model_free(e->model);
    e->limits = limits;
    e->golden = hs_golden_new(limits);
    e->model = hs_model_new(limits, *config, err);
    return e->golden && e->model;
}

static uint64_t digest(uint64_t h, const void *bytes, size_t size) {
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i++)
        h = (h ^ byte[i]) * 0x100000001b3u;
    return h;
}

static uint64_t digest_of_inside(const hs_model *model, const hs_golden_report *golden,
                                 const hs_log *log) {
    const hs_model_traffic traffic = hs_model_traffic_of(model);
    const uint64_t counts[] = {traffic.read,           traffic.written,     golden->status,
                               golden->error_position, golden->generations, golden->vertices,
                               golden->faces,          golden->triangles,   golden->at_level};
    uint64_t h = digest(0xcbf29ce484222325u, counts, sizeof counts);
    for (uint32_t g = 0; g < golden->generations; g++) {
        h = digest(h, &golden->generation[g], sizeof golden->generation[g]);
        if (golden->decision[g]) h = digest(h, golden->decision[g], golden->generation[g].active);
    }
    for (uint32_t p = 0; p < HS_PROBES; p++)
        for (size_t i = 0; i < log->probe[p].count; i++) {
            const hs_transaction *t = &log->probe[p].transaction[i];
            h = digest(h, &t->cycle, sizeof t->cycle);
            h = digest(h, &t->item, sizeof t->item);
            h = digest(h, t->word, sizeof t->word);
        }
    return h;
}

bool run_engines(engines *e, const hs_model_config *config, vector *v, hs_error *err) {
    static hs_packet modelled;
    static hs_log log;
    hs_golden_report golden, again;
    if (!fit_engines(e, config, v->limits, err) ||
        !hs_model_run(e->model, &v->in, v->stalls, &modelled, &again, &v->report, &log, err) ||
        !hs_golden_run(e->golden, &v->in, &v->out, &golden, err))
        return false;
    if (hs_compare_words(&v->out, &modelled).different)
        return hs_fail(err, HS_EXIT_DIFFERENT, "golden and model send different words");
    const size_t words = 4 * (size_t)config->port;
    v->beats = (uint32_t)((v->out.words + words - 1) / words);
    v->beat_cycle = calloc(v->beats + 1, sizeof *v->beat_cycle);
    if (!v->beat_cycle) return hs_fail(err, HS_EXIT_INTERNAL, "no memory");
    for (uint32_t b = 0; b < v->beats; b++)
        v->beat_cycle[b] = hs_model_word_cycle(e->model, b * words);
    v->inside = digest_of_inside(e->model, &golden, &log);
    return true;
}

/* --- Files --------------------------------------------------------------------------------------
 */
static void put(FILE *file, const void *bytes, size_t size, const char *path) {
    if (size == 0 || fwrite(bytes, size, 1, file) == 1) return;
    fprintf(stderr, "mutation: %s: cannot be written\n", path);
    exit(HS_EXIT_FILE);
}

static void get(FILE *file, void *bytes, size_t size, const char *path) {
    if (size == 0 || fread(bytes, size, 1, file) == 1) return;
    fprintf(stderr, "mutation: %s: ends early\n", path);
    exit(HS_EXIT_FILE);
}

static FILE *must_open(const char *path, const char *mode) {
    FILE *file = fopen(path, mode);
    if (file) return file;
    fprintf(stderr, "mutation: %s: cannot be opened\n", path);
    exit(HS_EXIT_FILE);
}

void write_vectors(const vectors *all, const char *path) {
    FILE *file = must_open(path, "wb");
    put(file, all, sizeof *all, path);
    for (uint32_t i = 0; i < all->count; i++) {
        const vector *v = &all->item[i];
        put(file, v, sizeof *v, path);
        put(file, v->in.word, 4 * v->in.words, path);
        put(file, v->out.word, 4 * v->out.words, path);
        put(file, v->beat_cycle, v->beats * sizeof *v->beat_cycle, path);
    }
    if (fclose(file)) exit(HS_EXIT_FILE);
}

/* Not by the packets' own functions, which may hold the mutant. */
static void get_packet(FILE *file, hs_packet *packet, const char *path) {
    const size_t words = packet->words;
    const uint32_t view = packet->view;
    *packet = (hs_packet){.view = view, .words = words, .word = calloc(words + 1, 4)};
    if (!packet->word) exit(HS_EXIT_INTERNAL);
    get(file, packet->word, 4 * words, path);
}

vectors read_vectors(const char *path) {
    FILE *file = must_open(path, "rb");
    vectors all;
    get(file, &all, sizeof all, path);
    all.item = calloc(all.count + 1, sizeof *all.item);
    for (uint32_t i = 0; i < all.count; i++) {
        vector *v = &all.item[i];
        get(file, v, sizeof *v, path);
        get_packet(file, &v->in, path);
        get_packet(file, &v->out, path);
        v->beat_cycle = calloc(v->beats + 1, sizeof *v->beat_cycle);
        get(file, v->beat_cycle, v->beats * sizeof *v->beat_cycle, path);
    }
    fclose(file);
    return all;
}
