/* SPDX-License-Identifier: Apache-2.0
 *
 * Allocations that fail on demand, the program's own and its libraries': included by a test, these
 * take glibc's place, which lets a program have its own. tests/fail_alloc.c does the same to
 * programs as they are.
 */
#ifndef HS_TESTS_ALLOCATIONS_H
#define HS_TESTS_ALLOCATIONS_H

#include <malloc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void __libc_free(void *block);

static struct {
    bool counting;
    uint32_t made;    /* since counting began */
    uint32_t failing; /* the one that fails, from 1 */
    bool all_behind;  /* and all behind it */
    size_t held;      /* bytes of all blocks that are not freed */
} allocations;

static bool allocation_fails(void) {
    if (!allocations.counting) return false;
    allocations.made++;
    return allocations.all_behind ? allocations.made >= allocations.failing
                                  : allocations.made == allocations.failing;
}

static void *allocation_taken(void *block) {
    allocations.held += malloc_usable_size(block);
    return block;
}

void *malloc(size_t size) {
    return allocation_fails() ? NULL : allocation_taken(__libc_malloc(size));
}
void *calloc(size_t count, size_t size) {
    return allocation_fails() ? NULL : allocation_taken(__libc_calloc(count, size));
}
void *realloc(void *block, size_t size) {
    if (allocation_fails()) return NULL;
    const size_t before = malloc_usable_size(block);
    void *more = __libc_realloc(block, size);
    if (more) allocations.held -= before;
    return allocation_taken(more);
}
void free(void *block) {
    allocations.held -= malloc_usable_size(block);
    __libc_free(block);
}

/* From here to stop_failing the allocation of that number fails, from 1, or all from it on. */
static void start_failing(uint32_t number, bool all_behind) {
    allocations.made = 0;
    allocations.failing = number;
    allocations.all_behind = all_behind;
    allocations.counting = true;
}

/* Whether one did. */
static bool stop_failing(void) {
    allocations.counting = false;
    return allocations.made >= allocations.failing;
}

#endif
