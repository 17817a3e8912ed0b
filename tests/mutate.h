/* SPDX-License-Identifier: Apache-2.0
 *
 * Changes to packets, for fuzzing: bits, words, records, lengths, and what a half-edge names. They
 * look at a packet's counts but believe none of them.
 */
#ifndef HS_TESTS_MUTATE_H
#define HS_TESTS_MUTATE_H

#include "stream.h"

typedef enum mutation {
    MUTATE_BITS,    /* one to three flipped */
    MUTATE_WORDS,   /* one to three become telling values, or copies of others */
    MUTATE_HEADER,  /* a setting, a depth, a count */
    MUTATE_CORNERS, /* another vertex, twin, place, number of sides, sharpness */
    MUTATE_NUMBERS, /* of matrix and vertices: huge, tiny, not finite */
    MUTATE_CUT,     /* ends earlier, by records */
    MUTATE_REPEAT,  /* some records twice: all behind shifts */
    MUTATE_DROP,    /* some records are missing */
    MUTATE_MOVE,    /* two records change places, or one covers the other */
    MUTATE_SPLICE,  /* the head of this packet, the tail of the other */
    MUTATE_JOIN,    /* this packet and the other, without an end between them */
    MUTATIONS
} mutation;

const char *mutation_name(mutation what);

/* Changes a packet in one of these ways, at random; it keeps whole records, at least one and at
 * most `longest`. other: another packet with words. */
mutation mutate_packet(hs_packet *packet, const hs_packet *other, size_t longest, uint64_t *random);

/* 0 to limit - 1; 0 if limit is 0. */
uint32_t mutate_below(uint64_t *random, size_t limit);

#endif
