/* SPDX-License-Identifier: Apache-2.0 */
#include "report_mesh.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "decimate.h"
#include "file.h"
#include "json_file.h"
#include "render.h"
#include "report_pack.h"
#include "stream.h"

/* --- Packets ------------------------------------------------------------------------------------
 */

enum { MOST_BYTES = 1 << 30 };

/* The first packet of a file of the view's folder. */
static bool read_packet(hs_packet *packet, const char *folder, const char *name, hs_error *err) {
    char path[PATH_MAX];
    const int length = snprintf(path, sizeof path, "%s/%s", folder, name);
    if (length < 0 || (size_t)length >= sizeof path)
        return hs_fail(err, HS_EXIT_FILE, "%.300s...: its name is too long", folder);
    uint8_t *bytes;
    size_t size, offset = 0;
    if (!hs_file_read(path, MOST_BYTES, &bytes, &size, err)) return false;
    const bool good = size ? hs_frame_read(packet, bytes, size, &offset, path, err)
                           : hs_fail(err, HS_EXIT_STREAM, "%.300s: an empty file", path);
    free(bytes);
    return good;
}

static uint32_t lesser(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

/* The depths in word 6 of the header, and word 2 of each half-edge (docs/stream.md), cut to a
 * step; golden has accepted the packet that they come from. */
static void cut_depths(hs_packet *packet, const hs_packet *whole, uint32_t step) {
    memcpy(packet->word, whole->word, whole->words * sizeof *whole->word);
    uint32_t *w = packet->word;
    w[6] = lesser(w[6] & 0xff, step) | lesser(w[6] >> 8 & 0xff, step) << 8 |
           lesser(w[6] >> 16 & 0xff, step) << 16;
    uint32_t *halfedge = w + 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS + (size_t)w[3]);
    for (size_t h = 0; h < w[5]; h++) {
        uint32_t *face = &halfedge[4 * h + 2];
        *face = (*face & ~0xff00u) | lesser(*face >> 8 & 0xff, step) << 8;
    }
    w[packet->words - 1] = hs_packet_crc(packet);
}

/* Steps that were taken. */
static uint32_t steps_taken(const hs_golden_report *report) {
    uint32_t steps = 0;
    for (uint32_t g = 0; g < report->generations; g++)
        if (report->generation[g].refined) steps = g + 1;
    return steps;
}

/* The generation of the faces that the last step makes and sends; HS_MAX_DEPTH + 1: there is no
 * such step, as vertices are sent where the limit surface has them. */
static uint32_t last_generation(const hs_packet *in) {
    const uint32_t *w = in->word;
    if (w[2] & HS_FLAG_LIMIT) return HS_MAX_DEPTH + 1;
    if (w[2] & HS_FLAG_UNIFORM) return w[6] >> 16 & 0xff;
    const uint32_t front = w[6] & 0xff, silhouette = w[6] >> 8 & 0xff;
    uint32_t most = front > silhouette ? front : silhouette;
    const uint32_t *halfedge = w + 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS + (size_t)w[3]);
    for (size_t h = 0; h < w[5]; h++) {
        const uint32_t forced = halfedge[4 * h + 2] >> 8 & 0xff;
        if (forced > most) most = forced;
    }
    return most;
}

/* --- Faces --------------------------------------------------------------------------------------
 */

/* Steps that a vertex has seen, from its number: those of the mesh come first, then those that the
 * first step makes, and so on. born: vertices at each generation's start. */
static uint32_t steps_seen(const uint32_t *born, uint32_t generations, uint32_t number) {
    uint32_t g = 0;
    while (g < generations && number >= born[g])
        g++;
    return g;
}

typedef struct shown {
    hs_output output;
    hs_surface surface;
    hs_decimated fewer;
    uint8_t *depth; /* per face of the output */
    uint32_t last;  /* last_generation */
} shown;

static void free_shown(shown *s) {
    hs_output_free(&s->output);
    hs_surface_free(&s->surface);
    hs_decimated_free(&s->fewer);
    free(s->depth);
    *s = (shown){0};
}

