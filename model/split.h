/* SPDX-License-Identifier: Apache-2.0
 *
 * What the two files of split share: how final faces leave.
 */
#ifndef HS_SPLIT_H
#define HS_SPLIT_H

#include "golden_state.h"

/* The quad of h's edge, when it is final at once; h, behind which comes next, is a half-edge of f.
 */
void hs_send_quad(hs_state *s, uint32_t f, uint32_t h, uint32_t next);

/* The triangle at the kept edge of h, behind f's new vertex if that was not sent before. */
void hs_send_triangle(hs_state *s, uint32_t f, uint32_t h, uint32_t next);

/* A face that is not refined. */
void hs_send_face(hs_state *s, uint32_t f);

#endif
