/* SPDX-License-Identifier: Apache-2.0
 *
 * Has the mutants of the RTL answer the test vectors, each until its first difference in a word, a
 * cycle, a counter or a register.
 *
 *   kill_rtl JOBS RANDOM CYCLES MUTANT...   a line for each mutant: number, "killed" or "alive", by
 * what
 *
 * RANDOM is how many of the vectors are random. Of all vectors those are taken that begin within
 * CYCLES.
 *
 * Mutant 0 is none: it has to survive, or the program ends with HS_EXIT_DIFFERENT.
 */
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../registers_shim.h"
#include "../rtl_samples.h"
#include "kill_rtl.h"
#include "vectors.h"

enum { VERTICES = MUTANTS_VERTICES, QUADS = MUTANTS_QUADS, SECONDS = 120, FINDING = 400, CUTS = 6 };

uint16_t living_mutant;

static const hs_limits capacity = {VERTICES, QUADS};

/* --- Registers ----------------------------------------------------------------------------------
 */
static const struct {
    uint32_t address;
    const char *access;
} registers[] = {
#define CONSTANT(name, value, what)
#define RECORD(name, value, what)
#define STATUS(name, value, what, remedy)
#define STAGE(name, index, what)
#define ACTIVITY(name, index, what)
#define REGISTER(name, address, access, what) {address, access},
#define PROBE(name, index, stage, what)
#define EXIT(name, value, what)
#include "definitions.def"
};

/* "ro", "rw", or NULL where no register is. */
static const char *access_of(uint32_t address) {
    for (size_t i = 0; i < sizeof registers / sizeof *registers; i++)
        if (registers[i].address == address) return registers[i].access;
    const uint32_t behind = address - HS_REG_STAGES;
    const bool counter = address >= HS_REG_STAGES && behind < 32 * HS_STAGES && behind % 4 == 0 &&
                         behind % 32 / 4 < HS_ACTIVITIES + 2;
    return counter ? "ro" : NULL;
}

static bool reads(registers_rtl *rtl, uint32_t address, int response, uint32_t value,
                  char *finding) {
    uint32_t data = 0;
    const int answer = registers_rtl_read(rtl, address, &data, NULL);
    if (answer == response && data == value) return true;
    snprintf(finding, FINDING, "register 0x%03x reads 0x%x with response %d", address, data,
             answer);
    return false;
}

static bool writes(registers_rtl *rtl, uint32_t address, int response, uint32_t value,
                   uint32_t strobe, char *finding) {
    const int answer = registers_rtl_write(rtl, address, value, strobe);
    if (answer == response) return true;
    snprintf(finding, FINDING, "register 0x%03x is written with response %d", address, answer);
    return false;
}

/* A limit holds what is written, byte by byte, cut to the capacity. */
static bool limit_holds(registers_rtl *rtl, uint32_t address, uint32_t most, char *finding) {
    static const uint32_t values[] = {0x155, 0xffffffff, 0x2aa, 0, 1u << 24, 1u << 31};
    uint32_t held = most;
    for (uint32_t i = 0; i < 4 * sizeof values / sizeof *values; i++) {
        static const uint32_t strobes[] = {15, 1, 2, 13, 15, 4, 15, 8, 0};
        const uint32_t strobe = strobes[i % 9], value = values[i % 6];
        uint32_t mask = 0;
        for (uint32_t b = 0; b < 4; b++)
            mask |= strobe >> b & 1 ? 0xffu << 8 * b : 0;
        held = (value & mask) | (held & ~mask);
        if (held > most) held = most;
        if (!writes(rtl, address, OKAY, value, strobe, finding) ||
            !reads(rtl, address, OKAY, held, finding))
            return false;
    }
    for (uint32_t bit = 0; bit < 32; bit++) {
        held = 1u << bit > most ? most : 1u << bit;
        if (!writes(rtl, address, OKAY, 1u << bit, 15, finding) ||
            !reads(rtl, address, OKAY, held, finding))
            return false;
    }
    return writes(rtl, address, OKAY, most, 15, finding) &&
           reads(rtl, address, OKAY, most, finding);
}

