/* SPDX-License-Identifier: Apache-2.0 */
#include "osd.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <vector>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

/* What OpenSubdiv interpolates: anything with Clear and AddWithWeight. */
template <typename Real> struct Position {
    Real x[4];
    void Clear() {
        x[0] = x[1] = x[2] = x[3] = 0;
    }
    void AddWithWeight(const Position &p, Real weight) {
        for (int i = 0; i < 4; i++)
            x[i] += weight * p.x[i];
    }
};

using Refiner = std::unique_ptr<Far::TopologyRefiner>;

/* OpenSubdiv's number for a sharpness. */
float to_sharpness(uint8_t sharpness) {
    return sharpness == HS_SHARP_INFINITE ? Sdc::Crease::SHARPNESS_INFINITE : float(sharpness);
}

/* What is sharp in a mesh, in OpenSubdiv's lists. */
struct Tags {
    std::vector<Far::Index> edge, vertex; /* an edge is two vertices */
    std::vector<float> edge_sharpness, vertex_sharpness;

    explicit Tags(const hs_mesh *mesh) {
        for (uint32_t h = 0; mesh->sharpness && h < mesh->halfedges; h++) {
            if (mesh->sharpness[h] == 0 || mesh->twin[h] < h) continue;
            edge.push_back(Far::Index(mesh->origin[h]));
            edge.push_back(Far::Index(mesh->origin[hs_next(mesh, h)]));
            edge_sharpness.push_back(to_sharpness(mesh->sharpness[h]));
        }
        for (uint32_t v = 0; mesh->vertex_sharpness && v < mesh->vertices; v++) {
            if (mesh->vertex_sharpness[v] == 0) continue;
            vertex.push_back(Far::Index(v));
            vertex_sharpness.push_back(to_sharpness(mesh->vertex_sharpness[v]));
        }
    }
};

Refiner make_refiner(const hs_mesh *mesh, enum osd_boundary boundary) {
    std::vector<int> sides(mesh->faces);
    std::vector<Far::Index> corner(mesh->origin, mesh->origin + mesh->halfedges);
    for (uint32_t f = 0; f < mesh->faces; f++)
        sides[f] = int(hs_sides(mesh, f));

    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = int(mesh->vertices);
    descriptor.numFaces = int(mesh->faces);
    descriptor.numVertsPerFace = sides.data();
    descriptor.vertIndicesPerFace = corner.data();

    const Tags tags(mesh);
    descriptor.numCreases = int(tags.edge_sharpness.size());
    descriptor.creaseVertexIndexPairs = tags.edge.data();
    descriptor.creaseWeights = tags.edge_sharpness.data();
    descriptor.numCorners = int(tags.vertex_sharpness.size());
    descriptor.cornerVertexIndices = tags.vertex.data();
    descriptor.cornerWeights = tags.vertex_sharpness.data();

    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        boundary == OSD_BOUNDARY_NONE        ? Sdc::Options::VTX_BOUNDARY_NONE
        : boundary == OSD_BOUNDARY_EDGE_ONLY ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                             : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    Factory::Options how(Sdc::SCHEME_CATMARK, options);
    how.validateFullTopology = true;
    return Refiner(Factory::Create(descriptor, how));
}

template <typename T> T *new_array(size_t count) {
    T *array = static_cast<T *>(std::calloc(count ? count : 1, sizeof(T)));
    if (!array) throw std::bad_alloc();
    return array;
}

void copy_faces(osd_level *out, const Far::TopologyLevel &in) {
    out->vertices = uint32_t(in.GetNumVertices());
    out->faces = uint32_t(in.GetNumFaces());
    out->first = new_array<uint32_t>(size_t(out->faces) + 1);
    out->corner = new_array<uint32_t>(size_t(in.GetNumFaceVertices()));
    for (uint32_t f = 0; f < out->faces; f++) {
        const Far::ConstIndexArray v = in.GetFaceVertices(int(f));
        out->first[f + 1] = out->first[f] + uint32_t(v.size());
        for (int k = 0; k < v.size(); k++)
            out->corner[out->first[f] + uint32_t(k)] = uint32_t(v[k]);
    }
}

void copy_children(osd_level *out, const Far::TopologyLevel &in) {
    out->edges = uint32_t(in.GetNumEdges());
    out->edge = new_array<uint32_t>(2 * size_t(out->edges));
    out->vertex_child = new_array<uint32_t>(out->vertices);
    out->edge_child = new_array<uint32_t>(out->edges);
    out->face_child = new_array<uint32_t>(out->faces);
    for (uint32_t v = 0; v < out->vertices; v++)
        out->vertex_child[v] = uint32_t(in.GetVertexChildVertex(int(v)));
    for (uint32_t f = 0; f < out->faces; f++)
        out->face_child[f] = uint32_t(in.GetFaceChildVertex(int(f)));
    for (uint32_t e = 0; e < out->edges; e++) {
        const Far::ConstIndexArray v = in.GetEdgeVertices(int(e));
        out->edge[2 * e] = uint32_t(v[0]);
        out->edge[2 * e + 1] = uint32_t(v[1]);
        out->edge_child[e] = uint32_t(in.GetEdgeChildVertex(int(e)));
    }
}