static bool find_depths(shown *s, const hs_golden_report *report, hs_error *err) {
    const hs_output *o = &s->output;
    uint32_t born[HS_MAX_DEPTH + 2];
    const uint32_t generations = lesser(report->generations, HS_MAX_DEPTH + 2);
    for (uint32_t g = 0; g < generations; g++)
        born[g] = report->generation[g].vertices;
    s->depth = calloc((size_t)o->faces + 1, 1);
    if (!s->depth) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for %u faces", o->faces);
    for (uint32_t f = 0; f < o->faces; f++)
        for (uint32_t i = o->first[f]; i < o->first[f + 1]; i++) {
            const uint32_t seen = steps_seen(born, generations, o->number[o->corner[i]]);
            if (seen > s->depth[f]) s->depth[f] = (uint8_t)lesser(seen, 255);
        }
    return true;
}

/* A triangle that a step cuts off has the new vertex of the face that was refined, and the
 * generation of that face. */
static enum hs_face_end end_of(const shown *s, uint32_t face) {
    const uint32_t generation = s->output.generation[face];
    if (s->depth[face] > generation) return HS_END_CUT;
    return generation > 0 && generation == s->last ? HS_END_LAST_STEP : HS_END_WHOLE;
}

/* --- JSON ---------------------------------------------------------------------------------------
 */

static void widen(double box[6], const hs_surface *s) {
    for (size_t i = 0; i < 3 * (size_t)s->vertices; i++) {
        const size_t k = i % 3;
        if (s->object[i] < box[k]) box[k] = s->object[i];
        if (s->object[i] > box[3 + k]) box[3 + k] = s->object[i];
    }
}

enum { PLACES = 16383 };

static int32_t place_in(const double box[6], size_t axis, double at) {
    const double side = box[3 + axis] - box[axis];
    return side > 0 ? (int32_t)lround(fmin(fmax((at - box[axis]) / side, 0), 1) * PLACES) : 0;
}

/* A face, and where it is along a curve that fills space: what is near is near in the order. */
typedef struct near_face {
    uint64_t key;
    uint32_t face;
} near_face;

static int by_key(const void *a, const void *b) {
    const near_face *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    return p->face < q->face ? -1 : 1;
}

/* The bits of its first corner's places, in turn from each axis. */
static uint64_t key_of(const hs_decimated *d, const double box[6], uint32_t face) {
    const double *at = &d->position[3 * (size_t)d->corner[d->first[face]]];
    uint64_t key = 0;
    for (size_t axis = 0; axis < 3; axis++)
        for (uint64_t bit = 0, place = (uint64_t)place_in(box, axis, at[axis]); place >> bit; bit++)
            key |= (place >> bit & 1) << (3 * bit + axis);
    return key;
}

/* Faces in their order near each other, and vertices in the order in which these use them. */
typedef struct order {
    near_face *face;
    uint32_t *vertex; /* used: which one each is */
    uint32_t *place;  /* per vertex: its place among them, or UINT32_MAX */
    uint32_t used;
} order;

static bool put_in_order(order *o, const hs_decimated *d, const double box[6]) {
    o->face = malloc(((size_t)d->faces + 1) * sizeof *o->face);
    o->vertex = malloc(((size_t)d->vertices + 1) * sizeof *o->vertex);
    o->place = malloc(((size_t)d->vertices + 1) * sizeof *o->place);
    if (!o->face || !o->vertex || !o->place) return false;
    memset(o->place, 0xff, d->vertices * sizeof *o->place);
    for (uint32_t f = 0; f < d->faces; f++)
        o->face[f] = (near_face){key_of(d, box, f), f};
    qsort(o->face, d->faces, sizeof *o->face, by_key);
    for (uint32_t i = 0; i < d->faces; i++)
        for (uint32_t c = d->first[o->face[i].face]; c < d->first[o->face[i].face + 1]; c++) {
            uint32_t *place = &o->place[d->corner[c]];
            if (*place != UINT32_MAX) continue;
            *place = o->used;
            o->vertex[o->used++] = d->corner[c];
        }
    return true;
}