static bool registers_are_right(char *finding) {
    registers_rtl *rtl = registers_rtl_new(3);
    const uint32_t fixed[][2] = {{HS_REG_IDENTITY, HS_IDENTITY},
                                 {HS_REG_VERSION, HS_STREAM_VERSION},
                                 {HS_REG_CAPACITY_VERTICES, VERTICES},
                                 {HS_REG_CAPACITY_QUADS, QUADS},
                                 {HS_REG_LIMIT_VERTICES, VERTICES},
                                 {HS_REG_LIMIT_QUADS, QUADS},
                                 {HS_REG_BUSY, 0},
                                 {HS_REG_STATUS, HS_STATUS_OK},
                                 {HS_REG_POSITION, HS_NO_POSITION},
                                 {HS_REG_VIEWS, 0},
                                 {HS_REG_CONFLICTS, 0},
                                 {HS_REG_PIPELINE, 0}};
    bool good = true;
    for (size_t i = 0; good && i < sizeof fixed / sizeof *fixed; i++)
        good = reads(rtl, fixed[i][0], OKAY, fixed[i][1], finding);
    for (uint32_t s = 0; good && s < HS_STAGES; s++)
        for (uint32_t k = 0; good && k < HS_ACTIVITIES + 2; k++)
            if (k != HS_ACTIVITY_idle)
                good = reads(rtl, HS_REG_STAGES + 32 * s + 4 * k, OKAY, 0, finding);
    for (uint32_t address = 0; good && address < 4096; address++)
        if (!access_of(address))
            good = reads(rtl, address, SLVERR, 0, finding) &&
                   writes(rtl, address, SLVERR, 7, 15, finding);
        else if (!strcmp(access_of(address), "ro"))
            good = writes(rtl, address, SLVERR, 7, 15, finding);
    good = good && limit_holds(rtl, HS_REG_LIMIT_VERTICES, VERTICES, finding) &&
           limit_holds(rtl, HS_REG_LIMIT_QUADS, QUADS, finding);
    for (size_t i = 0; good && i < sizeof fixed / sizeof *fixed; i++)
        good = reads(rtl, fixed[i][0], OKAY, fixed[i][1], finding);
    for (uint32_t p = 0; good && p < 16; p++)
        good = writes(rtl, HS_REG_PIPELINE, OKAY, p, 15, finding) &&
               writes(rtl, HS_REG_PIPELINE, OKAY, ~p, 14, finding) &&
               reads(rtl, HS_REG_PIPELINE, OKAY, p, finding);
    uint32_t cycles = 0;
    uint64_t taken = 0;
    good = good && registers_rtl_read(rtl, HS_REG_CYCLES, &cycles, &taken) == OKAY &&
           reads(rtl, HS_REG_CYCLES_HIGH, OKAY, 0, finding);
    if (good && cycles != taken) {
        snprintf(finding, FINDING, "%u cycles are counted instead of %llu", cycles,
                 (unsigned long long)taken);
        good = false;
    }
    registers_rtl_free(rtl);
    return good;
}

/* --- Vectors ------------------------------------------------------------------------------------
 */
static bool beats_are_in_time(const hs_rtl *rtl, const vector *v, const hs_model_config *config,
                              char *finding) {
    for (uint32_t b = 0; b < v->beats; b++) {
        const uint64_t cycle = hs_rtl_word_cycle(rtl, 4 * (size_t)config->port * b);
        if (cycle == v->beat_cycle[b]) continue;
        snprintf(finding, FINDING, "%s: beat %u in cycle %llu instead of %llu", v->name, b,
                 (unsigned long long)cycle, (unsigned long long)v->beat_cycle[b]);
        return false;
    }
    return true;
}

static bool answers(hs_rtl *rtl, const vector *v, const hs_model_config *config, char *finding) {
    static hs_packet out;
    hs_cycle_report report;
    hs_error err = {0};
    char text[200];
    if (!hs_rtl_run(rtl, &v->in, v->stalls, &out, &report, &err))
        snprintf(finding, FINDING, "%s: %.300s", v->name, err.text);
    else if (hs_compare_words(&v->out, &out).different) {
        hs_compare_describe(&v->out, &out, hs_compare_words(&v->out, &out).first, "the RTL", text,
                            sizeof text);
        snprintf(finding, FINDING, "%s: %s", v->name, text);
    } else if (!hs_cycle_report_equal(&report, &v->report, text, sizeof text))
        snprintf(finding, FINDING, "%s: %s", v->name, text);
    else
        return beats_are_in_time(rtl, v, config, finding);
    return false;
}

/* Runs of the vector that a reset ends in their midst: none may come to its end. */
static bool is_cut(hs_rtl *rtl, const vector *v, char *finding) {
    static hs_packet out;
    for (uint64_t part = 1; part < CUTS; part++) {
        hs_cycle_report report;
        hs_error err = {0};
        hs_rtl_cycle_limit(rtl, v->report.cycles * part / CUTS);
        const bool ended = hs_rtl_run(rtl, &v->in, v->stalls, &out, &report, &err);
        hs_rtl_cycle_limit(rtl, UINT64_MAX);
        if (!ended) continue;
        snprintf(finding, FINDING, "%s: ends too early", v->name);
        return false;
    }
    return true;
}

