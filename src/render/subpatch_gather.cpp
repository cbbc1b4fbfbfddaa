// The Monte-Carlo component on quarters of patches, the cells of the sub-patch representation
// (paper §3.1.2), carried from picture to picture (§5: "an additional variable on each patch that
// stores the output radiance towards the eye").
//
// What Lambert parts reflect depends on no eye: it is the mean of all bundles so far. What a lobe
// shows does. Where the direction from a cell to the eye has turned by an angle delta since the
// last picture, what is known from before keeps the weight of
//     exp(-delta / width)
// times the bundles it stood for, width being the standard deviation of the lobe: 1 / sqrt(n) of
// cos^n, a Gaussian of variance 1 / n. An exponential, so that a turn costs the same in one step or
// in many. A still eye thus goes on averaging, and a moving one forgets as fast as it turns.
// Cells start from a residual of zero, plain finite elements, that counts for prior_bundles: of a
// few bundles their noise alone would show, and flicker where a fast walk forgets all others.
#include "render/bundle_sums.h"
#include "render/surface_at.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace transillum {

namespace {

constexpr std::size_t grain = 1024;
/// The mean square of one bundle's noise over that of the residual: 23 was measured in a glossy box
/// of 14000 patches, 33 in a Lambert one of 2000.
constexpr float prior_bundles = 32.0f;

/// What a cell is known to show towards an eye beyond its elements, of a lobe of albedo 1.
struct LobeMemory {
    glm::vec3 to_eye{0.0f};
    float bundles = 0.0f;  ///< that it stands for; 0 where nothing is known
    Spectrum residual{0.0f};
};

/// Gathered for this picture.
struct LobeSite {
    std::uint32_t cell;  ///< a side of it
    SurfacePoint point;  ///< its centre
    Spectrum sum{0.0f};
};

/// A residual of both kinds.
struct Shown {
    Spectrum lambert{0.0f}, lobe{0.0f};
};

Spectrum ratio(const Spectrum& a, const Spectrum& b) {
    Spectrum r(0.0f);
    for (int c = 0; c < channel_count; ++c)
        if (b[c] > 0.0f) r[c] = a[c] / b[c];
    return r;
}

double angle_between(const glm::vec3& a, const glm::vec3& b) {
    const glm::dvec3 x(a), y(b);
    return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y));
}

class SubpatchGather final : public BundleGather {
public:
    SubpatchGather(const Solution& solution, const SolutionShader& shader, std::uint64_t seed,
                   const Workers& workers)
        : solution_(solution),
          shader_(shader),
          workers_(workers),
          sums_(solution, shader, MonteCarlo::subpatch, seed, workers),
          cells_(sums_.light().cells()),
          arrived_(cells_.patch_count(), SpectrumSum(0.0)),
          irradiance_(solution.indirect_irradiance.size(), SpectrumSum(0.0)),
          elements_(solution.glossy_elements.size(), Spectrum(0.0f)) {
        if (shader.grid()) grid_ = build_vertex_grid(solution.surface, cells_);
        if (sums_.has_glossy()) lobes_.resize(cells_.patch_count());
        for (std::uint32_t cell = 0; cell < cells_.leaf_count; ++cell) {
            const Hit centre = centre_of(cell, false);
            leaf_of_.push_back(solution.patches.leaf_at(centre.root, centre.b1, centre.b2));
        }
    }

    std::vector<Spectrum> gather(const PictureView& view, int bundles, Monitor& monitor) override {
        meet(view);
        sums_.transfer(bundles, monitor, [&] { add(); });
        const BundleLight::Projected projected = sums_.projected();
        remember(projected);
        remember_lobes(projected);
        std::vector<Spectrum> image(static_cast<std::size_t>(view.width) * view.height,
                                    Spectrum(0.0f));
        if (bundles_ > 0) paint(view, image);
        return image;
    }

private:
    [[nodiscard]] Hit centre_of(std::uint32_t cell, bool back) const {
        const auto [corners, level] = leaf_corners(cells_, cell);
        const glm::vec2 sum(corners[0] + corners[1] + corners[2]);
        const glm::vec2 b = sum / (3.0f * static_cast<float>(1 << level));
        return {cells_.root_of_leaf[cell], b.x, b.y, 0.0f, back};
    }
    [[nodiscard]] std::uint32_t cell_at(const Hit& hit) const {
        const std::uint32_t cell = cells_.leaf_at(hit.root, hit.b1, hit.b2);
        return hit.back ? cell + cells_.leaf_count : cell;
    }
    /// The point at a cell's centre. \param cell a side of it
    [[nodiscard]] SurfacePoint point_of(std::uint32_t cell) const {
        const Hit centre = centre_of(cells_.leaf_of_patch(cell), cells_.is_back(cell));
        const glm::dvec3 at = shader_.facets()[centre.root].point(centre.b1, centre.b2);
        return shader_.point_at(centre, glm::normalize(at - eye_));
    }

