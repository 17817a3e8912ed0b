/* SPDX-License-Identifier: Apache-2.0
 *
 * A library to preload: of the allocations that a program makes from main on, its own and its
 * libraries', one is refused, or all from one on.
 *
 *   FAIL_ALLOC=N     the N-th, from 1;  FAIL_ALLOC=N+  it and all that follow
 *   FAIL_ALLOC_COUNT=FILE   where it writes how many there were, when main has returned
 *
 * What the loader and the libraries' constructors allocate before main is let through: the program
 * has no say in it.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What glibc calls its own. */
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *block, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

static atomic_bool armed;
static atomic_ulong count;
static unsigned long refused;
static bool and_later;

static bool refuse(void) {
    if (!atomic_load(&armed)) return false;
    const unsigned long number = atomic_fetch_add(&count, 1) + 1;
    if (!refused || (and_later ? number < refused : number != refused)) return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size) {
    return refuse() ? NULL : __libc_malloc(size);
}

void *calloc(size_t number, size_t size) {
    return refuse() ? NULL : __libc_calloc(number, size);
}

void *realloc(void *block, size_t size) {
    return refuse() ? NULL : __libc_realloc(block, size);
}

void *memalign(size_t alignment, size_t size) {
    return refuse() ? NULL : __libc_memalign(alignment, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
    return memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size) {
    void *got = memalign(alignment, size);
    if (!got) return ENOMEM;
    *block = got;
    return 0;
}

/* --- From main on -------------------------------------------------------------------------------
 */

typedef int main_function(int argc, char **argv, char **environment);
static main_function *real_main;

static int counted_main(int argc, char **argv, char **environment) {
    const char *wanted = getenv("FAIL_ALLOC"), *path = getenv("FAIL_ALLOC_COUNT");
    char *end = NULL;
    if (wanted) refused = strtoul(wanted, &end, 10);
    and_later = end && *end == '+';
    atomic_store(&armed, true);
    const int code = real_main(argc, argv, environment);
    atomic_store(&armed, false);
    const int file = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    if (file >= 0) {
        dprintf(file, "%lu\n", atomic_load(&count));
        close(file);
    }
    return code;
}

int __libc_start_main(main_function *main, int argc, char **argv, main_function *init,
                      void (*fini)(void), void (*at_end)(void), void *stack) {
    int (*start)(main_function *, int, char **, main_function *, void (*)(void), void (*)(void),
                 void *);
    void *symbol = dlsym(RTLD_NEXT, "__libc_start_main");
    memcpy(&start, &symbol, sizeof start);
    real_main = main;
    return start(counted_main, argc, argv, init, fini, at_end, stack);
}
