/* SPDX-License-Identifier: Apache-2.0
 *
 * The differential campaign: random meshes x views x settings x stalls through all engines, and
 * everything that must hold is checked (campaign_check.h). What fails is made small and written as
 * a trace.
 *
 *   campaign [--seed N] [--cases N] [--jobs N] [--out FOLDER] [--seconds N]
 *   campaign --trace FOLDER        checks the packets of a trace instead
 *
 * Case i of a campaign has the seed N + i, and depends on nothing else: `--seed N+i --cases 1` runs
 * it alone. Process k of the jobs runs every jobs-th case. Exit status 0: all cases hold, and, from
 * 2000 cases on, none of the kinds in the tables is empty.
 */
#include <getopt.h>
#include <inttypes.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "campaign_coverage.h"
#include "campaign_shrink.h"

enum {
    MOST_JOBS = 64,
    MOST_FAILURES = 3,   /* of a process: then it stops */
    COVERED_FROM = 2000, /* cases from which on an empty kind is a failure */
    CASE_SECONDS = 600   /* of processor time, in which a case must be done, cut down if need be */
};

typedef struct options {
    uint64_t seed, cases;
    uint32_t jobs, seconds;
    const char *program, *out, *trace;
} options;

/* What a process has done, where its parent sees it. */
typedef struct job {
    tally tally;
    coverage coverage;
    uint64_t seed; /* in work */
    uint32_t failures;
    bool ended;
} job;

typedef struct shared {
    atomic_uint_fast64_t done;
    job job[MOST_JOBS];
} shared;

/* --- Failures -----------------------------------------------------------------------------------
 */

static void say_case(const char *head, const campaign_case *c) {
    printf("  %s: %u faces, %u vertices, %u tags; %s, view %s\n", head, c->shape.faces,
           c->shape.vertices, c->shape.tags, mesh_kind[c->mesh], view_kind[c->view]);
}

static void report_failure(checker *c, campaign_case *which, const options *o) {
    char folder[4000], why[200];
    hs_error err;
    printf("seed %" PRIu64 " FAILS: %s\n", which->seed, c->text);
    say_case("as it was", which);
    if (campaign_check(c, which)) {
        printf("  it holds when it is run again: it depends on what was streamed before. Cases "
               "before it: --seed %" PRIu64 " --jobs %u\n",
               o->seed, o->jobs);
    } else {
        const uint32_t tried = campaign_shrink(c, which, o->seconds);
        printf("  made small in %u steps: %s\n", tried, c->text);
        say_case("small", which);
    }
    snprintf(folder, sizeof folder, "%s/seed-%" PRIu64, o->out, which->seed);
    snprintf(why, sizeof why, "From the campaign's seed %" PRIu64 ".", which->seed);
    if (campaign_write(which, folder, why, &err))
        printf("  trace: %s; run it alone: %s --trace %s\n", folder, o->program, folder);
    else
        printf("  no trace: %s\n", err.text);
    printf("  the case as it was: %s --seed %" PRIu64 " --cases 1\n", o->program, which->seed);
    fflush(stdout);
}

/* --- A process ----------------------------------------------------------------------------------
 */

static void run_job(uint32_t number, const options *o, shared *all) {
    static checker c;
    static campaign_case which;
    job *mine = &all->job[number];
    const struct itimerval limit = {.it_value.tv_sec = CASE_SECONDS};
    checker_begin(&c);
    for (uint64_t i = number; i < o->cases && mine->failures < MOST_FAILURES; i += o->jobs) {
        mine->seed = o->seed + i;
        setitimer(ITIMER_PROF, &limit, NULL); /* then a signal ends the process */
        campaign_make(&which, mine->seed);
        if (campaign_check(&c, &which)) {
            coverage_add(&mine->coverage, &which, &c);
        } else {
            mine->failures++;
            report_failure(&c, &which, o);
        }
        mine->tally = c.tally;
        const uint64_t done = atomic_fetch_add(&all->done, 1) + 1;
        if (done * 10 / o->cases != (done - 1) * 10 / o->cases) {
            printf("%" PRIu64 " of %" PRIu64 " cases\n", done, o->cases);
            fflush(stdout);
        }
    }
    checker_end(&c);
    mine->ended = true;
}

/* Runs all jobs, and adds up what they found. Gives how many cases failed. */
static uint32_t run_jobs(const options *o, shared *all) {
    pid_t child[MOST_JOBS];
    uint32_t failures = 0;
    fflush(stdout);
    for (uint32_t k = 0; k < o->jobs; k++) {
        child[k] = fork();
        if (child[k] == 0) {
            run_job(k, o, all);
            fflush(stdout);
            _exit(0);
        }
    }
    for (uint32_t k = 0; k < o->jobs; k++) {
        int status = 0;
        const job *one = &all->job[k];
        if (child[k] < 0 || waitpid(child[k], &status, 0) < 0) {
            printf("process %u could not be started\n", k);
            failures++;
        } else if (status != 0 || !one->ended) {
            printf("the process died (%s %d) in the case of seed %" PRIu64 ": %s --seed %" PRIu64
                   " --cases 1\n",
                   WIFSIGNALED(status) ? "signal" : "exit status",
                   WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), one->seed,
                   o->program, one->seed);
            failures++;
        }
        failures += one->failures;
    }
    return failures;
}

/* --- The figures --------------------------------------------------------------------------------
 */