    /// Lists the cells that this picture shows.
    void meet(const PictureView& view) {
        eye_ = view.rays.eye();
        std::vector<std::uint8_t> is_seen(cells_.patch_count());
        workers_.for_ranges(view.height, 1, [&](std::size_t begin, std::size_t end, int) {
            for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                for (int x = 0; x < view.width; ++x)
                    for (int i = 0; i < gather_samples; ++i)
                        if (const auto seen = shader_.meet(eye_ray(view, x, y, i)))
                            std::atomic_ref(is_seen[cell_at(seen->hit)])
                                .store(1, std::memory_order_relaxed);
        });
        seen_.clear();
        sites_.clear();
        for (std::uint32_t cell = 0; cell < is_seen.size(); ++cell) {
            if (is_seen[cell] == 0) continue;
            seen_.push_back(cell);
            if (!sums_.has_glossy()) continue;
            const SurfacePoint p = point_of(cell);
            if (has_gathered_lobe(p) && p.out.z > 0.0f) sites_.push_back({cell, p});
        }
    }

    void add() {
        const BundleLight& light = sums_.light();
        workers_.for_ranges(arrived_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (auto cell = static_cast<std::uint32_t>(begin); cell < end; ++cell) {
                const std::uint32_t leaf = cells_.leaf_of_patch(cell);
                const std::uint32_t root = cells_.root_of_leaf[leaf];
                arrived_[cell] += SpectrumSum(
                    sums_.lambert_gain(root, cells_.is_back(cell))
                        .weigh(light.incoming_of_cell(cell),
                               leaf_of_[leaf] - solution_.patches.roots[root].first_leaf));
            }
        });
        workers_.for_ranges(sites_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i)
                sites_[i].sum +=
                    sums_.lobe_term(sites_[i].point, light.incoming_of_cell(sites_[i].cell));
        });
    }

    /// Means of what elements would hold, over the bundles of all pictures.
    void remember(const BundleLight::Projected& projected) {
        bundles_ += sums_.count();
        if (bundles_ == 0) return;
        const double share = static_cast<double>(sums_.count()) / static_cast<double>(bundles_);
        for (std::size_t p = 0; p < irradiance_.size(); ++p)
            irradiance_[p] += share * (SpectrumSum(projected.irradiance[p]) - irradiance_[p]);
        for (std::size_t e = 0; e < elements_.size(); ++e)
            elements_[e] +=
                static_cast<float>(share) * (projected.glossy_elements[e] - elements_[e]);
    }

    void remember_lobes(const BundleLight::Projected& projected) {
        if (sites_.empty() || sums_.count() == 0) return;
        const GlossyField excess = sums_.excess(projected);
        const auto n = static_cast<float>(sums_.count());
        workers_.for_ranges(sites_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                const LobeSite& s = sites_[i];
                const SurfacePoint& p = s.point;
                const Spectrum found =
                    ratio(s.sum / n - excess.reflected(p), lobe_albedo(p.brdf, p.out.z));
                LobeMemory& m = lobes_[s.cell];
                const auto to_eye = glm::vec3(glm::normalize(eye_ - p.position));
                if (m.bundles > 0.0f)
                    m.bundles *= static_cast<float>(
                        std::exp(-angle_between(m.to_eye, to_eye) / lobe_width(p.brdf)));
                m.to_eye = to_eye;
                m.bundles += n;
                m.residual += n / m.bundles * (found - m.residual);
            }
        });
    }

    /// Of a side of a cell that is seen.
    [[nodiscard]] Shown residual_of(std::uint32_t cell, const LambertField& held) const {
        const Hit centre = centre_of(cells_.leaf_of_patch(cell), cells_.is_back(cell));
        SurfacePoint p;
        p.leaf = leaf_of_[cells_.leaf_of_patch(cell)];
        p.patch = p.leaf + (cells_.is_back(cell) ? solution_.patches.leaf_count : 0);
        p.within = within_leaf(solution_.patches, p.leaf, centre);
        const auto trust = [](float bundles) { return bundles / (bundles + prior_bundles); };
        const Spectrum arrived(arrived_[cell] / static_cast<double>(bundles_));
        Shown shown{trust(static_cast<float>(bundles_)) * (arrived - held.at(p)), {}};
        if (!lobes_.empty()) shown.lobe = trust(lobes_[cell].bundles) * lobes_[cell].residual;
        return shown;
    }

    void paint(const PictureView& view, std::vector<Spectrum>& image) {
        std::vector<Spectrum> irradiance;
        irradiance.reserve(irradiance_.size());
        for (const SpectrumSum& e : irradiance_) irradiance.emplace_back(e);
        const LambertField held(solution_, shader_.grid(), irradiance, elements_, workers_);
        std::vector<Shown> of_cells(cells_.patch_count());
        std::vector<std::uint8_t> is_known(cells_.patch_count());
        workers_.for_ranges(seen_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                of_cells[seen_[i]] = residual_of(seen_[i], held);
                is_known[seen_[i]] = 1;
            }
        });
        const std::vector<Shown> of_vertices = means_at_vertices(of_cells, is_known);
        workers_.for_ranges(view.height, 1, [&](std::size_t begin, std::size_t end, int) {
            for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                for (int x = 0; x < view.width; ++x)
                    for (int i = 0; i < gather_samples; ++i)
                        image[static_cast<std::size_t>(y) * view.width + x] +=
                            residual_at(eye_ray(view, x, y, i), of_cells, of_vertices) /
                            static_cast<float>(gather_samples);
        });
    }

    /// Of the cells that are seen; 2 * vertex + back. Empty without interpolation.
    [[nodiscard]] std::vector<Shown> means_at_vertices(
        const std::vector<Shown>& of_cells, const std::vector<std::uint8_t>& is_known) const {
        std::vector<Shown> means(2 * grid_.vertex_count());
        workers_.for_ranges(means.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                float count = 0.0f;
                for (const std::uint32_t leaf :
                     grid_.leaves_at(static_cast<std::uint32_t>(i / 2))) {
                    const std::uint32_t cell = leaf + (i % 2 != 0 ? cells_.leaf_count : 0);
                    if (is_known[cell] == 0) continue;
                    means[i].lambert += of_cells[cell].lambert;
                    means[i].lobe += of_cells[cell].lobe;
                    count += 1.0f;
                }
                if (count == 0.0f) continue;
                means[i].lambert /= count;
                means[i].lobe /= count;
            }
        });
        for (const VertexGrid::Hanging& h : grid_.hanging)
            for (const std::uint32_t back : {0u, 1u}) {
                const Shown &from = means[2 * h.from + back], &to = means[2 * h.to + back];
                means[2 * h.vertex + back] = {glm::mix(from.lambert, to.lambert, h.share),
                                              glm::mix(from.lobe, to.lobe, h.share)};
            }
        return means;
    }

    [[nodiscard]] Spectrum residual_at(const Ray& ray, const std::vector<Shown>& of_cells,
                                       const std::vector<Shown>& of_vertices) const {
        const auto seen = shader_.meet(ray);
        if (!seen) return Spectrum(0.0f);
        const std::uint32_t cell = cell_at(seen->hit), leaf = cells_.leaf_of_patch(cell);
        Shown shown = of_cells[cell];
        if (!of_vertices.empty()) {
            shown = {};
            const glm::vec3 within = within_leaf(cells_, leaf, seen->hit);
            for (int c = 0; c < 3; ++c) {
                const Shown& v =
                    of_vertices[2 * grid_.leaf_vertices[leaf][c] + (seen->hit.back ? 1 : 0)];
                shown.lambert += within[c] * v.lambert;
                shown.lobe += within[c] * v.lobe;
            }
        }
        const SurfacePoint& p = seen->point;
        Spectrum sum = lambert_share(p) * shown.lambert;
        if (has_gathered_lobe(p)) sum += lobe_albedo(p.brdf, p.out.z) * shown.lobe;
        return sum;
    }

    const Solution& solution_;
    const SolutionShader& shader_;
    const Workers& workers_;
    BundleSums sums_;
    const PatchHierarchy& cells_;
    VertexGrid grid_;                     ///< of the cells; empty without interpolation
    std::vector<std::uint32_t> leaf_of_;  ///< that a cell is a quarter of

    // Over all pictures:
    std::uint64_t bundles_ = 0;
    std::vector<SpectrumSum> arrived_;     ///< sums for the Lambert parts of cells' sides
    std::vector<SpectrumSum> irradiance_;  ///< means of what elements would hold
    std::vector<Spectrum> elements_;
    std::vector<LobeMemory> lobes_;  ///< of cells' sides; empty without glossy sides

    // Of this one:
    glm::dvec3 eye_{0.0};
    std::vector<std::uint32_t> seen_;  ///< sides of cells
    std::vector<LobeSite> sites_;
};

}  // namespace

std::unique_ptr<BundleGather> make_subpatch_gather(const Solution& solution,
                                                   const SolutionShader& shader, std::uint64_t seed,
                                                   const Workers& workers) {
    return std::make_unique<SubpatchGather>(solution, shader, seed, workers);
}

}  // namespace transillum
