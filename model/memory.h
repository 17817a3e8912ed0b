/* SPDX-License-Identifier: Apache-2.0
 *
 * Memory of large arrays. Blocks of some megabytes and more ask the system for huge pages: who
 * jumps about in them waits less for the TLB, and who fills them takes a fault every 2 MB instead
 * of every 4 KB. `make bench` shows it: golden at depth 12, and on fresh memory.
 */
#ifndef HS_MEMORY_H
#define HS_MEMORY_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* As realloc; freed by free. */
void *hs_reallocate(void *block, size_t bytes);

/* As realloc, for one of several arrays that are walked side by side: large ones with different
 * numbers, 0 to 31, start at different distances from a huge page, so that their elements do not
 * compete for the same sets of the caches. Freed by hs_array_free alone. */
void *hs_array_reallocate(void *array, size_t bytes, uint32_t number);
void hs_array_free(void *array);

#ifdef __cplusplus
}
#endif
#endif