static void add_tally(tally *sum, const tally *other) {
    /* All of it is counters. */
    uint64_t *to = (uint64_t *)sum;
    const uint64_t *from = (const uint64_t *)other;
    for (size_t i = 0; i < sizeof *sum / sizeof *to; i++)
        to[i] += from[i];
}

static void print_tally(const tally *t) {
    printf("result: %" PRIu64 " words of golden, model and rtl, %" PRIu64
           " transactions and %" PRIu64 " cycles of model and rtl compared\n",
           t->words, t->transactions, t->cycles);
    printf("result: %" PRIu64 " rows of three packets, %" PRIu64 " transactions and %" PRIu64
           " cycles of model and rtl compared\n",
           t->rows, t->row_transactions, t->row_cycles);
    printf("result: reference: %" PRIu64 " faces, %" PRIu64 " vertices; %" PRIu64 " of %" PRIu64
           " decisions otherwise in doubles\n",
           t->reference_faces, t->reference_vertices, t->decided_otherwise, t->decisions);
    printf("result: I1 %" PRIu64 " edges, I2 %" PRIu64 " vertices, I3 %" PRIu64
           " positions, I4 %" PRIu64 " corners, I5 %" PRIu64 " words\n",
           t->edges, t->rings, t->positions, t->corners, t->poisoned);
    printf("result: %" PRIu64 " faces in, %" PRIu64 " faces out\n", t->faces_in, t->faces_out);
}

static int run_campaign(const options *o) {
    shared *all =
        mmap(NULL, sizeof *all, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) {
        fprintf(stderr, "campaign: no memory\n");
        return HS_EXIT_INTERNAL;
    }
    const time_t start = time(NULL);
    printf("%" PRIu64 " cases from seed %" PRIu64 ", %u processes\n", o->cases, o->seed, o->jobs);
    const uint32_t failures = run_jobs(o, all);
    tally sum = {0};
    coverage seen = {0};
    for (uint32_t k = 0; k < o->jobs; k++) {
        add_tally(&sum, &all->job[k].tally);
        coverage_join(&seen, &all->job[k].coverage);
    }
    const uint32_t none = coverage_print(&seen);
    const bool covered = none == 0 || o->cases < COVERED_FROM;
    const bool whole = sum.cases == o->cases && sum.words > 0 && sum.transactions > 0;
    printf("result: seed %" PRIu64 ", %" PRIu64 " of %" PRIu64 " cases, %u failed, %lld s\n",
           o->seed, sum.cases, o->cases, failures, (long long)(time(NULL) - start));
    print_tally(&sum);
    printf("result: %u kinds of meshes, views, statuses and settings without a case%s\n", none,
           covered ? "" : ": FAILED");
    if (!whole) printf("not every case was run\n");
    munmap(all, sizeof *all);
    return failures == 0 && covered && whole ? HS_EXIT_OK : HS_EXIT_DIFFERENT;
}

static int run_trace(const char *folder) {
    static checker c;
    hs_error err;
    checker_begin(&c);
    const bool good = campaign_replay(&c, folder, &err);
    if (good)
        printf("%s: holds, %" PRIu64 " views, %" PRIu64 " words, %" PRIu64 " transactions\n",
               folder, c.tally.cases, c.tally.words, c.tally.transactions);
    else
        printf("%s: %s\n", folder, c.failed ? c.text : err.text);
    checker_end(&c);
    return good ? HS_EXIT_OK : c.failed ? HS_EXIT_DIFFERENT : err.code;
}

/* --- The command line ---------------------------------------------------------------------------
 */

static uint64_t number_of(const char *text) {
    char *end;
    const unsigned long long number = strtoull(text, &end, 0);
    if (*end || end == text) {
        fprintf(stderr, "campaign: \"%s\" should be a number\n", text);
        exit(HS_EXIT_USAGE);
    }
    return number;
}

int main(int argc, char **argv) {
    static const struct option names[] = {{"seed", required_argument, NULL, 's'},
                                          {"cases", required_argument, NULL, 'c'},
                                          {"jobs", required_argument, NULL, 'j'},
                                          {"seconds", required_argument, NULL, 't'},
                                          {"out", required_argument, NULL, 'o'},
                                          {"trace", required_argument, NULL, 'r'},
                                          {NULL, 0, NULL, 0}};
    options o = {.seed = 1,
                 .cases = 1000,
                 .jobs = 2,
                 .seconds = 120,
                 .program = argv[0],
                 .out = "out/campaign"};
    for (int c; (c = getopt_long(argc, argv, "", names, NULL)) != -1;)
        switch (c) {
        case 's':
            o.seed = number_of(optarg);
            break;
        case 'c':
            o.cases = number_of(optarg);
            break;
        case 'j':
            o.jobs = (uint32_t)number_of(optarg);
            break;
        case 't':
            o.seconds = (uint32_t)number_of(optarg);
            break;
        case 'o':
            o.out = optarg;
            break;
        case 'r':
            o.trace = optarg;
            break;
        default:
            return HS_EXIT_USAGE;
        }
    if (optind < argc || o.cases == 0 || o.jobs == 0 || o.jobs > MOST_JOBS) {
        fprintf(stderr, "campaign: at least one case, 1 to %d jobs, no operands\n", MOST_JOBS);
        return HS_EXIT_USAGE;
    }
    if (o.cases < o.jobs) o.jobs = (uint32_t)o.cases;
    return o.trace ? run_trace(o.trace) : run_campaign(&o);
}