/* The first vectors again, one packet right behind the other. */
static bool stream_is_right(const vectors *all, char *finding) {
    enum { PACKETS = 4 };
    static hs_packet in[PACKETS], out[PACKETS];
    hs_flight_view view[PACKETS];
    hs_error err = {0};
    uint64_t cycles;
    hs_rtl *rtl = hs_rtl_new(capacity, 1, &err);
    for (uint32_t i = 0; i < PACKETS; i++)
        in[i] = all->item[i].in;
    bool good = rtl && hs_rtl_stream(rtl, in, PACKETS, no_stalls, out, view, &cycles, &err);
    if (!good) snprintf(finding, FINDING, "packets in a row: %.300s", err.text);
    for (uint32_t i = 0; good && i < PACKETS; i++) {
        good = !hs_compare_words(&all->item[i].out, &out[i]).different;
        if (!good) snprintf(finding, FINDING, "packets in a row: words of the one numbered %u", i);
    }
    hs_rtl_free(rtl);
    return good;
}

/* One simulation as long as the limits stay the same. Before some vectors it is reset while it
 * works on them. */
static bool survives(const vectors *all, char *finding) {
    hs_rtl *rtl = NULL;
    hs_error err = {0};
    bool good = true;
    for (uint32_t i = 0; good && i < all->count; i++) {
        const vector *v = &all->item[i];
        if (i == 0 || memcmp(&v->limits, &v[-1].limits, sizeof v->limits) != 0) {
            hs_rtl_free(rtl);
            rtl = hs_rtl_new(v->limits, i + 1, &err);
            if (!rtl) snprintf(finding, FINDING, "reset: %.300s", err.text);
        }
        good = rtl && (i % 16 || is_cut(rtl, v, finding)) && answers(rtl, v, &all->config, finding);
    }
    hs_rtl_free(rtl);
    return good && stream_is_right(all, finding) && registers_are_right(finding);
}

/* --- Mutants ------------------------------------------------------------------------------------
 */
static void live(uint32_t mutant, const vectors *all) {
    char finding[FINDING] = "";
    const struct rlimit limit = {SECONDS, SECONDS};
    setrlimit(RLIMIT_CPU, &limit);
    if (!freopen("/dev/null", "w", stderr)) _exit(HS_EXIT_INTERNAL); /* Verilator's own words */
    living_mutant = (uint16_t)mutant;
    const bool good = survives(all, finding);
    printf("%u\t%s\t%s\n", mutant, good ? "alive" : "killed", finding);
    fflush(stdout);
    _exit(HS_EXIT_OK);
}

/* A simulation that broke down has printed nothing. */
static void bury(uint32_t mutant, int status) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        printf("%u\talive\tafter %d seconds it had not answered\n", mutant, SECONDS);
    else if (!WIFEXITED(status) || WEXITSTATUS(status) != HS_EXIT_OK)
        printf("%u\tkilled\tthe simulation broke down\n", mutant);
    fflush(stdout);
}

static void run_mutants(char **number, uint32_t count, uint32_t jobs, const vectors *all) {
    enum { MOST_JOBS = 64 };
    pid_t process[MOST_JOBS] = {0};
    uint32_t mutant[MOST_JOBS] = {0}, next = 0, running = 0;
    if (jobs > MOST_JOBS) jobs = MOST_JOBS;
    while (next < count || running > 0) {
        for (uint32_t j = 0; j < jobs && next < count; j++) {
            if (process[j]) continue;
            mutant[j] = (uint32_t)atoi(number[next++]);
            const pid_t pid = fork();
            if (pid == 0) live(mutant[j], all);
            if (pid < 0) exit(HS_EXIT_INTERNAL);
            process[j] = pid;
            running++;
        }
        int status;
        const pid_t ended = wait(&status);
        for (uint32_t j = 0; j < jobs; j++)
            if (process[j] == ended) {
                bury(mutant[j], status);
                process[j] = 0;
                running--;
            }
    }
}

int main(int argc, char **argv) {
    if (argc < 5) {
        fprintf(stderr, "usage: kill_rtl JOBS RANDOM CYCLES MUTANT...\n");
        return HS_EXIT_USAGE;
    }
    hs_error err = {0};
    char finding[FINDING] = "";
    hs_rtl *rtl = hs_rtl_new(capacity, 1, &err);
    if (!rtl) fprintf(stderr, "mutation: %s\n", err.text);
    if (!rtl) return HS_EXIT_DIFFERENT;
    const hs_model_config config = hs_rtl_config(rtl);
    vectors all = make_vectors(capacity, &config, (uint32_t)atoi(argv[2]));
    uint64_t cycles = 0;
    hs_rtl_free(rtl);
    const uint64_t most = strtoull(argv[3], NULL, 10);
    uint32_t taken = 0;
    for (; taken < all.count && cycles < most; taken++)
        cycles += all.item[taken].report.cycles;
    all.count = taken;
    fprintf(stderr, "%u vectors, %llu cycles\n", all.count, (unsigned long long)cycles);
    if (!survives(&all, finding)) {
        fprintf(stderr, "mutation: without a mutant: %s\n", finding);
        return HS_EXIT_DIFFERENT;
    }
    run_mutants(argv + 4, (uint32_t)argc - 4, (uint32_t)atoi(argv[1]), &all);
    return HS_EXIT_OK;
}