static void pack_positions(hs_bytes *b, const shown *s, const order *o, const double box[6]) {
    for (size_t axis = 0; axis < 3; axis++)
        for (uint32_t v = 0, before = 0; v < o->used; v++) {
            const double at = s->fewer.position[3 * (size_t)o->vertex[v] + axis];
            const uint32_t place = (uint32_t)place_in(box, axis, at);
            hs_bytes_difference(b, (int32_t)(place - before));
            before = place;
        }
}

static void pack_faces(hs_bytes *b, const shown *s, const order *o) {
    const hs_decimated *d = &s->fewer;
    for (uint32_t i = 0; i < d->faces; i++) {
        const uint32_t f = o->face[i].face;
        hs_bytes_add(b, (uint8_t)(d->first[f + 1] - d->first[f]));
    }
    for (uint32_t i = 0; i < d->faces; i++)
        hs_bytes_add(b, s->output.generation[d->source[o->face[i].face]]);
    for (uint32_t i = 0; i < d->faces; i++)
        hs_bytes_add(b, s->depth[d->source[o->face[i].face]]);
    for (uint32_t i = 0; i < d->faces; i++) {
        const uint32_t source = d->source[o->face[i].face];
        hs_bytes_add(b, (uint8_t)(s->surface.facing[source] | end_of(s, source) << 2));
    }
}

static void pack_corners(hs_bytes *b, const hs_decimated *d, const order *o) {
    uint32_t used = 0;
    for (uint32_t i = 0; i < d->faces; i++)
        for (uint32_t c = d->first[o->face[i].face]; c < d->first[o->face[i].face + 1]; c++) {
            const uint32_t place = o->place[d->corner[c]];
            hs_bytes_number(b, used - place);
            used += place == used;
        }
}

static json_t *pack(const shown *s, const double box[6]) {
    order o = {0};
    hs_bytes b = {0};
    json_t *json = NULL;
    if (put_in_order(&o, &s->fewer, box)) {
        hs_bytes_number(&b, o.used);
        hs_bytes_number(&b, s->fewer.faces);
        pack_positions(&b, s, &o, box);
        pack_faces(&b, s, &o);
        pack_corners(&b, &s->fewer, &o);
        json = hs_bytes_json(&b);
    }
    hs_bytes_free(&b);
    free(o.face);
    free(o.vertex);
    free(o.place);
    return json;
}

static json_t *step_of(const shown *s, const double box[6], uint32_t step) {
    return json_pack("{s:i, s:I, s:I, s:I, s:o}", "step", (int)step, "faces",
                     (json_int_t)s->output.faces, "vertices", (json_int_t)s->output.vertices,
                     "stored", (json_int_t)s->fewer.faces, "data", pack(s, box));
}

/* --- A view -------------------------------------------------------------------------------------
 */

typedef struct work {
    const hs_report_mesh_request *request;
    hs_packet in, out, cut;
    hs_golden_report report;
    uint32_t steps;
    shown *step; /* steps + 1 */
    float matrix[16];
    char *why; /* there is no mesh */
    size_t size;
} work;

static bool say(work *w, const char *text) {
    snprintf(w->why, w->size, "%s", text);
    return false;
}

/* An error that is a reason for not showing a mesh. */
static bool explain(work *w, hs_error *err) {
    if (err->code == HS_EXIT_INTERNAL) return false;
    say(w, err->text);
    *err = (hs_error){0};
    return false;
}

static bool refine(work *w, const hs_packet *in, hs_error *err) {
    if (!hs_golden_run(w->request->golden, in, &w->out, &w->report, err)) return false;
    if (w->report.status <= HS_STATUS_STOPPED) return true;
    char text[300];
    snprintf(text, sizeof text, "the view was refused, %s: %s", hs_status_name(w->report.status),
             hs_status_what(w->report.status));
    return say(w, text);
}

