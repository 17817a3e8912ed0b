/* SPDX-License-Identifier: Apache-2.0
 *
 * The arithmetic of golden: binary32 at both ends, exact integers between them. Every result is one
 * exact number, rounded once, to nearest, ties to even (RNE). docs/arithmetic.md gives the widths
 * and why nothing overflows. The build forbids contraction.
 */
#ifndef HS_ARITHMETIC_H
#define HS_ARITHMETIC_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* --- From binary32 to a block and back -------------------------------------------------------- */

/* A row of the matrix times a vertex, every operation rounded, subnormals included. Infinite or NaN
 * if one of them overflows. */
static inline float hs_row_times(const float m[4], const float p[4]) {
    return (m[0] * p[0] + m[1] * p[1]) + (m[2] * p[2] + m[3] * p[3]);
}

/* E of a block with this largest magnitude: the smallest integer with magnitude < 2^E, -148 to 128;
 * 0 if it is 0. frexp gives c = m 2^e with m in [1/2, 1), subnormals included. */
static inline int32_t hs_block_exponent(float magnitude) {
    int e = 0;
    if (magnitude > 0) frexpf(magnitude, &e);
    return e;
}

/* q = RNE(c 2^(30-E)), |c| < 2^E. Exact: scaling a float by a power of two in double loses nothing,
 * and lrint rounds as RNE does in the default rounding mode. */
static inline int32_t hs_to_fixed(float c, int32_t exponent) {
    return (int32_t)lrint(ldexp((double)c, 30 - exponent));
}

/* What a position of 1 is worth: 2^(E-30), E from -148 to 128. */
static inline double hs_unit(int32_t exponent) {
    return ldexp(1, exponent - 30);
}

/* q 2^(E-30), rounded once, from hs_unit(E). 32 bits fit a double, and 2^(E-30) is a normal one:
 * the product is exact, and the conversion rounds. */
static inline float hs_to_float(int32_t q, double unit) {
    return (float)((double)q * unit);
}

/* --- The masks -------------------------------------------------------------------------------- */

/* RNE(x / 2^s), s from 1 to 62, |x| < 2^62. Adding half a unit less one, and one more where the
 * quotient would be odd, makes the floor of the shift round as RNE does, negative x included. */
static inline int64_t hs_rne_shift(int64_t x, int s) {
    return (x + ((int64_t)1 << (s - 1)) - 1 + ((x >> s) & 1)) >> s;
}

/* RNE(x / d), d from 1 to 2^31, |x| < 2^62. */
static inline int64_t hs_rne_divide(int64_t x, int64_t d) {
    int64_t q = x / d, r = x % d; /* towards zero */
    int64_t twice = 2 * (r < 0 ? -r : r);
    if (twice > d || (twice == d && (q & 1))) q += x < 0 ? -1 : 1;
    return q;
}

/* Four coordinates at once, x, y, z, w, and their sums: vectors, as GCC and clang have them. */
typedef int32_t hs_int4 __attribute__((vector_size(16)));
typedef int64_t hs_long4 __attribute__((vector_size(32)));

static inline hs_int4 hs_load(const int32_t p[4]) {
    hs_int4 v;
    memcpy(&v, p, sizeof v);
    return v;
}

/* Face point of one coordinate: RNE(sum / n), |sum| <= n 2^30. */
static inline int32_t hs_face_mask(int64_t sum, uint32_t n) {
    return (int32_t)(n == 4 ? hs_rne_shift(sum, 2) : hs_rne_divide(sum, n));
}

/* Face point of a quad, RNE((a + b + c + d) / 4), in 32 bits: with p = 4 (p >> 2) + (p & 3) the sum
 * is 4 q + r, r from 0 to 12, and |q| <= 2^30 + 4. Then as hs_rne_shift. */
static inline hs_int4 hs_quad_mask(hs_int4 a, hs_int4 b, hs_int4 c, hs_int4 d) {
    const hs_int4 q = (a >> 2) + (b >> 2) + (c >> 2) + (d >> 2);
    const hs_int4 r = (a & 3) + (b & 3) + (c & 3) + (d & 3);
    return q + ((r + 1 + ((q + (r >> 2)) & 1)) >> 2);
}

/* Vertex point of one coordinate: RNE((t + n(n-2) s) / n^2), where t sums w + F over the n
 * half-edges v -> w around the vertex: the paper's formula (1), multiplied out. */
static inline int32_t hs_vertex_mask(int64_t t, int32_t s, uint32_t n) {
    if (n == 4) return (int32_t)hs_rne_shift(t + 8 * (int64_t)s, 4);
    int64_t m = n;
    return (int32_t)hs_rne_divide(t + m * (m - 2) * s, m * m);
}

/* Crease point of one coordinate: RNE((a + 6s + b) / 8), ends = a + b. */
static inline int32_t hs_crease_mask(int64_t ends, int32_t s) {
    return (int32_t)hs_rne_shift(ends + 6 * (int64_t)s, 3);
}

/* Midpoint of one coordinate: RNE((a + b) / 2). */
static inline int32_t hs_middle_mask(int32_t a, int32_t b) {
    return (int32_t)hs_rne_shift((int64_t)a + b, 1);
}

/* Limit position of one coordinate: RNE((n^2 s + ring) / (n^2 + 5n)), where ring sums 4a + b over
 * the n corners at the vertex: a the other end of an edge, b the vertex opposite in a quad. */
static inline int32_t hs_limit_mask(int64_t ring, int32_t s, uint32_t n) {
    const int64_t m = n;
    return (int32_t)hs_rne_divide(m * m * s + ring, m * m + 5 * m);
}

/* Limit position on a crease: RNE((a + 4s + b) / 6), ends = a + b. */
static inline int32_t hs_crease_limit_mask(int64_t ends, int32_t s) {
    return (int32_t)hs_rne_divide(ends + 4 * (int64_t)s, 6);
}

/* --- Comparisons ------------------------------------------------------------------------------ */

/* True if p and q are before the eye and |p/p_w - q/q_w| size/2 < edge/16 pixels in a picture of
 * that size, where p, q are one coordinate of the two: |p q_w - q p_w| 8 size < edge p_w q_w. The
 * left side is below 2^61 2^19, the right one below 2^76. */
static inline int hs_is_short(int32_t p, int32_t p_w, int32_t q, int32_t q_w, uint32_t size,
                              uint32_t edge) {
    if (p_w <= 0 || q_w <= 0) return 0;
    const int64_t cross = (int64_t)p * q_w - (int64_t)q * p_w;
    return (__int128)(cross < 0 ? -cross : cross) * 8 * size <
           (__int128)edge * ((int64_t)p_w * q_w);
}

/* det[(x,y,w) of a, b, c] = a . (b x c), exactly: above zero where the corner a, b, c is seen
 * counter-clockwise. Positions are x, y, z, w with |component| <= 2^30, so a component of b x c
 * needs 63 bits and the determinant 94. */
typedef struct hs_cross {
    int64_t x, y, w;
} hs_cross;

static inline hs_cross hs_cross_of(const int32_t b[4], const int32_t c[4]) {
    return (hs_cross){(int64_t)b[1] * c[3] - (int64_t)b[3] * c[1],
                      (int64_t)b[3] * c[0] - (int64_t)b[0] * c[3],
                      (int64_t)b[0] * c[1] - (int64_t)b[1] * c[0]};
}

static inline int hs_corner_front(const int32_t a[4], hs_cross c) {
    return (__int128)a[0] * c.x + (__int128)a[1] * c.y + (__int128)a[3] * c.w > 0;
}

#endif
