/* SPDX-License-Identifier: Apache-2.0 */
#include "memory.h"

#include <malloc.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { PAGE = 4096, LARGE = 4 << 20, LINE = 64 };

static void *allocate(size_t bytes) {
    void *block = malloc(bytes);
#ifdef MADV_HUGEPAGE
    if (block && bytes >= LARGE) {
        const uintptr_t start = ((uintptr_t)block + PAGE - 1) & ~(uintptr_t)(PAGE - 1);
        const uintptr_t end = ((uintptr_t)block + bytes) & ~(uintptr_t)(PAGE - 1);
        /* A wish: whether it is granted changes nothing but speed. */
        (void)madvise((void *)start, end - start, MADV_HUGEPAGE);
    }
#endif
    return block;
}

static size_t lesser(size_t a, size_t b) {
    return a < b ? a : b;
}

/* Large blocks are copied: realloc would move their mapping to where huge pages do not fit, and
 * they would be split for good. */
void *hs_reallocate(void *block, size_t bytes) {
    if (bytes < LARGE) return realloc(block, bytes);
    void *more = allocate(bytes);
    if (!more || !block) return more;
    memcpy(more, block, lesser(malloc_usable_size(block), bytes));
    free(block);
    return more;
}

/* --- Arrays -------------------------------------------------------------------------------------
 */

/* Before the elements, and no less aligned than malloc's blocks. */
typedef struct header {
    size_t ahead; /* bytes from the block's start to the elements */
    size_t bytes; /* of elements */
} header;
_Static_assert(sizeof(header) % 16 == 0, "elements are aligned as malloc aligns");

static header *header_of(void *array) {
    return (header *)array - 1;
}

void *hs_array_reallocate(void *array, size_t bytes, uint32_t number) {
    /* A page and a line for each number: apart in caches that are indexed by either. */
    const size_t ahead = sizeof(header) + (bytes < LARGE ? 0 : number * (size_t)(PAGE + LINE));
    char *block = bytes > SIZE_MAX - ahead ? NULL : allocate(ahead + bytes);
    if (!block) return NULL;
    void *more = block + ahead;
    *header_of(more) = (header){ahead, bytes};
    if (array) memcpy(more, array, lesser(header_of(array)->bytes, bytes));
    hs_array_free(array);
    return more;
}

void hs_array_free(void *array) {
    if (array) free((char *)array - header_of(array)->ahead);
}
