#include <transillum/transport/iterate_without.h>

#include "transport/iteration_sums.h"

#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

/// Entries that a part has of what the whole has, in the same order.
class Part {
public:
    std::size_t whole = 0;
    std::vector<std::uint64_t> entries;  ///< of the whole, one an entry of the part

    /// Those of an empty table are none.
    template <class Value>
    [[nodiscard]] std::vector<Value> gather(const std::vector<Value>& of_whole) const {
        std::vector<Value> part;
        if (of_whole.empty()) return part;
        part.reserve(entries.size());
        for (const std::uint64_t i : entries) part.push_back(of_whole[i]);
        return part;
    }
    template <class Value>
    [[nodiscard]] std::vector<Value> scatter(const std::vector<Value>& of_part,
                                             const Value& elsewhere) const {
        std::vector<Value> all;
        if (of_part.empty() && !entries.empty()) return all;
        all.resize(whole, elsewhere);
        for (std::size_t i = 0; i < entries.size(); ++i) all[entries[i]] = of_part[i];
        return all;
    }
};

/// Numbers of the roots that stay, one a root; `none` of those that don't.
std::vector<std::uint32_t> number_roots(std::span<const std::uint8_t> left_out) {
    std::vector<std::uint32_t> numbers;
    std::uint32_t next = 0;
    for (const std::uint8_t out : left_out) numbers.push_back(out ? none : next++);
    return numbers;
}

SurfaceMesh part_of_mesh(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& numbers) {
    SurfaceMesh part;
    part.materials = mesh.materials;
    part.textures = mesh.textures;
    part.fan_count = mesh.fan_count;
    part.grid = mesh.grid;
    std::vector<std::uint32_t> vertex(mesh.positions.size(), none);
    for (std::uint32_t r = 0; r < mesh.triangles.size(); ++r) {
        if (numbers[r] == none) continue;
        RootTriangle t = mesh.triangles[r];
        for (std::uint32_t& v : t.vertices) {
            if (vertex[v] == none) {
                vertex[v] = static_cast<std::uint32_t>(part.positions.size());
                part.positions.push_back(mesh.positions[v]);
            }
            v = vertex[v];
        }
        part.triangles.push_back(t);
        if (mesh.uvs.empty()) continue;
        part.uvs.insert(part.uvs.end(), mesh.uvs.begin() + 3 * r, mesh.uvs.begin() + 3 * r + 3);
    }
    return part;
}

/// Patches and glossy elements of the roots that stay.
class PartOfPatches {
public:
    PartOfPatches(const PatchHierarchy& patches, const std::vector<GlossySide>& sides,
                  std::uint64_t element_count, const std::vector<std::uint32_t>& numbers) {
        for (std::uint32_t r = 0; r < numbers.size(); ++r) {
            if (numbers[r] == none) continue;
            RootPatches root = patches.roots[r];
            for (std::uint32_t i = 0; i < patches.leaves_of(r); ++i) {
                of_patches.entries.push_back(root.first_leaf + i);
                hierarchy.root_of_leaf.push_back(numbers[r]);
            }
            root.first_leaf = hierarchy.leaf_count;
            hierarchy.leaf_count += patches.leaves_of(r);
            hierarchy.roots.push_back(root);
        }
        hierarchy.mixed_roots = patches.mixed_roots;
        for (std::uint32_t leaf = 0; leaf < hierarchy.leaf_count; ++leaf)
            of_patches.entries.push_back(of_patches.entries[leaf] + patches.leaf_count);
        of_patches.whole = patches.patch_count();
        of_elements.whole = element_count;
        for (const GlossySide& whole : sides) {
            if (numbers[whole.root] == none) continue;
            GlossySide side = whole;
            side.root = numbers[whole.root];
            side.first_patch =
                hierarchy.roots[side.root].first_leaf + (side.back ? hierarchy.leaf_count : 0);
            side.first_element = of_elements.entries.size();
            const std::uint64_t count = static_cast<std::uint64_t>(whole.bins()) * whole.leaf_count;
            for (std::uint64_t i = 0; i < count; ++i)
                of_elements.entries.push_back(whole.first_element + i);
            glossy_sides.push_back(side);
        }
    }

    PatchHierarchy hierarchy;
    std::vector<GlossySide> glossy_sides;
    Part of_patches, of_elements;
};

std::uint64_t element_count(const std::vector<GlossySide>& sides) {
    std::uint64_t count = 0;
    for (const GlossySide& s : sides) count += static_cast<std::uint64_t>(s.bins()) * s.leaf_count;
    return count;
}

