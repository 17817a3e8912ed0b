/* SPDX-License-Identifier: Apache-2.0
 *
 * The test vectors for mutants of the C code, with the answers of the code as it is: its words,
 * cycles and counters are the RTL's (kill_rtl checks these vectors; `make test` and `make parity`
 * many more).
 *
 *   record_vectors FOLDER     FOLDER/smallest and FOLDER/default, for two architectures
 */
#include <stdio.h>

#include "vectors.h"

int main(int argc, char **argv) {
    const hs_limits capacity = {4096, 4096};
    hs_model_config config[2] = {HS_DEFAULT_CONFIG, HS_DEFAULT_CONFIG};
    config[0].port = config[0].lanes = 1;
    config[0].banks = config[0].window = 2;
    for (int i = 0; argc == 2 && i < 2; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", argv[1], i ? "default" : "smallest");
        const vectors all = make_vectors(capacity, &config[i], 600);
        uint64_t cycles = 0;
        for (uint32_t v = 0; v < all.count; v++)
            cycles += all.item[v].report.cycles;
        printf("%s: %u vectors, %llu cycles\n", path, all.count, (unsigned long long)cycles);
        write_vectors(&all, path);
    }
    return argc == 2 ? HS_EXIT_OK : HS_EXIT_USAGE;
}
