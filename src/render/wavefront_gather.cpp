// The Monte-Carlo component at the very points that eye rays meet, as deep buffers know what
// arrives there (paper §3.1.1). Nothing is carried: those points are this picture's own.
#include "render/bundle_sums.h"

namespace transillum {

namespace {

constexpr std::size_t grain = 1024;

/// A point that an eye ray meets.
struct Site {
    static constexpr std::uint32_t no_lobe = 0xffffffffu;
    SurfaceSide at;
    std::uint32_t pixel, leaf, lobe = no_lobe;
    glm::vec3 within;
    Spectrum share;      ///< of the Lambert part
    Spectrum sum{0.0f};  ///< of what arrives for it
};
struct LobeSite {
    SurfacePoint point;
    Spectrum sum{0.0f};
};

class WavefrontGather final : public BundleGather {
public:
    WavefrontGather(const Solution& solution, const SolutionShader& shader, std::uint64_t seed,
                    const Workers& workers)
        : solution_(solution), shader_(shader), seed_(seed), workers_(workers) {}

    std::vector<Spectrum> gather(const PictureView& view, int bundles, Monitor& monitor) override {
        meet(view);
        BundleSums sums(solution_, shader_, MonteCarlo::wavefront, seed_, workers_);
        sums.transfer(bundles, monitor, [&] { add(sums); });
        std::vector<Spectrum> image(static_cast<std::size_t>(view.width) * view.height,
                                    Spectrum(0.0f));
        if (sums.count() > 0) finish(sums, image);
        sites_ = {};
        lobes_ = {};
        return image;
    }

private:
    void meet(const PictureView& view) {
        std::vector<std::vector<Site>> sites(view.height);
        std::vector<std::vector<LobeSite>> lobes(view.height);
        workers_.for_ranges(sites.size(), 1, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t y = begin; y < end; ++y)
                for (int x = 0; x < view.width; ++x)
                    for (int i = 0; i < gather_samples; ++i)
                        meet(view, x, static_cast<int>(y), i, sites[y], lobes[y]);
        });
        for (std::size_t y = 0; y < sites.size(); ++y) {
            const auto before = static_cast<std::uint32_t>(lobes_.size());
            for (Site& s : sites[y]) {
                if (s.lobe != Site::no_lobe) s.lobe += before;
                sites_.push_back(s);
            }
            lobes_.insert(lobes_.end(), lobes[y].begin(), lobes[y].end());
            sites[y] = {};
            lobes[y] = {};
        }
    }

    void meet(const PictureView& view, int x, int y, int sample, std::vector<Site>& sites,
              std::vector<LobeSite>& lobes) const {
        const auto seen = shader_.meet(eye_ray(view, x, y, sample));
        if (!seen) return;
        const SurfacePoint& p = seen->point;
        const Hit& hit = seen->hit;
        Site site{{hit.root, hit.back, hit.b1, hit.b2, p.position},
                  static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(view.width) +
                      static_cast<std::uint32_t>(x),
                  p.leaf,
                  Site::no_lobe,
                  p.within,
                  lambert_share(p)};
        if (has_gathered_lobe(p)) {
            site.lobe = static_cast<std::uint32_t>(lobes.size());
            lobes.push_back({p});
        }
        if (site.lobe != Site::no_lobe || max_channel(site.share) > 0.0f) sites.push_back(site);
    }

    void add(const BundleSums& sums) {
        workers_.for_ranges(sites_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                Site& s = sites_[i];
                const Spectrum incoming = sums.light().incoming(s.at);
                s.sum +=
                    sums.lambert_gain(s.at.root, s.at.back)
                        .weigh(incoming, s.leaf - solution_.patches.roots[s.at.root].first_leaf);
                if (s.lobe == Site::no_lobe) continue;
                LobeSite& lobe = lobes_[s.lobe];
                lobe.sum += sums.lobe_term(lobe.point, incoming);
            }
        });
    }

    void finish(const BundleSums& sums, std::vector<Spectrum>& image) const {
        const BundleLight::Projected projected = sums.projected();
        const LambertField lambert(solution_, shader_.grid(), projected.irradiance,
                                   projected.glossy_elements, workers_);
        const GlossyField glossy = sums.has_glossy() ? sums.excess(projected) : GlossyField();
        const float share = 1.0f / static_cast<float>(sums.count());
        for (const Site& s : sites_) {
            SurfacePoint p;
            p.leaf = s.leaf;
            p.patch = s.leaf + (s.at.back ? solution_.patches.leaf_count : 0);
            p.within = s.within;
            Spectrum residual = s.share * (share * s.sum - lambert.at(p));
            if (s.lobe != Site::no_lobe) {
                const LobeSite& lobe = lobes_[s.lobe];
                residual += share * lobe.sum - glossy.reflected(lobe.point);
            }
            image[s.pixel] += residual / static_cast<float>(gather_samples);
        }
    }

    const Solution& solution_;
    const SolutionShader& shader_;
    std::uint64_t seed_;
    const Workers& workers_;
    std::vector<Site> sites_;  ///< pixel by pixel
    std::vector<LobeSite> lobes_;
};

}  // namespace

std::unique_ptr<BundleGather> make_wavefront_gather(const Solution& solution,
                                                    const SolutionShader& shader,
                                                    std::uint64_t seed, const Workers& workers) {
    return std::make_unique<WavefrontGather>(solution, shader, seed, workers);
}

}  // namespace transillum
