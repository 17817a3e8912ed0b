// SPDX-License-Identifier: Apache-2.0
#include "memories.h"

#include "Vhalfstep.h"
#include "Vhalfstep___024root.h"

namespace {

template <class Word> void flip(Word &word, uint32_t bit) {
    word = static_cast<Word>(word ^ Word{1} << bit);
}
template <std::size_t Words> void flip(VlWide<Words> &word, uint32_t bit) {
    word[bit / 32] ^= 1U << bit % 32;
}

struct entry {
    hs_memory memory;
    void (*flip)(Vhalfstep___024root &root, uint32_t row, uint32_t bit);
    const void *(*words)(Vhalfstep___024root &root);
    uint32_t bytes;
};

#define MEMORY(member, path, width, depth)                                                         \
    {{path, width, depth},                                                                         \
     [](Vhalfstep___024root &root, uint32_t row, uint32_t bit) { flip(root.member[row], bit); },   \
     [](Vhalfstep___024root &root) -> const void * { return &root.member[0]; },                    \
     sizeof Vhalfstep___024root::member / depth},
const entry entries[] = {
#include "memories.inc"
};

} // namespace

uint32_t hs_memory_count() {
    return sizeof entries / sizeof entries[0];
}

hs_memory hs_memory_at(uint32_t memory) {
    return entries[memory].memory;
}

void hs_memory_flip(void *top, uint32_t memory, uint32_t row, uint32_t bit) {
    entries[memory].flip(*static_cast<Vhalfstep *>(top)->rootp, row, bit);
}

const void *hs_memory_words(void *top, uint32_t memory, uint32_t *bytes) {
    *bytes = entries[memory].bytes;
    return entries[memory].words(*static_cast<Vhalfstep *>(top)->rootp);
}
