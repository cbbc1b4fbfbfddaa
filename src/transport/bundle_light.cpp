#include <transillum/transport/bundle_light.h>

#include "transport/bundle_transfer.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numbers>

namespace transillum {

struct BundleLight::State {
    State(const SurfaceMesh& mesh, const PatchHierarchy& patches, const PatchSources& sources,
          std::span<const Spectrum> irradiance, std::span<const Spectrum> glossy_elements,
          const BundleLightOptions& options, const Workers& workers)
        : given_irradiance(irradiance),
          given_elements(glossy_elements),
          mesh(mesh),
          patches(patches),
          sources(sources),
          workers(workers),
          exchange(patches.leaf_count, {}, workers),
          elements(mesh, patches, sources, workers),
          transfer(mesh, patches, options.pixel_size, options.seed, workers),
          irradiance(patches.patch_count()),
          glossy(sources.glossy.element_count) {
        elements.restore(given_irradiance, given_elements);
        transfer.record(options.representation);
    }

    void next() {
        const Bundle bundle = transfer.bundle(bundles);
        float brightest = 0.0f;
        if (sources.environment.shines()) {
            const Spectrum along = sources.environment.radiance(-bundle.frame[2]);
            const Spectrum against = sources.environment.radiance(bundle.frame[2]);
            brightest = std::max(max_channel(along), max_channel(against));
            send(brightest);
            exchange.set_environment(along, against);
        } else {
            send(brightest);
        }
        elements.send_along(exchange, bundle);
        transfer.transfer(exchange, elements, bundle);
        direction = bundle.frame[2];
        ++bundles;
        ++remembered;
        project();
    }

    void send(float brightest) {
        // Nothing is summed up but one bundle a patch.
        constexpr double most_fragments = 16384.0 * 16384.0;
        elements.send(exchange, brightest, most_fragments);
    }

    /// Adds what arrived to what elements would hold of it.
    void project() {
        constexpr std::size_t grain = 256;
        workers.for_ranges(
            patches.roots.size(), grain, [&](std::size_t begin, std::size_t end, int) {
                for (auto root = static_cast<std::uint32_t>(begin); root < end; ++root)
                    for (const bool back : {false, true}) project(root, back);
            });
    }

    void project(std::uint32_t root, bool back) {
        const glm::dvec3 normal = normal_of(mesh, root) * (back ? -1.0 : 1.0);
        const double cosine = glm::dot(normal, direction);
        const auto twice_cosine = static_cast<float>(2.0 * std::abs(cosine));
        const GlossySide* const side =
            sources.glossy.empty() ? nullptr : sources.glossy.find(root, back);
        int bin = 0;
        if (side) {
            const glm::dvec3 above = direction * (cosine < 0.0 ? -1.0 : 1.0);
            bin =
                bin_at(square_of_direction(glm::vec3(above * bin_frame(normal))), side->bin_level);
        }
        const std::uint32_t first =
            patches.roots[root].first_leaf + (back ? patches.leaf_count : 0);
        for (std::uint32_t p = first; p < first + patches.leaves_of(root); ++p) {
            const std::uint32_t slot = slot_of_patch(p, patches.leaf_count);
            if (!(transfer.residual()->arrived(slot).coverage > 0.0f))
                guess(p, side ? given_elements[side->element(bin, p)]
                              : std::numbers::inv_pi_v<float> * given_irradiance[p]);
            const Spectrum mean = transfer.residual()->arrived(slot).radiance;
            irradiance[p] += SpectrumSum(twice_cosine * mean);
            if (side)
                glossy[side->element(bin, p)] +=
                    twice_cosine * static_cast<float>(side->bins()) * mean;
        }
    }

    /// Patches that are small or seen edge-on may lie between all pixels' centres.
    /// \param known where there is no sample nearby
    void guess(std::uint32_t patch, const Spectrum& known) {
        const std::uint32_t leaf = patches.leaf_of_patch(patch);
        const auto [corners, level] = leaf_corners(patches, leaf);
        const glm::vec2 b = glm::vec2(corners[0] + corners[1] + corners[2]) /
                            (3.0f * static_cast<float>(1 << level));
        const SurfaceSide centre{patches.root_of_leaf[leaf], patches.is_back(patch), b.x, b.y,
                                 leaf_centre(mesh, patches, leaf)};
        const std::uint32_t slot = slot_of_patch(patch, patches.leaf_count);
        transfer.residual()->assume(slot, known);
        transfer.residual()->assume(slot, transfer.residual()->incoming(centre));
    }

    std::span<const Spectrum> given_irradiance, given_elements;
    const SurfaceMesh& mesh;
    const PatchHierarchy& patches;
    const PatchSources& sources;
    const Workers& workers;
    Exchange exchange;
    FiniteElementComponent elements;
    BundleTransfer transfer;
    glm::dvec3 direction{0.0, 0.0, 1.0};
    std::uint64_t bundles = 0, remembered = 0;
    /// Sums over the bundles remembered. Double: of the many terms; bins get few each.
    std::vector<SpectrumSum> irradiance;
    std::vector<Spectrum> glossy;
};

BundleLight::BundleLight(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                         const PatchSources& sources, std::span<const Spectrum> irradiance,
                         std::span<const Spectrum> glossy_elements,
                         const BundleLightOptions& options, const Workers& workers)
    : state_(std::make_unique<State>(mesh, patches, sources, irradiance, glossy_elements, options,
                                     workers)) {}
BundleLight::~BundleLight() = default;
BundleLight::BundleLight(BundleLight&&) noexcept = default;
BundleLight& BundleLight::operator=(BundleLight&&) noexcept = default;

void BundleLight::next() {
    state_->next();
}

std::uint64_t BundleLight::bundles() const {
    return state_->bundles;
}

glm::dvec3 BundleLight::direction() const {
    return state_->direction;
}

Spectrum BundleLight::incoming(const SurfaceSide& point) const {
    return state_->transfer.residual()->incoming(point);
}

Spectrum BundleLight::incoming_of_cell(std::uint32_t cell_patch) const {
    return state_->transfer.residual()->incoming_of_cell(cell_patch);
}

Spectrum BundleLight::mean_incoming(std::uint32_t patch) const {
    return state_->transfer.residual()
        ->arrived(slot_of_patch(patch, state_->patches.leaf_count))
        .radiance;
}

const PatchHierarchy& BundleLight::cells() const {
    return state_->transfer.residual()->cells();
}

BundleLight::Projected BundleLight::projected() const {
    Projected p;
    const double share = 1.0 / static_cast<double>(std::max<std::uint64_t>(1, state_->remembered));
    for (const SpectrumSum& sum : state_->irradiance)
        p.irradiance.emplace_back(std::numbers::pi * share * sum);
    for (const Spectrum& sum : state_->glossy)
        p.glossy_elements.push_back(static_cast<float>(share) * sum);
    return p;
}

void BundleLight::forget_projected() {
    state_->remembered = 0;
    std::ranges::fill(state_->irradiance, SpectrumSum(0.0));
    std::ranges::fill(state_->glossy, Spectrum(0.0f));
}

}  // namespace transillum
