/* SPDX-License-Identifier: Apache-2.0 */
#include "campaign_polygons.h"

#include <string.h>

/* --- To and from half-edges ---------------------------------------------------------------------
 */

static void add_tag(polygons *p, uint32_t v, uint32_t w, uint8_t sharpness) {
    if (sharpness)
        p->tag[p->tags++] = (hs_sharp_tag){.v = v, .w = w, .sharpness = (float)sharpness};
}

bool polygons_of_mesh(polygons *p, const hs_mesh *mesh) {
    *p = (polygons){0};
    if (mesh->vertices > POLYGONS_VERTICES || mesh->faces > POLYGONS_FACES ||
        mesh->halfedges > POLYGONS_CORNERS || mesh->halfedges + mesh->vertices > POLYGONS_TAGS)
        return false;
    p->vertices = mesh->vertices;
    p->faces = mesh->faces;
    p->corners = mesh->halfedges;
    memcpy(p->position, mesh->position, mesh->vertices * sizeof *p->position);
    memcpy(p->corner, mesh->origin, mesh->halfedges * sizeof *p->corner);
    memcpy(p->forced, mesh->forced, mesh->faces);
    for (uint32_t f = 0; f < mesh->faces; f++)
        p->sides[f] = hs_sides(mesh, f);
    for (uint32_t h = 0; mesh->sharpness && h < mesh->halfedges; h++)
        if (mesh->twin[h] == HS_BORDER || h < mesh->twin[h])
            add_tag(p, mesh->origin[h], mesh->origin[hs_next(mesh, h)], mesh->sharpness[h]);
    for (uint32_t v = 0; mesh->vertex_sharpness && v < mesh->vertices; v++)
        add_tag(p, v, v, mesh->vertex_sharpness[v]);
    return true;
}

bool polygons_build(const polygons *p, hs_mesh *mesh, hs_error *err) {
    const hs_soup soup = {.name = "campaign",
                          .vertices = p->vertices,
                          .position = p->position[0],
                          .faces = p->faces,
                          .sides = p->sides,
                          .corner = p->corner,
                          .tags = p->tags,
                          .tag = p->tag};
    if (!hs_mesh_build(mesh, &soup, NULL, err)) return false;
    memcpy(mesh->forced, p->forced, p->faces);
    return true;
}

bool polygons_good(const polygons *p) {
    hs_mesh mesh = {0};
    hs_error err;
    const bool good = p->faces > 0 && polygons_build(p, &mesh, &err);
    hs_mesh_free(&mesh);
    return good;
}

uint32_t polygons_first(const polygons *p, uint32_t face) {
    uint32_t first = 0;
    for (uint32_t f = 0; f < face; f++)
        first += p->sides[f];
    return first;
}

/* --- Changes in the making ----------------------------------------------------------------------
 *
 * A change writes the new list of faces into an empty one, and takes its place if it is good.
 */

static bool add_vertex(polygons *p, const float position[4], uint32_t *number) {
    if (p->vertices == POLYGONS_VERTICES) return false;
    *number = p->vertices;
    memcpy(p->position[p->vertices++], position, sizeof *p->position);
    return true;
}

static bool add_face(polygons *p, const uint32_t *corner, uint32_t sides, uint8_t forced) {
    if (p->faces == POLYGONS_FACES || sides > POLYGONS_CORNERS - p->corners || sides > HS_MAX_SIDES)
        return false;
    memcpy(p->corner + p->corners, corner, sides * sizeof *corner);
    p->corners += sides;
    p->forced[p->faces] = forced;
    p->sides[p->faces++] = sides;
    return true;
}

static bool has_edge(const polygons *p, uint32_t v, uint32_t w) {
    const uint32_t *corner = p->corner;
    for (uint32_t f = 0; f < p->faces; corner += p->sides[f++])
        for (uint32_t i = 0; i < p->sides[f]; i++) {
            const uint32_t a = corner[i], b = corner[(i + 1) % p->sides[f]];
            if ((a == v && b == w) || (a == w && b == v)) return true;
        }
    return false;
}

/* Drops vertices without faces, and tags without edges or vertices. */
static void tidy(polygons *p) {
    uint32_t number[POLYGONS_VERTICES], kept = 0, tags = 0;
    bool used[POLYGONS_VERTICES] = {false};
    for (uint32_t i = 0; i < p->corners; i++)
        used[p->corner[i]] = true;
    for (uint32_t t = 0; t < p->tags; t++) {
        const hs_sharp_tag tag = p->tag[t];
        if (tag.v == tag.w ? used[tag.v] : has_edge(p, tag.v, tag.w)) p->tag[tags++] = tag;
    }
    p->tags = tags;
    for (uint32_t v = 0; v < p->vertices; v++) {
        number[v] = kept;
        if (!used[v]) continue;
        memmove(p->position[kept++], p->position[v], sizeof *p->position);
    }
    p->vertices = kept;
    for (uint32_t i = 0; i < p->corners; i++)
        p->corner[i] = number[p->corner[i]];
    for (uint32_t t = 0; t < p->tags; t++) {
        p->tag[t].v = number[p->tag[t].v];
        p->tag[t].w = number[p->tag[t].w];
    }
}