void place_vertices(double *position, const hs_mesh *mesh, const double *matrix) {
    for (size_t v = 0; v < mesh->vertices; v++) {
        const float *p = mesh->position + 4 * v;
        for (size_t row = 0; row < 4; row++) {
            double sum = matrix ? 0 : p[row];
            for (size_t i = 0; matrix && i < 4; i++)
                sum += matrix[4 * row + i] * double(p[i]);
            position[4 * v + row] = sum;
        }
    }
}

void copy_surface(osd_surface *surface, const Far::TopologyRefiner &refiner, const hs_mesh *mesh,
                  const double *matrix) {
    using P = Position<double>;
    static_assert(sizeof(P) == 4 * sizeof(double), "positions are plain arrays");
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    for (uint32_t l = 0; l <= surface->levels; l++) {
        osd_level *out = &surface->level[l];
        const Far::TopologyLevel &in = refiner.GetLevel(int(l));
        copy_faces(out, in);
        if (l < surface->levels) copy_children(out, in);
        out->position = new_array<double>(4 * size_t(out->vertices));
        P *here = reinterpret_cast<P *>(out->position);
        if (l == 0)
            place_vertices(out->position, mesh, matrix);
        else
            primvars.Interpolate(int(l), reinterpret_cast<const P *>(out[-1].position), here);
    }
    const osd_level *last = &surface->level[surface->levels];
    surface->limit = new_array<double>(4 * size_t(last->vertices));
    surface->tangent1 = new_array<double>(4 * size_t(last->vertices));
    surface->tangent2 = new_array<double>(4 * size_t(last->vertices));
    P *limit = reinterpret_cast<P *>(surface->limit),
      *tangent1 = reinterpret_cast<P *>(surface->tangent1),
      *tangent2 = reinterpret_cast<P *>(surface->tangent2);
    primvars.Limit(reinterpret_cast<const P *>(last->position), limit, tangent1, tangent2);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool check_levels(uint32_t levels, hs_error *err) {
    return levels <= OSD_MAX_LEVELS ||
           hs_fail(err, HS_EXIT_INTERNAL, "OpenSubdiv: too many levels");
}

} // namespace

bool osd_refine(osd_surface *surface, const hs_mesh *mesh, const double matrix[16], uint32_t levels,
                enum osd_boundary boundary, hs_error *err) try {
    std::memset(surface, 0, sizeof *surface);
    if (!check_levels(levels, err)) return false;
    Refiner refiner = make_refiner(mesh, boundary);
    if (!refiner) return hs_fail(err, HS_EXIT_MESH, "OpenSubdiv refuses the mesh");
    Far::TopologyRefiner::UniformOptions how(static_cast<int>(levels));
    how.fullTopologyInLastLevel = true; /* Limit needs it */
    refiner->RefineUniform(how);
    surface->levels = levels;
    copy_surface(surface, *refiner, mesh, matrix);
    return true;
} catch (const std::exception &e) {
    osd_free(surface);
    return hs_fail(err, HS_EXIT_INTERNAL, "OpenSubdiv: %s", e.what());
}

void osd_free(osd_surface *surface) {
    for (osd_level &level : surface->level) {
        std::free(level.position);
        std::free(level.first);
        std::free(level.corner);
        std::free(level.edge);
        std::free(level.vertex_child);
        std::free(level.edge_child);
        std::free(level.face_child);
    }
    std::free(surface->limit);
    std::free(surface->tangent1);
    std::free(surface->tangent2);
    std::memset(surface, 0, sizeof *surface);
}

bool osd_time(osd_timing *timing, const hs_mesh *mesh, uint32_t levels, hs_error *err) try {
    using P = Position<float>;
    if (!check_levels(levels, err)) return false;
    Refiner refiner = make_refiner(mesh, OSD_BOUNDARY_EDGE_AND_CORNER);
    if (!refiner) return hs_fail(err, HS_EXIT_MESH, "OpenSubdiv refuses the mesh");

    auto start = std::chrono::steady_clock::now();
    refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(int(levels)));
    timing->topology = seconds_since(start);

    /* All levels in one array, touched before the clock starts. */
    std::vector<P> position(size_t(refiner->GetNumVerticesTotal()), P{{1, 1, 1, 1}});
    std::memcpy(position.data(), mesh->position, mesh->vertices * sizeof(P));
    const Far::PrimvarRefinerReal<float> primvars(*refiner);
    start = std::chrono::steady_clock::now();
    P *source = position.data();
    for (int l = 1; l <= int(levels); l++) {
        P *here = source + refiner->GetLevel(l - 1).GetNumVertices();
        primvars.Interpolate(l, source, here);
        source = here;
    }
    timing->position = seconds_since(start);
    timing->faces = uint64_t(refiner->GetLevel(int(levels)).GetNumFaces());
    timing->vertices = uint64_t(refiner->GetLevel(int(levels)).GetNumVertices());
    return true;
} catch (const std::exception &e) {
    return hs_fail(err, HS_EXIT_INTERNAL, "OpenSubdiv: %s", e.what());
}