static bool is_finite(const hs_surface *s) {
    for (size_t i = 0; i < 3 * (size_t)s->vertices; i++)
        if (!isfinite(s->object[i])) return false;
    return true;
}

static bool show(work *w, shown *s, const hs_packet *out, hs_error *err) {
    if (!hs_output_decode(&s->output, out, err)) return explain(w, err);
    if (!find_depths(s, &w->report, err) ||
        !hs_surface_of_output(&s->surface, &s->output, w->matrix, err))
        return false;
    if (!s->surface.object || !is_finite(&s->surface))
        return say(w, "the view's matrix is singular: where its vertices are is not known");
    return hs_decimate(&s->fewer, s->surface.vertices, s->surface.object, s->surface.faces,
                       s->surface.first, s->surface.corner, w->request->most, err);
}

/* What came out, and then the steps before it, from the last to the first. */
static bool work_on(work *w, hs_error *err) {
    const char *folder = w->request->folder;
    hs_packet sent = {0};
    bool good = read_packet(&w->in, folder, "input.hss", err) &&
                read_packet(&sent, folder, "output.hss", err);
    if (!good) explain(w, err);
    good = good && refine(w, &w->in, err);
    if (good) {
        w->steps = steps_taken(&w->report);
        memcpy(w->matrix, w->in.word + 4 * HS_HEADER_RECORDS, sizeof w->matrix);
        w->step = calloc((size_t)w->steps + 1, sizeof *w->step);
        good = w->step || hs_fail(err, HS_EXIT_INTERNAL, "no memory for the meshes of %s", folder);
    }
    if (good) w->step[w->steps].last = last_generation(&w->in);
    good = good && show(w, &w->step[w->steps], &sent, err);
    hs_packet_free(&sent);
    if (good && w->step[w->steps].output.faces == 0)
        return say(w, "no faces came out of the pipeline");
    w->cut = (hs_packet){.view = w->in.view, .words = w->in.words, .capacity = w->in.words};
    if (good) w->cut.word = malloc(w->in.words * sizeof *w->cut.word);
    if (good && !w->cut.word)
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the packet of %s", folder);
    for (uint32_t step = w->steps; good && step-- > 0;) {
        cut_depths(&w->cut, &w->in, step);
        w->step[step].last = last_generation(&w->cut);
        good = refine(w, &w->cut, err) && show(w, &w->step[step], &w->out, err);
    }
    return good;
}

static json_t *object_of(const work *w) {
    double box[6] = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (uint32_t k = 0; k <= w->steps; k++)
        widen(box, &w->step[k].surface);
    json_t *steps = json_array(), *matrix = json_array(), *edges = json_array();
    bool good = true;
    for (uint32_t k = 0; k <= w->steps; k++)
        hs_json_append(steps, step_of(&w->step[k], box, k), &good);
    for (int i = 0; i < 16; i++)
        hs_json_append(matrix, json_real((double)w->matrix[i]), &good);
    for (int i = 0; i < 6; i++)
        hs_json_append(edges, json_real(box[i]), &good);
    json_t *object = json_pack("{s:o, s:o, s:o}", "box", edges, "matrix", matrix, "steps", steps);
    if (good) return object;
    json_decref(object);
    return NULL;
}

json_t *hs_report_mesh(const hs_report_mesh_request *request, char *why, size_t size,
                       hs_error *err) {
    work w = {.request = request, .why = why, .size = size};
    why[0] = 0;
    json_t *object = NULL;
    if (work_on(&w, err)) {
        object = object_of(&w);
        if (!object)
            hs_fail(err, HS_EXIT_INTERNAL, "no memory for the meshes of %.300s", request->folder);
    }
    for (uint32_t k = 0; w.step && k <= w.steps; k++)
        free_shown(&w.step[k]);
    free(w.step);
    hs_packet_free(&w.in);
    hs_packet_free(&w.out);
    hs_packet_free(&w.cut);
    return object;
}
