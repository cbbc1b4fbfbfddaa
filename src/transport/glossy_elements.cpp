#include "transport/glossy_elements.h"

#include <algorithm>
#include <map>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t leaves_a_chunk = 1024;
/// Leaves whose radiance and sums are worked on row by row while they are in cache.
constexpr std::uint32_t strip = 64;

glm::vec3 mirrored(const glm::vec3& d) {
    return {-d.x, -d.y, d.z};
}

}  // namespace

GlossyElements::GlossyElements(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               const PatchSources& sources, const Workers& workers)
    : sources_(sources),
      sides_(sources.glossy.sides),
      patches_(patches),
      workers_(workers),
      sums_(sources.glossy.element_count),
      radiance_(sources.glossy.element_count) {
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> known;
    std::uint32_t glossy_patches = 0;
    for (std::uint32_t i = 0; i < sides_.size(); ++i) {
        const GlossySide& s = sides_[i];
        const auto [at, is_new] =
            known.try_emplace({s.brdf, s.bin_level}, static_cast<std::uint32_t>(projected_.size()));
        if (is_new) projected_.emplace_back(sources.glossy.brdfs[s.brdf], s.bin_level);
        projected_of_side_.push_back(at->second);
        const glm::dvec3 normal = normal_of(mesh, s.root) * (s.back ? -1.0 : 1.0);
        local_from_world_.emplace_back(glm::transpose(bin_frame(normal)));
        for (std::uint32_t begin = 0; begin < s.leaf_count; begin += leaves_a_chunk)
            chunks_.push_back({i, begin, std::min(begin + leaves_a_chunk, s.leaf_count)});
        first_glossy_patch_.push_back(glossy_patches);
        glossy_patches += s.leaf_count;
    }
    block_.resize(glossy_patches);
    for (const GlossySide& s : sides_)
        for (std::uint32_t p = s.first_patch; p < s.first_patch + s.leaf_count; ++p)
            largest_direct_ = std::max(largest_direct_, direct_peak(s, p));
}

template <class Body>
void GlossyElements::for_chunks(Body body) const {
    constexpr std::size_t grain = 16;
    workers_.for_ranges(chunks_.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t c = begin; c < end; ++c) body(chunks_[c]);
    });
}

const GlossySide* GlossyElements::side_of(std::uint32_t patch) const {
    if (sides_.empty()) return nullptr;
    const std::uint32_t root = patches_.root_of_leaf[patches_.leaf_of_patch(patch)];
    return sources_.glossy.find(root, patches_.is_back(patch));
}

const ProjectedBrdf& GlossyElements::projected(const GlossySide& side) const {
    return projected_[projected_of_side_[&side - sides_.data()]];
}

/// Of the bundle's direction and its opposite, the one above the side.
glm::vec3 GlossyElements::direction_above(std::uint32_t side, const Bundle& bundle) const {
    const glm::vec3 d = local_from_world_[side] * glm::vec3(bundle.frame[2]);
    return d.z < 0.0f ? -d : d;
}

Spectrum GlossyElements::ratio(std::uint64_t element, const Spectrum& fallback) const {
    const Sum s = sums_[element];
    return s[3] > 0.0f ? Spectrum(s[0], s[1], s[2]) / s[3] : fallback;
}

float GlossyElements::direct_peak(const GlossySide& side, std::uint32_t patch) const {
    if (sources_.first_incoming.empty()) return 0.0f;
    const Brdf& brdf = sources_.glossy.brdfs[side.brdf];
    Spectrum sum(0.0f);
    for (std::uint32_t i = sources_.first_incoming[patch]; i < sources_.first_incoming[patch + 1];
         ++i) {
        const IncomingLight& l = sources_.incoming[i];
        sum += l.irradiance * (2.0f * evaluate_lobe(brdf, l.direction, mirrored(l.direction)) +
                               sources_.albedo[patch]);
    }
    return max_channel(sum);
}

Spectrum GlossyElements::direct_towards(const GlossySide& side, std::uint32_t patch,
                                        const glm::vec3& out) const {
    if (sources_.first_incoming.empty()) return Spectrum(0.0f);
    const Brdf& brdf = sources_.glossy.brdfs[side.brdf];
    const Spectrum lambert = sources_.albedo[patch] * diffuse_coupling(brdf, out.z) /
                             (std::numbers::pi_v<float> * mean_diffuse_coupling(brdf));
    Spectrum sum(0.0f);
    for (std::uint32_t i = sources_.first_incoming[patch]; i < sources_.first_incoming[patch + 1];
         ++i) {
        const IncomingLight& l = sources_.incoming[i];
        sum += l.irradiance * (lambert * diffuse_coupling(brdf, l.direction.z) +
                               evaluate_lobe(brdf, l.direction, out));
    }
    return sum;
}

float GlossyElements::update_radiance(const std::vector<Spectrum>& fallback) {
    std::vector<float> largest(chunks_.size());
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        const ProjectedBrdf& projection = projected(s);
        float most = 0.0f;
        for (int row = 0; row < s.row_count(); ++row)
            for (std::uint32_t p = s.first_patch + c.begin; p < s.first_patch + c.end; ++p) {
                const std::uint64_t e = s.element(row, p);
                const Spectrum incoming = ratio(e, fallback[p]);
                Spectrum& r = radiance_[e];
                r = row == 0 ? incoming : projection.lobe_albedo(row - 1) * incoming;
                if (row > 0 && !sources_.element_emission.empty())
                    r += sources_.element_emission[e];
                const Spectrum sent = row == 0 ? sources_.emission[p] + r * sources_.albedo[p] : r;
                most = std::max(most, max_channel(sent));
            }
        largest[&c - chunks_.data()] = most;
    });
    float most = 0.0f;
    for (const float x : largest) most = std::max(most, x);
    // Emission and Lambert part, lobe, and light of the first shot.
    return 2.0f * most + largest_direct_;
}

