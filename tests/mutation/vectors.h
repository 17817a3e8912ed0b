/* SPDX-License-Identifier: Apache-2.0
 *
 * The test vectors that mutants have to survive, the cheapest and most telling first, and what the
 * pipeline answers to them.
 */
#ifndef HS_TESTS_MUTATION_VECTORS_H
#define HS_TESTS_MUTATION_VECTORS_H

#include "cycles.h"
#include "golden.h"
#include "model.h"

typedef struct vector {
    char name[80];
    hs_limits limits;
    hs_stalls stalls;
    hs_packet in, out;      /* out: what golden sends */
    hs_cycle_report report; /* the model's, and when each beat of the output was taken */
    uint32_t beats;
    uint64_t *beat_cycle;
    uint64_t inside; /* a digest: transactions, traffic, generations, decisions */
} vector;

typedef struct vectors {
    hs_model_config config;
    uint32_t count;
    vector *item;
} vectors;

/* Contexts that are kept for the next vector. */
typedef struct engines {
    hs_limits limits;
    hs_golden *golden;
    hs_model *model;
} engines;

/* Fills in what golden and model answer to v->in; what was there before is forgotten. False, with
 * the reason: they contradict each other, or memory is exhausted. */
bool run_engines(engines *e, const hs_model_config *config, vector *v, hs_error *err);

/* All vectors, `random` of them random, with answers, for a pipeline with that capacity; ends the
 * program if the engines contradict each other. In the project's folder: some are traces. */
vectors make_vectors(hs_limits capacity, const hs_model_config *config, uint32_t random);

/* To and from a file, for programs that hold a mutant. Both end the program on an error. */
void write_vectors(const vectors *all, const char *path);
vectors read_vectors(const char *path);

#endif
