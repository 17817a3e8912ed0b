/* SPDX-License-Identifier: Apache-2.0 */
#include "compare.h"

#include <string.h>

hs_word_comparison hs_compare_words(const hs_packet *expected, const hs_packet *actual) {
    const size_t both = expected->words < actual->words ? expected->words : actual->words;
    const size_t most = expected->words < actual->words ? actual->words : expected->words;
    hs_word_comparison comparison = {.compared = most, .different = most - both, .first = both};
    for (size_t i = both; i-- > 0;)
        if (expected->word[i] != actual->word[i]) {
            comparison.different++;
            comparison.first = i;
        }
    return comparison;
}

/* "0x3f800000 (1)" for a coordinate, "0xff800001" else. */
static void print_word(const hs_packet *packet, size_t word, bool number, char *text, size_t size) {
    if (word >= packet->words) {
        snprintf(text, size, "nothing: it ends here");
        return;
    }
    float value;
    memcpy(&value, &packet->word[word], sizeof value);
    if (number)
        snprintf(text, size, "0x%08x (%.9g)", packet->word[word], (double)value);
    else
        snprintf(text, size, "0x%08x", packet->word[word]);
}

void hs_compare_describe(const hs_packet *expected, const hs_packet *actual, size_t word,
                         const char *who, char *text, size_t size) {
    char what[200], wanted[60], sent[60];
    const bool inside = word < expected->words;
    hs_output_describe(inside ? expected : actual, word, what, sizeof what);
    const bool number = strncmp(what, "position", 8) == 0;
    print_word(expected, word, number, wanted, sizeof wanted);
    print_word(actual, word, number, sent, sizeof sent);
    snprintf(text, size, "word %zu, %s: expected %s, %s sent %s", word, what, wanted, who, sent);
}
