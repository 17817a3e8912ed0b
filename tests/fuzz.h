/* SPDX-License-Identifier: Apache-2.0
 *
 * What is fuzzed. A target takes any bytes, gives them to a part of the project as a file's
 * content, and ends the process if what comes of it breaks that part's contract. libFuzzer calls
 * the targets with bytes that it makes up (fuzz_main.c), test_fuzz.c with the files of
 * tests/corpus/TARGET.
 *
 *   fuzz_text.c     obj, views, trace, text, journal, expected: what people and programs write
 *   fuzz_stream.c   input, output: packets
 *   fuzz_surface.c  surface: from an OBJ text and a view through golden to the invariants
 */
#ifndef HS_TESTS_FUZZ_H
#define HS_TESTS_FUZZ_H

#include "error.h"
#include "trace.h"

/* Whether the bytes were what the part under test takes: both must occur in a corpus. */
typedef enum fuzz_verdict { FUZZ_REFUSED, FUZZ_TAKEN } fuzz_verdict;

typedef struct fuzz_target {
    const char *name; /* its corpus is tests/corpus/NAME */
    size_t longest;   /* bytes of an input */
    fuzz_verdict (*run)(const uint8_t *bytes, size_t size);
    /* Stream files are changed packet by packet, as libFuzzer would never get past frame and CRC;
     * NULL elsewhere. mutate and cross return the size of what they made, at most `longest`;
     * mend makes frames, counts and CRC fit what is there. */
    size_t (*mutate)(uint8_t *bytes, size_t size, size_t room, uint64_t seed);
    size_t (*cross)(uint8_t *out, size_t room, const uint8_t *a, size_t a_size, const uint8_t *b,
                    size_t b_size, uint64_t seed);
    void (*mend)(uint8_t *bytes, size_t size);
} fuzz_target;

extern const fuzz_target fuzz_obj, fuzz_views, fuzz_trace, fuzz_text, fuzz_journal, fuzz_expected,
    fuzz_input, fuzz_output, fuzz_surface;

/* All of them; NULL ends the list. */
extern const fuzz_target *const fuzz_targets[];

/* Ends the process with a message unless the claim holds. */
void fuzz_claim(bool holds, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* An error as error.h promises it: the code that it should have, and a line fit for printing that
 * begins with `place`. */
void fuzz_claim_error(const hs_error *err, int code, const char *place);

/* Packets survive being shown as text and built from it, and being written and read. */
void fuzz_claim_packets(const hs_stream_file *file);

/* A copy of exactly that size and a zero byte, so that a byte too many is seen. From malloc. */
char *fuzz_copy(const uint8_t *bytes, size_t size);

/* A file of that name in a folder of this process, which goes when it ends. */
const char *fuzz_path(const char *name);

#endif