/* What a change starts from: all but the faces. */
static void begin(polygons *made, const polygons *p) {
    *made = *p;
    made->faces = made->corners = 0;
}

static bool finish(polygons *p, polygons *made, bool fits) {
    if (!fits) return false;
    tidy(made);
    if (!polygons_good(made)) return false;
    *p = *made;
    return true;
}

/* The middle of a face, moved along a rough normal of its first corners. */
static void middle_of(const polygons *p, const uint32_t *corner, uint32_t sides, float height,
                      float middle[4]) {
    float sum[4] = {0}, u[3], w[3];
    for (uint32_t i = 0; i < sides; i++)
        for (int k = 0; k < 4; k++)
            sum[k] += p->position[corner[i]][k] / (float)sides;
    for (int k = 0; k < 3; k++) {
        u[k] = p->position[corner[1]][k] - p->position[corner[0]][k];
        w[k] = p->position[corner[2]][k] - p->position[corner[0]][k];
    }
    for (int k = 0; k < 3; k++)
        middle[k] =
            sum[k] + height * (u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3]);
    middle[3] = sum[3];
}

/* --- What makes a mesh richer -------------------------------------------------------------------
 */

bool polygons_poke(polygons *p, uint32_t face, float height) {
    static polygons made;
    uint32_t tip = 0;
    float middle[4];
    const uint32_t *corner = p->corner;
    begin(&made, p);
    middle_of(p, corner + polygons_first(p, face), p->sides[face], height, middle);
    bool fits = add_vertex(&made, middle, &tip);
    for (uint32_t f = 0; f < p->faces && fits; corner += p->sides[f++]) {
        if (f != face) fits = add_face(&made, corner, p->sides[f], p->forced[f]);
        for (uint32_t i = 0; f == face && fits && i < p->sides[f]; i++) {
            const uint32_t triangle[3] = {corner[i], corner[(i + 1) % p->sides[f]], tip};
            fits = add_face(&made, triangle, 3, p->forced[f]);
        }
    }
    return finish(p, &made, fits);
}

bool polygons_split(polygons *p, uint32_t face, uint32_t i, uint32_t j) {
    static polygons made;
    const uint32_t *corner = p->corner;
    if (i > j || j - i < 2 || j - i + 2 > p->sides[face]) return false;
    begin(&made, p);
    bool fits = true;
    for (uint32_t f = 0; f < p->faces && fits; corner += p->sides[f++]) {
        if (f != face) {
            fits = add_face(&made, corner, p->sides[f], p->forced[f]);
            continue;
        }
        uint32_t rest[HS_MAX_SIDES], sides = 0;
        for (uint32_t k = 0; k < p->sides[f]; k++)
            if (k <= i || k >= j) rest[sides++] = corner[k];
        fits = add_face(&made, rest, sides, p->forced[f]) &&
               add_face(&made, corner + i, j - i + 1, p->forced[f]);
    }
    return finish(p, &made, fits);
}

bool polygons_merge(polygons *p, uint32_t face, uint32_t side) {
    static polygons made;
    const uint32_t *mine = p->corner + polygons_first(p, face), *corner = p->corner;
    const uint32_t sides = p->sides[face], v = mine[side], w = mine[(side + 1) % sides];
    uint32_t other = p->faces, at = 0;
    for (uint32_t f = 0; f < p->faces; corner += p->sides[f++])
        for (uint32_t i = 0; i < p->sides[f]; i++)
            if (corner[i] == w && corner[(i + 1) % p->sides[f]] == v) {
                other = f;
                at = i;
            }
    if (other == p->faces || other == face) return false;
    /* From w around this face to v, then around the other one from behind v to before w. */
    uint32_t merged[2 * HS_MAX_SIDES], count = 0;
    const uint32_t *theirs = p->corner + polygons_first(p, other), more = p->sides[other];
    for (uint32_t i = 1; i <= sides; i++)
        merged[count++] = mine[(side + i) % sides];
    for (uint32_t i = 2; i < more; i++)
        merged[count++] = theirs[(at + i) % more];
    begin(&made, p);
    bool fits = true;
    corner = p->corner;
    for (uint32_t f = 0; f < p->faces && fits; corner += p->sides[f++]) {
        if (f == face)
            fits = add_face(&made, merged, count, p->forced[f]);
        else if (f != other)
            fits = add_face(&made, corner, p->sides[f], p->forced[f]);
    }
    return finish(p, &made, fits);
}

