#include "first_shot/bound_direct_light.h"

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
            if (cut.empty() || round == most_rounds) return;
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

    void spread(const std::vector<double>& cut) {
        std::vector<double> elsewhere(columns_.size());
        for (std::size_t p = 0; p < total_.size(); ++p)
            for (std::size_t i = 0; !is_full_[p] && i < columns_.size(); ++i)
                elsewhere[i] += area_of(p) * light_.share(p, columns_[i]);
        for (std::size_t p = 0; p < total_.size(); ++p)
            for (std::size_t i = 0; !is_full_[p] && i < columns_.size(); ++i)
                if (elsewhere[i] > 0.0) light_.scale(p, columns_[i], 1.0 + cut[i] / elsewhere[i]);
    }

    [[nodiscard]] double area_of(std::size_t patch) const {
        return area_of_leaf(mesh_, patches_,
                            patches_.leaf_of_patch(static_cast<std::uint32_t>(patch)));
    }

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    DirectLight& light_;
    const Workers& workers_;
    std::vector<std::size_t> columns_;  ///< of surfaces
    std::vector<double> total_;         ///< projected solid angle that they fill, one a patch
    std::vector<std::uint8_t> is_full_;
};

}  // namespace

void bound_direct_light(const SurfaceMesh& mesh, const PatchHierarchy& patches, DirectLight& light,
                        const Workers& workers) {
    Bounding(mesh, patches, light, workers).run();
}

}  // namespace transillum
