/* SPDX-License-Identifier: Apache-2.0
 *
 * Linked with a mutant of the C code: has golden and model answer the test vectors, until the first
 * difference.
 *
 *   kill_c VECTORS     HS_EXIT_DIFFERENT and a line about the difference, or HS_EXIT_OK
 */
#include <stdio.h>
#include <string.h>

#include "vectors.h"

static bool same_words(const hs_packet *a, const hs_packet *b) {
    return a->view == b->view && a->words == b->words &&
           memcmp(a->word, b->word, 4 * a->words) == 0;
}

static const char *difference(engines *e, const hs_model_config *config, const vector *expected) {
    vector v = *expected;
    hs_error err = {0};
    v.out = (hs_packet){0};
    if (!run_engines(e, config, &v, &err)) return "the engines contradict each other";
    if (!same_words(&v.out, &expected->out)) return "words";
    if (memcmp(&v.report, &expected->report, sizeof v.report) != 0) return "cycles or counters";
    if (memcmp(v.beat_cycle, expected->beat_cycle, v.beats * sizeof *v.beat_cycle) != 0)
        return "the cycle of a beat";
    if (v.inside != expected->inside) return "transactions, traffic or generations";
    return NULL;
}

int main(int argc, char **argv) {
    if (argc != 2) return HS_EXIT_USAGE;
    const vectors all = read_vectors(argv[1]);
    engines e = {0};
    for (uint32_t i = 0; i < all.count; i++) {
        const char *what = difference(&e, &all.config, &all.item[i]);
        if (!what) continue;
        printf("%s: %s\n", all.item[i].name, what);
        return HS_EXIT_DIFFERENT;
    }
    return all.count > 0 ? HS_EXIT_OK : HS_EXIT_INTERNAL;
}
