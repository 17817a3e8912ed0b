/* SPDX-License-Identifier: Apache-2.0
 *
 * What a pipeline of the default capacities holds: the words of its memories
 * (docs/architecture.md), and what waits in windows and FIFOs. The tables follow the RTL's modules.
 */
#include "model_parts.h"

enum { V = HS_VERTEX_BITS, Q = HS_QUAD_BITS, H = HS_HALFEDGE_BITS };

/* gather.sv: items, and four lanes' numbers and words. */
static uint64_t gather_bits(const hs_model_config *c, uint64_t item, uint64_t index,
                            uint64_t word) {
    const uint64_t way = (uint64_t)(c->latency - 1) * c->banks * (word + 8);
    return c->window * (item + HS_LANES * (index + word + 2)) + way;
}

static uint64_t scatter_bits(const hs_model_config *c, uint64_t index, uint64_t word) {
    return c->window * HS_LANES * (index + word + 1);
}

static uint64_t window_bits(const hs_model_config *c) {
    const uint64_t quad = 4 * V; /* origins */
    const uint64_t split_rest = 1 + 1 + 8 + 1 + 1 + 4 + 16 + V + 128 + quad;
    const uint64_t split_item = 1 + split_rest + Q + 12 + 4 * H;
    const uint64_t number_item = 9 + split_rest + 4 * H + Q + 12 + quad;
    return gather_bits(c, quad + 30, V, 2 * HS_POSITION_WORD + HS_SHARP_WORD) + /* classify */
           2 * scatter_bits(c, V, 137) + gather_bits(c, quad + 6, V, HS_MARK_WORD) +
           scatter_bits(c, V, 1) +                                    /* select */
           gather_bits(c, quad + 142, V, 1) + scatter_bits(c, V, 1) + /* guard */
           gather_bits(c, split_item, Q, HS_VERDICT_WORD) +           /* split */
           gather_bits(c, number_item, Q, HS_NUMBER_WORD) + 2 * c->window * number_item +
           2 * scatter_bits(c, Q, HS_HALF_WORD + HS_EDGE_WORD);
}

static uint64_t fifo_bits(const hs_model_config *c) {
    const uint64_t quad = 4 * V, fold = 512;
    const uint64_t classify = fold * (512 + quad + 18 + 1 + 398);
    const uint64_t select = fold * (quad + 3), guard = fold * (quad + 5 + V + 2);
    const uint64_t write = fold * (16 + 13 + 2 * quad + 12 + 4 * H + 128 + V + 12 + 9 + H);
    const uint64_t pass = fold * (4 * H + 25) + 8 * c->window * 512;
    const uint64_t ops = c->ops * (562 + 8) + c->ops * (V + 129) + c->ops / 2 * 4 * (V + 128);
    return classify + select + guard + write + pass + ops;
}

/* Words of FIFOs, as above, that parity adds a bit to: folds have items and results. */
static uint64_t fifo_words(const hs_model_config *c) {
    return 4 * 2 * 512 + 512 + 8 * c->window + 2 * c->window + c->ops * 5 / 2 + 8 + 16;
}

uint64_t hs_model_memory_bits(const hs_model_config *c) {
    const hs_limits capacity = c->capacity;
    const uint64_t vertex = HS_BIRTH_WORDS + HS_RING_WORD + 2;
    const uint64_t quad = 4 * HS_HALF_WORD + 2 * HS_EDGE_WORD + HS_POINT_WORD + 1 +
                          2 * HS_VERDICT_WORD + HS_NUMBER_WORD;
    /* Words a vertex: position, sum, sharp, ring, mark, chosen, held; a quad: four halves, two edge
     * sums, point, selected, two verdicts, number. */
    const uint64_t parity =
        c->parity ? 7 * capacity.vertices + 11 * capacity.quads + fifo_words(c) : 0;
    return c->views * (capacity.vertices * vertex + capacity.quads * quad + window_bits(c) +
                       fifo_bits(c) + parity);
}
