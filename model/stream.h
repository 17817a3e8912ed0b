/* SPDX-License-Identifier: Apache-2.0
 *
 * The words that go into and come out of the pipeline. docs/stream.md defines every bit; this file
 * and definitions.def are its C. A packet is what one AXI4-Stream packet (up to TLAST) carries: a
 * row of records of four 32-bit words each, for one view.
 */
#ifndef HS_STREAM_H
#define HS_STREAM_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "definitions.h"
#include "error.h"
#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_packet {
    uint32_t view;   /* TID of its beats, 16 bits */
    size_t words;    /* a multiple of 4 */
    size_t capacity; /* words allocated; word is owned by the packet, from malloc */
    uint32_t *word;
} hs_packet;

/* What happens at the surface's boundary (docs/refinement.md, section 9). */
typedef enum hs_boundary {
    HS_BOUNDARY_KEPT,     /* the paper: boundary edges are kept, their vertices stay */
    HS_BOUNDARY_SMOOTH,   /* B-spline curves; a vertex with one face stays */
    HS_BOUNDARY_EDGE_ONLY /* B-spline curves everywhere */
} hs_boundary;

/* How a view is refined: the settings in the header of an input packet. */
typedef struct hs_settings {
    uint8_t front_depth;      /* front faces in view are refined while g < this */
    uint8_t silhouette_depth; /* faces at silhouette vertices, likewise */
    uint8_t uniform_depth;    /* if uniform: everything is refined while g < this */
    bool uniform;
    bool guard; /* refine the ring around every selected face as well */
    bool limit; /* vertices leave at their positions on the limit surface */
    hs_boundary boundary;
    /* Not wanted is a face whose edges are all shorter than this, in sixteenths of a pixel
     * (HS_PIXEL_FRACTION), in a picture of width x height pixels; 0: every face may be. */
    uint16_t min_edge, width, height;
} hs_settings;

/* Makes the input packet of one view: header, matrix (row-major, clip = M p), vertices, corners,
 * trailer. Replaces what *packet held. False only when memory is exhausted. */
bool hs_packet_encode(hs_packet *packet, uint32_t view, const hs_mesh *mesh, const float matrix[16],
                      const hs_settings *settings, hs_error *err);

/* Appends records (4 * records words, not the packet's own) to a packet; its memory at least
 * doubles when it grows. False only when memory is exhausted. */
bool hs_packet_append(hs_packet *packet, const uint32_t *record, size_t records, hs_error *err);

/* Frees the words and empties *packet. */
void hs_packet_free(hs_packet *packet);

/* CRC-32 (IEEE 802.3, as zlib's) of words in little-endian order, going on from crc (0 to start).
 */
uint32_t hs_crc(uint32_t crc, const uint32_t *word, size_t words);

/* CRC-32 of all words of a packet but the last, which in a whole packet holds it. With its own CRC
 * behind it, every packet has the same one. 0 without words. */
uint32_t hs_packet_crc(const hs_packet *packet);

/* Word 0 of an output record that is not a vertex. detail is bits 19:0. */
static inline uint32_t hs_tag(uint32_t kind, uint32_t detail) {
    return (uint32_t)HS_TAG << 23 | kind << 20 | detail;
}

/* Index of the first word of the first record of a kind, not a vertex, in an output packet;
 * SIZE_MAX if there is none. */
size_t hs_packet_find(const hs_packet *packet, uint32_t kind);

/* One output packet, decoded. Vertex numbers in the stream are the pipeline's own; here faces
 * name vertices by their place in the output, as mesh files do. */
typedef struct hs_output {
    uint32_t view, status, error_position;
    int32_t exponent;     /* E: all components are below 2^E */
    uint32_t generations; /* the last generation reached */
    uint32_t vertices, faces, triangles, corners;
    uint32_t at_level;   /* with settings.limit: vertices sent where their level has them */
    float *position;     /* 4 per vertex: clip space */
    uint32_t *number;    /* per vertex: its number in the pipeline */
    uint32_t *first;     /* faces + 1: where a face's corners begin */
    uint32_t *corner;    /* places of vertices in the output */
    uint8_t *generation; /* per face: the generation in which it became final */
    uint8_t *candidate;  /* per face: its candidate bit, 0 or 1 */
} hs_output;

/* Decodes and checks an output packet: record order, numbers, counts, CRC. On failure *output is
 * empty and *err gives the word (HS_EXIT_STREAM). A view with an error status decodes: it has no
 * vertices and no faces. So does one that met a memory's fault (HS_STATUS_MEMORY_FAULT): what its
 * packet holds before the trailer is not looked at. */
bool hs_output_decode(hs_output *output, const hs_packet *packet, hs_error *err);
/* Whether the pipeline took the view: its status is OK or STOPPED. Otherwise *err says why not
 * (HS_EXIT_REFUSED). */
bool hs_output_accepted(const hs_output *output, hs_error *err);
void hs_output_free(hs_output *output);

/* What a word of an output packet is, for messages: "face 12 of generation 3, vertices 1 and 2"
 * (faces count from 0 in the order of the output; the 1st and 2nd of the face's vertices) or
 * "position of vertex 51 (z)" (its number in the pipeline). Never fails, whatever the words are;
 * size is of text. Time O(word). */
void hs_output_describe(const hs_packet *packet, size_t word, char *text, size_t size);

/* A stream file holds packets, each behind a frame record: the bytes HS2F, the view, the number of
 * words that follow, and zero; all little-endian. Reads the packet at *offset (bytes) of a file in
 * memory and moves *offset behind it; the file is at its end when *offset == size. Replaces what
 * *packet held. name is the file's, for messages. On failure *packet has no words, *offset stays
 * and *err names the byte (HS_EXIT_STREAM). */
enum { HS_MAGIC_FRAME = 0x46325348 }; /* the bytes HS2F */
bool hs_frame_read(hs_packet *packet, const uint8_t *bytes, size_t size, size_t *offset,
                   const char *name, hs_error *err);

/* Writes a packet behind its frame record; what hs_frame_read reads. False with HS_EXIT_STREAM if
 * the packet has no words, words that are no whole records, or a view beyond 16 bits, with
 * HS_EXIT_FILE if the file takes no more. */
bool hs_frame_write(FILE *file, const hs_packet *packet, const char *name, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
