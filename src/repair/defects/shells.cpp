#include "repair/defects/shells.h"

namespace transillum {

namespace {

using Halfedge = ShellMesh::HalfedgeHandle;

/// From border to border, around the vertices where they meet.
void link_borders(ShellMesh& mesh) {
    for (const auto h : mesh.halfedges()) {
        if (mesh.face_handle(h).is_valid()) continue;
        Halfedge next = mesh.opposite_halfedge_handle(h);
        do next = mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(next));
        while (mesh.face_handle(next).is_valid());
        mesh.set_next_halfedge_handle(h, next);
    }
}

/// Makes the vertex that a half-edge leads to, of all that lead there around it.
void add_vertex(ShellMesh& mesh, Halfedge first, const glm::dvec3& p) {
    const ShellMesh::VertexHandle vertex = mesh.new_vertex({p.x, p.y, p.z});
    Halfedge in = first;
    do {
        mesh.set_vertex_handle(in, vertex);
        const Halfedge out = mesh.next_halfedge_handle(in);
        // OpenMesh knows vertices of a border by their first half-edge.
        if (in == first || !mesh.face_handle(out).is_valid()) mesh.set_halfedge_handle(vertex, out);
        in = mesh.opposite_halfedge_handle(out);
    } while (in != first);
}

}  // namespace

Shells::Shells(const TriangleSoup& soup, const EdgeTable& edges, const Sheets& sheets)
    : soup_(soup),
      across_(3 * soup.triangles.size(), many),
      first_(sheets.size() + 1, 0),
      place_(2 * soup.triangles.size(), 0) {
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const auto uses = edges[e];
        if (uses.size() == 1) across_[uses[0].side] = border;
        if (uses.size() != 2) continue;
        const std::uint32_t alike = uses[0].ascending == uses[1].ascending ? 1 : 0;
        across_[uses[0].side] = 2 * uses[1].side + alike;
        across_[uses[1].side] = 2 * uses[0].side + alike;
    }
    for (const std::uint32_t s : sheets.sheet) first_[s + 1] += sheets.orientable[s] ? 1 : 2;
    for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
    faces_.resize(first_.back());
    std::vector<std::uint32_t> count(sheets.size(), 0);
    const auto add = [&](std::uint32_t sheet, Side side) {
        place_[side] = count[sheet]++;
        faces_[first_[sheet] + place_[side]] = side;
    };
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const std::uint32_t s = sheets.sheet[t];
        const Side front = 2 * t + (sheets.turned[t] ? 1 : 0);
        add(s, front);
        if (!sheets.orientable[s]) add(s, front ^ 1u);
    }
}

Shell Shells::make(std::uint32_t sheet) const {
    const std::span<const Side> faces = faces_of(sheet);
    Shell shell{{}, {faces.begin(), faces.end()}, {}};
    ShellMesh& mesh = shell.mesh;
    mesh.reserve(faces.size() / 2 + 2, faces.size() / 2 * 3 + 3, faces.size());
    std::vector<Halfedge> of_edge(3 * faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t triangle = faces[f] / 2, turned = faces[f] % 2;
        const ShellMesh::FaceHandle face = mesh.new_face();
        Halfedge* const own = &of_edge[3 * f];
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t edge = 3 * triangle + c, across = across_[edge];
            if (across < border) {
                const std::uint32_t other = across / 2;
                const Side side = 2 * (other / 3) + (turned ^ (across & 1u));
                const Halfedge there = of_edge[3 * place_[side] + other % 3];
                if (there.is_valid()) own[c] = mesh.opposite_halfedge_handle(there);
            }
            if (!own[c].is_valid()) {
                own[c] = mesh.new_edge(ShellMesh::VertexHandle(), ShellMesh::VertexHandle());
                shell.edges.resize(mesh.n_halfedges(), edge);
            }
            shell.edges[static_cast<std::size_t>(own[c].idx())] = edge;
            mesh.set_face_handle(own[c], face);
        }
        for (std::uint32_t c = 0; c < 3; ++c)
            mesh.set_next_halfedge_handle(own[c], own[(c + (turned ? 2 : 1)) % 3]);
        mesh.set_halfedge_handle(face, own[0]);
    }
    link_borders(mesh);
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const Halfedge h = of_edge[3 * f + c];
            if (mesh.to_vertex_handle(h).is_valid()) continue;
            const auto& v = soup_.triangles[faces[f] / 2].vertices;
            add_vertex(mesh, h, soup_.positions[v[(c + (faces[f] % 2 ? 0 : 1)) % 3]]);
        }
    return shell;
}

}  // namespace transillum
