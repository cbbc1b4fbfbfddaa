#include "first_shot/bound_direct_light.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

namespace transillum {

namespace {

constexpr std::size_t patches_at_a_time = 1024;
/// What is spread may fill other patches in turn, less each time.
constexpr int most_rounds = 16;
/// Of shares, which are kept as floats.
constexpr double rounding = 1e-5;

class Bounding {
public:
    Bounding(const SurfaceMesh& mesh, const PatchHierarchy& patches, DirectLight& light,
             const Workers& workers)
        : mesh_(mesh),
          patches_(patches),
          light_(light),
          workers_(workers),
          total_(patches.patch_count()),
          is_full_(patches.patch_count()) {
        for (std::size_t c = 0; c < light.columns(); ++c)
            if (light.light(c).kind == LightSample::Kind::area) columns_.push_back(c);
    }

    void run() {
        if (columns_.empty()) return;
        for (int round = 0;; ++round) {
            add_up();
            std::vector<double> cut = cut_off();
            if (cut.empty()) return;
            if (round == most_rounds) return spread_everywhere(cut);
            spread(cut);
        }
    }

private:
    void add_up() {
        workers_.for_ranges(total_.size(), patches_at_a_time,
                            [&](std::size_t begin, std::size_t end, int) {
                                for (std::size_t p = begin; p < end; ++p) {
                                    total_[p] = 0.0;
                                    for (const std::size_t c : columns_)
                                        total_[p] += light_.share(p, c);
                                }
                            });
    }

    /// \returns what every column loses by it, share times area; nothing where nothing is too much
    std::vector<double> cut_off() {
        std::vector<double> cut;
        for (std::size_t p = 0; p < total_.size(); ++p) {
            if (!(total_[p] > (1.0 + rounding) * std::numbers::pi)) continue;
            cut.resize(columns_.size());
            is_full_[p] = 1;
            const double kept = std::numbers::pi / total_[p];
            for (std::size_t i = 0; i < columns_.size(); ++i) {
                cut[i] += (1.0 - kept) * area_of(p) * light_.share(p, columns_[i]);
                light_.scale(p, columns_[i], kept);
            }
        }
        return cut;
    }

    /// \param cut emptied
    void spread(std::vector<double>& cut) {
        if (near_.empty()) find_near();
        for (std::size_t i = 0; i < cut.size(); ++i)
            if (cut[i] > 0.0 && spread_near(i, cut[i])) cut[i] = 0.0;
        if (std::ranges::any_of(cut, [](double c) { return c > 0.0; })) spread_everywhere(cut);
    }

    /// Patches whose centre lies within two diameters of a disc as large as a sample's piece.
    void find_near() {
        std::vector<glm::dvec3> centres(total_.size());
        workers_.for_ranges(centres.size(), patches_at_a_time,
                            [&](std::size_t begin, std::size_t end, int) {
                                for (std::size_t p = begin; p < end; ++p)
                                    centres[p] = leaf_centre(mesh_, patches_, leaf_of(p));
                            });
        near_.resize(columns_.size());
        workers_.for_ranges(columns_.size(), 1, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::uint32_t p = 0; p < centres.size(); ++p)
                    if (is_near(centres[p], columns_[i])) near_[i].push_back(p);
        });
    }

    [[nodiscard]] bool is_near(const glm::dvec3& centre, std::size_t column) const {
        const auto [first, last] = light_.samples_of(column);
        for (std::size_t s = first; s < last; ++s) {
            const LightSample& sample = light_.samples[s];
            const glm::dvec3 way = sample.position - centre;
            const double squared_radius = sample.area * std::numbers::inv_pi;
            if (glm::dot(way, way) < 16.0 * squared_radius) return true;
        }
        return false;
    }

    /// Evenly over what the column's samples see. \returns false where there is no room
    bool spread_near(std::size_t i, double cut) {
        const std::size_t c = columns_[i];
        const auto has_room = [&](std::uint32_t p) {
            return !is_full_[p] && light_.share(p, c) > 0.0;
        };
        const auto visibility = [&](std::uint32_t p) {
            return light_.has_vectors() ? 1.0 : double{light_.visibility[p * light_.columns() + c]};
        };
        double area = 0.0;
        for (const std::uint32_t p : near_[i])
            if (has_room(p)) area += area_of(p) * visibility(p);
        if (!(area > 0.0)) return false;
        for (const std::uint32_t p : near_[i])
            if (has_room(p))
                light_.scale(p, c, 1.0 + cut / area * visibility(p) / light_.share(p, c));
        return true;
    }

    /// In proportion.
    void spread_everywhere(const std::vector<double>& cut) {
        std::vector<double> elsewhere(columns_.size());
        for (std::size_t p = 0; p < total_.size(); ++p)
            for (std::size_t i = 0; !is_full_[p] && i < columns_.size(); ++i)
                elsewhere[i] += area_of(p) * light_.share(p, columns_[i]);
        for (std::size_t p = 0; p < total_.size(); ++p)
            for (std::size_t i = 0; !is_full_[p] && i < columns_.size(); ++i)
                if (elsewhere[i] > 0.0) light_.scale(p, columns_[i], 1.0 + cut[i] / elsewhere[i]);
    }

    [[nodiscard]] std::uint32_t leaf_of(std::size_t patch) const {
        return patches_.leaf_of_patch(static_cast<std::uint32_t>(patch));
    }
    [[nodiscard]] double area_of(std::size_t patch) const {
        return area_of_leaf(mesh_, patches_, leaf_of(patch));
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    DirectLight& light_;
    const Workers& workers_;
    std::vector<std::size_t> columns_;  ///< of surfaces
    std::vector<double> total_;         ///< projected solid angle that they fill, one a patch
    std::vector<std::uint8_t> is_full_;
    std::vector<std::vector<std::uint32_t>> near_;  ///< patches, by column; once they are needed
};

}  // namespace

void bound_direct_light(const SurfaceMesh& mesh, const PatchHierarchy& patches, DirectLight& light,
                        const Workers& workers) {
    Bounding(mesh, patches, light, workers).run();
}

}  // namespace transillum
