/* SPDX-License-Identifier: Apache-2.0
 *
 * Two output packets, word for word.
 */
#ifndef HS_COMPARE_H
#define HS_COMPARE_H

#include "stream.h"

typedef struct hs_word_comparison {
    uint64_t compared;  /* words: as many as the longer packet has */
    uint64_t different; /* words that differ or that one of them does not have */
    size_t first;       /* the first of them; compared if there is none */
} hs_word_comparison;

hs_word_comparison hs_compare_words(const hs_packet *expected, const hs_packet *actual);

/* The first difference in a sentence, as in "word 51: position of vertex 12 (w): expected
 * 0x3f800000 (1), rtl sent 0x3f800001 (1.00000012)". who sent the actual packet. */
void hs_compare_describe(const hs_packet *expected, const hs_packet *actual, size_t word,
                         const char *who, char *text, size_t size);

#endif