void GlossyElements::send(Exchange& exchange, const Bundle& bundle) const {
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        const glm::vec3 d = direction_above(c.side, bundle);
        const int row = 1 + bin_at(square_of_direction(d), s.bin_level);
        const float coupling = diffuse_coupling(sources_.glossy.brdfs[s.brdf], d.z);
        for (std::uint32_t p = s.first_patch + c.begin; p < s.first_patch + c.end; ++p) {
            const Spectrum lambert = sources_.albedo[p] * coupling * radiance_[s.element(0, p)];
            exchange.set_radiance(p, sources_.emission[p] + lambert + radiance_[s.element(row, p)] +
                                         direct_towards(s, p, d));
        }
    });
}

void GlossyElements::receive(Exchange& exchange, const Bundle& bundle, double weight) {
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        const glm::vec3 d = direction_above(c.side, bundle);
        std::array<float, most_rows> weights;
        weights[0] = diffuse_coupling(sources_.glossy.brdfs[s.brdf], d.z);
        const auto rows = static_cast<std::size_t>(s.row_count());
        projected(s).lobe_into_bins(d, std::span(weights).subspan(1, rows - 1));
        for (std::size_t row = 0; row < rows; ++row) weights[row] *= static_cast<float>(weight);

        std::array<Sum, strip> arrived;
        for (std::uint32_t begin = c.begin; begin < c.end; begin += strip) {
            const std::uint32_t end = std::min(begin + strip, c.end);
            for (std::uint32_t leaf = begin; leaf < end; ++leaf) {
                const Received r = exchange.take(s.first_patch + leaf);
                Received& sum = block_[first_glossy_patch_[c.side] + leaf];
                sum.radiance += r.radiance;
                sum.coverage += r.coverage;
                const Spectrum radiance(r.radiance);
                arrived[leaf - begin] =
                    Sum{radiance.x, radiance.y, radiance.z, static_cast<float>(r.coverage)};
            }
            for (std::size_t row = 0; row < rows; ++row) {
                Sum* const sums = sums_.data() + s.first_element + row * s.leaf_count + begin;
                for (std::uint32_t i = 0; i < end - begin; ++i)
                    sums[i] += weights[row] * arrived[i];
            }
        }
    });
}

GlossyElements::Place GlossyElements::place_of(std::uint32_t patch) const {
    const GlossySide* const side = side_of(patch);
    return {side, side ? patch - side->first_patch : 0};
}

Received GlossyElements::take(std::uint32_t patch) {
    const Place at = place_of(patch);
    return std::exchange(block_[first_glossy_patch_[at.side - sides_.data()] + at.leaf], {});
}

SpectrumSum GlossyElements::reflected(std::uint32_t patch) const {
    const GlossySide& s = *side_of(patch);
    const ProjectedBrdf& projection = projected(s);
    const Brdf& brdf = sources_.glossy.brdfs[s.brdf];
    SpectrumSum lobe(0.0);
    for (int row = 1; row < s.row_count(); ++row)
        lobe += SpectrumSum(projection.lobe_albedo(row - 1) *
                            ratio(s.element(row, patch), Spectrum(0.0f)));
    const Spectrum lambert = sources_.albedo[patch] * mean_diffuse_coupling(brdf) *
                             ratio(s.element(0, patch), Spectrum(0.0f));
    return SpectrumSum(lambert) + lobe / static_cast<double>(bin_count(s.bin_level));
}

Spectrum GlossyElements::mean_albedo(std::uint32_t patch) const {
    Brdf brdf = sources_.glossy.brdfs[side_of(patch)->brdf];
    brdf.diffuse = sources_.albedo[patch];
    return transillum::mean_albedo(brdf);
}

template <class Body>
void GlossyElements::for_rows(std::uint32_t patch, Body body) {
    const GlossySide& s = *side_of(patch);
    for (int row = 0; row < s.row_count(); ++row) body(sums_[s.element(row, patch)]);
}

void GlossyElements::scale_incoming(std::uint32_t patch, const SpectrumSum& factor) {
    const Spectrum f(factor);
    for_rows(patch, [&](Sum& s) { s *= Sum{f.x, f.y, f.z, 1.0f}; });
}

void GlossyElements::set_incoming(std::uint32_t patch, const SpectrumSum& incoming) {
    const Spectrum x(incoming);
    for_rows(patch, [&](Sum& s) { s = s[3] * Sum{x.x, x.y, x.z, 1.0f}; });
}

void GlossyElements::restart(float prior_weight) {
    earlier_ = sums_;
    for (Sum& s : sums_)
        if (s[3] > 0.0f) s *= prior_weight / s[3];
}

void GlossyElements::recall() {
    for (std::size_t i = 0; i < earlier_.size(); ++i) sums_[i] += earlier_[i];
    forget();
}

void GlossyElements::forget() {
    earlier_ = {};
}

std::vector<Spectrum> GlossyElements::values() const {
    std::vector<Spectrum> values(sums_.size());
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        for (int row = 0; row < s.row_count(); ++row)
            for (std::uint32_t p = s.first_patch + c.begin; p < s.first_patch + c.end; ++p) {
                const std::uint64_t e = s.element(row, p);
                const Spectrum incoming = ratio(e, ratio(s.element(0, p), Spectrum(0.0f)));
                values[e] = row == 0 ? incoming : projected(s).lobe_albedo(row - 1) * incoming;
            }
    });
    return values;
}

}  // namespace transillum