bool polygons_cut_edge(polygons *p, uint32_t face, uint32_t side) {
    static polygons made;
    const uint32_t *mine = p->corner + polygons_first(p, face), *corner = p->corner;
    const uint32_t v = mine[side], w = mine[(side + 1) % p->sides[face]];
    uint32_t cut = 0;
    float middle[4];
    for (int k = 0; k < 4; k++)
        middle[k] = (p->position[v][k] + p->position[w][k]) / 2;
    begin(&made, p);
    bool fits = add_vertex(&made, middle, &cut);
    for (uint32_t f = 0; f < p->faces && fits; corner += p->sides[f++]) {
        uint32_t longer[2 * HS_MAX_SIDES], count = 0;
        for (uint32_t i = 0; i < p->sides[f]; i++) {
            const uint32_t a = corner[i], b = corner[(i + 1) % p->sides[f]];
            longer[count++] = a;
            if ((a == v && b == w) || (a == w && b == v)) longer[count++] = cut;
        }
        fits = add_face(&made, longer, count, p->forced[f]);
    }
    return finish(p, &made, fits);
}

bool polygons_extrude(polygons *p, uint32_t face, float height) {
    static polygons made;
    const uint32_t *mine = p->corner + polygons_first(p, face), *corner = p->corner;
    const uint32_t sides = p->sides[face];
    uint32_t lid[HS_MAX_SIDES];
    float low[4], high[4];
    middle_of(p, mine, sides, 0, low);
    middle_of(p, mine, sides, height, high);
    begin(&made, p);
    bool fits = true;
    for (uint32_t i = 0; i < sides && fits; i++) {
        float position[4];
        for (int k = 0; k < 4; k++)
            position[k] = p->position[mine[i]][k] + high[k] - low[k];
        fits = add_vertex(&made, position, &lid[i]);
    }
    for (uint32_t f = 0; f < p->faces && fits; corner += p->sides[f++]) {
        fits = add_face(&made, f == face ? lid : corner, p->sides[f], p->forced[f]);
        for (uint32_t i = 0; f == face && fits && i < sides; i++) {
            const uint32_t j = (i + 1) % sides, wall[4] = {mine[i], mine[j], lid[j], lid[i]};
            fits = add_face(&made, wall, 4, p->forced[f]);
        }
    }
    return finish(p, &made, fits);
}

bool polygons_append(polygons *p, const polygons *other, const float offset[3]) {
    static polygons made;
    made = *p;
    if (p->vertices + other->vertices > POLYGONS_VERTICES || p->tags + other->tags > POLYGONS_TAGS)
        return false;
    for (uint32_t v = 0; v < other->vertices; v++, made.vertices++)
        for (int k = 0; k < 4; k++)
            made.position[made.vertices][k] = other->position[v][k] + (k < 3 ? offset[k] : 0);
    for (uint32_t t = 0; t < other->tags; t++) {
        hs_sharp_tag tag = other->tag[t];
        tag.v += p->vertices;
        tag.w += p->vertices;
        made.tag[made.tags++] = tag;
    }
    const uint32_t *corner = other->corner;
    bool fits = true;
    for (uint32_t f = 0; f < other->faces && fits; corner += other->sides[f++]) {
        uint32_t moved[HS_MAX_SIDES];
        for (uint32_t i = 0; i < other->sides[f]; i++)
            moved[i] = corner[i] + p->vertices;
        fits = add_face(&made, moved, other->sides[f], other->forced[f]);
    }
    return finish(p, &made, fits);
}

/* --- What makes it smaller -----------------------------------------------------------------------
 */

bool polygons_keep(polygons *p, const bool *keep) {
    static polygons made;
    const uint32_t *corner = p->corner;
    begin(&made, p);
    for (uint32_t f = 0; f < p->faces; corner += p->sides[f++])
        if (keep[f]) add_face(&made, corner, p->sides[f], p->forced[f]);
    return made.faces < p->faces && finish(p, &made, true);
}

/* Writes the faces anew, each vertex v as to[v]; what then stands twice in a row, or is dropped
 * (UINT32_MAX), is left out, and so is a face of fewer than three. */
static bool rename_vertices(polygons *p, const uint32_t *to) {
    static polygons made;
    const uint32_t *corner = p->corner;
    begin(&made, p);
    for (uint32_t f = 0; f < p->faces; corner += p->sides[f++]) {
        uint32_t left[HS_MAX_SIDES], count = 0;
        for (uint32_t i = 0; i < p->sides[f]; i++) {
            const uint32_t v = to[corner[i]];
            if (v != UINT32_MAX && (count == 0 || left[count - 1] != v)) left[count++] = v;
        }
        while (count > 1 && left[count - 1] == left[0])
            count--;
        if (count >= HS_MIN_SIDES) add_face(&made, left, count, p->forced[f]);
    }
    return finish(p, &made, true);
}

bool polygons_drop_vertices(polygons *p, uint32_t first, uint32_t count) {
    uint32_t to[POLYGONS_VERTICES];
    for (uint32_t i = 0; i < p->vertices; i++)
        to[i] = i >= first && i - first < count ? UINT32_MAX : i;
    return rename_vertices(p, to);
}

bool polygons_collapse(polygons *p, uint32_t v, uint32_t w) {
    uint32_t to[POLYGONS_VERTICES];
    for (uint32_t i = 0; i < p->vertices; i++)
        to[i] = i == v ? w : i;
    return rename_vertices(p, to);
}