PatchSources part_of_sources(const PatchSources& sources, const PartOfPatches& part) {
    PatchSources of_part;
    of_part.emission = part.of_patches.gather(sources.emission);
    of_part.direct = part.of_patches.gather(sources.direct);
    of_part.albedo = part.of_patches.gather(sources.albedo);
    of_part.environment = sources.environment;
    of_part.glossy.brdfs = sources.glossy.brdfs;
    of_part.glossy.projections = sources.glossy.projections;
    of_part.glossy.sides = part.glossy_sides;
    of_part.glossy.element_count = part.of_elements.entries.size();
    of_part.glossy.of_root_side.assign(2 * part.hierarchy.roots.size(), GlossySides::none);
    for (std::uint32_t i = 0; i < part.glossy_sides.size(); ++i) {
        const GlossySide& s = part.glossy_sides[i];
        of_part.glossy.of_root_side[2 * s.root + (s.back ? 1 : 0)] = i;
    }
    if (sources.first_incoming.empty()) return of_part;
    of_part.first_incoming.push_back(0);
    for (const std::uint64_t p : part.of_patches.entries) {
        const auto begin = sources.incoming.begin();
        of_part.incoming.insert(of_part.incoming.end(), begin + sources.first_incoming[p],
                                begin + sources.first_incoming[p + 1]);
        of_part.first_incoming.push_back(static_cast<std::uint32_t>(of_part.incoming.size()));
    }
    return of_part;
}

std::shared_ptr<const IterationSums> part_of_sums(const IterationSums& sums,
                                                  const std::vector<std::uint32_t>& numbers) {
    const PartOfPatches part(sums.patches, sums.sides, element_count(sums.sides), numbers);
    auto of_part = std::make_shared<IterationSums>(sums);
    of_part->patches = part.hierarchy;
    of_part->sides = part.glossy_sides;
    for (FiniteElementSums* const e : {&of_part->elements, &of_part->earlier}) {
        e->patches = part.of_patches.gather(e->patches);
        e->glossy = part.of_elements.gather(e->glossy);
    }
    of_part->error.last = part.of_patches.gather(of_part->error.last);
    return of_part;
}

std::shared_ptr<const IterationSums> whole_sums(const IterationSums& of_part,
                                                const PartOfPatches& part,
                                                const PatchHierarchy& patches,
                                                const std::vector<GlossySide>& sides) {
    auto sums = std::make_shared<IterationSums>(of_part);
    sums->patches = patches;
    sums->sides = sides;
    for (FiniteElementSums* const e : {&sums->elements, &sums->earlier}) {
        if (e->patches.empty()) continue;  // nothing was set aside
        e->patches = part.of_patches.scatter(e->patches, PatchSums{});
        e->glossy = part.of_elements.scatter(e->glossy, GlossySum{});
    }
    sums->error.last = part.of_patches.scatter(sums->error.last, -1.0f);
    return sums;
}

}  // namespace

TransportResult iterate_without(std::span<const std::uint8_t> left_out, const SurfaceMesh& mesh,
                                const PatchHierarchy& patches, const PatchSources& sources,
                                const IterationOptions& options, const Workers& workers,
                                Monitor& monitor) {
    const std::vector<std::uint32_t> numbers = number_roots(left_out);
    const SurfaceMesh part_of_surface = part_of_mesh(mesh, numbers);
    const PartOfPatches part(patches, sources.glossy.sides, sources.glossy.element_count, numbers);
    IterationOptions of_part = options;
    if (options.start) of_part.start = part_of_sums(*options.start, numbers);
    TransportResult result = iterate(part_of_surface, part.hierarchy,
                                     part_of_sources(sources, part), of_part, workers, monitor);
    const Spectrum black(0.0f);
    result.irradiance = part.of_patches.scatter(result.irradiance, black);
    result.standard_error = part.of_patches.scatter(result.standard_error, black);
    result.coverage = part.of_patches.scatter(result.coverage, 0.0f);
    result.glossy_elements = part.of_elements.scatter(result.glossy_elements, black);
    result.spatial_error = part.of_patches.scatter(result.spatial_error, 0.0f);
    result.directional_error = part.of_patches.scatter(result.directional_error, 0.0f);
    if (result.sums) result.sums = whole_sums(*result.sums, part, patches, sources.glossy.sides);
    return result;
}

}  // namespace transillum
