#include "transport/glossy_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace transillum {

namespace {

constexpr std::uint32_t leaves_a_chunk = 1024;
/// Leaves whose radiance and sums are worked on row by row while they are in cache.
constexpr std::uint32_t strip = 64;

}  // namespace

GlossyElements::GlossyElements(const SurfaceMesh& mesh, const PatchHierarchy& patches,
                               const PatchSources& sources, const Workers& workers)
    : sources_(sources),
      sides_(sources.glossy.sides),
      patches_(patches),
      workers_(workers),
      sums_(sources.glossy.element_count),
      incoming_(sources.glossy.element_count) {
    std::uint32_t glossy_patches = 0;
    for (std::uint32_t i = 0; i < sides_.size(); ++i) {
        const GlossySide& s = sides_[i];
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
            largest_source_ = std::max(largest_source_, direct_peak(s, p));
    if (sources.directional_emission) sample_emission();
}

/// Over equal projected solid angles.
void GlossyElements::sample_emission() {
    constexpr int tried = 32;
    float peak = 0.0f;
    for (const GlossySide& s : sides_) {
        SpectrumSum sum(0.0);
        for (int y = 0; y < tried; ++y)
            for (int x = 0; x < tried; ++x) {
                const glm::vec2 square = (glm::vec2(x, y) + 0.5f) / static_cast<float>(tried);
                const Spectrum emitted =
                    sources_.directional_emission(s, direction_of_square(square));
                peak = std::max(peak, max_channel(emitted));
                sum += SpectrumSum(emitted);
            }
        mean_emission_.emplace_back(sum / double{tried * tried});
    }
    largest_source_ += 2.0f * peak;  // a peak between the samples may be higher
}

const GlossySide* GlossyElements::side_of(std::uint32_t patch) const {
    if (sides_.empty()) return nullptr;
    const std::uint32_t root = patches_.root_of_leaf[patches_.leaf_of_patch(patch)];
    return sources_.glossy.find(root, patches_.is_back(patch));
}

/// Of the bundle's direction and its opposite, the one above the side.
glm::vec3 GlossyElements::direction_above(std::uint32_t side, const Bundle& bundle) const {
    const glm::vec3 d = local_from_world_[side] * glm::vec3(bundle.frame[2]);
    return d.z < 0.0f ? -d : d;
}

Spectrum GlossyElements::ratio(std::uint64_t element, const Spectrum& fallback) const {
    const Sum s = sums_[element];
    return s[3] > 0.0f ? glm::max(Spectrum(s[0], s[1], s[2]) / s[3], Spectrum(0.0f)) : fallback;
}

float GlossyElements::direct_peak(const GlossySide& side, std::uint32_t patch) const {
    if (sources_.first_incoming.empty()) return 0.0f;
    Spectrum sum(0.0f);
    for (std::uint32_t i = sources_.first_incoming[patch]; i < sources_.first_incoming[patch + 1];
         ++i) {
        const IncomingLight& l = sources_.incoming[i];
        const Brdf f = widened(brdf(side), l.solid_angle);
        sum += l.irradiance * (2.0f * evaluate_lobe(f, l.direction, mirrored(l.direction)) +
                               sources_.albedo[patch]);
    }
    return max_channel(sum);
}

Spectrum GlossyElements::direct_towards(const GlossySide& side, std::uint32_t patch,
                                        const glm::vec3& out, float coupling) const {
    const Brdf& f = brdf(side);
    const Spectrum lambert = sources_.albedo[patch] * coupling;
    Spectrum sum(0.0f);
    for (std::uint32_t i = sources_.first_incoming[patch]; i < sources_.first_incoming[patch + 1];
         ++i) {
        const IncomingLight& l = sources_.incoming[i];
        sum += l.irradiance * (lambert * diffuse_coupling(f, l.direction.z) +
                               evaluate_lobe(widened(f, l.solid_angle), l.direction, out));
    }
    return sum;
}

float GlossyElements::update_incoming(const std::vector<Spectrum>& fallback) {
    std::vector<float> largest(chunks_.size());
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        float most = 0.0f;
        for (int bin = 0; bin < s.bins(); ++bin)
            for (std::uint32_t p = s.first_patch + c.begin; p < s.first_patch + c.end; ++p) {
                const std::uint64_t e = s.element(bin, p);
                const Spectrum x = feeds_back_ ? ratio(e, fallback[p]) : Spectrum(0.0f);
                incoming_[e] = Sum{x.x, x.y, x.z, 0.0f};
                most = std::max(most, max_channel(sources_.emission[p]) + max_channel(x));
            }
        largest[&c - chunks_.data()] = most;
    });
    float most = 0.0f;
    for (const float x : largest) most = std::max(most, x);
    // Both lobes together reflect no more than comes in from the brightest bin.
    return most + largest_source_;
}

void GlossyElements::send(Exchange& exchange, const Bundle& bundle) const {
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        const glm::vec3 d = direction_above(c.side, bundle);
        const ProjectedBrdf& projection = projected(s);
        const auto bins = static_cast<std::size_t>(s.bins());
        std::array<float, bin_count(max_bin_level)> shares, coupled;
        projection.shares(d, std::span(shares).first(bins));
        // The Lambert part sees the bins by their coupling.
        float all = 0.0f;
        for (std::size_t k = 0; k < bins; ++k)
            all += coupled[k] = projection.coupling(static_cast<int>(k));
        const float towards = diffuse_coupling(brdf(s), d.z) / all;
        const Spectrum lobe = lobe_albedo(brdf(s), d.z);
        const Spectrum emission =
            sources_.directional_emission ? sources_.directional_emission(s, d) : Spectrum(0.0f);
        const bool has_direct = !sources_.first_incoming.empty();
        const float coupling = diffuse_coupling(brdf(s), d.z) /
                               (std::numbers::pi_v<float> * mean_diffuse_coupling(brdf(s)));

        std::array<Sum, strip> by_lobe, by_lambert;
        for (std::uint32_t begin = c.begin; begin < c.end; begin += strip) {
            const std::uint32_t count = std::min(strip, c.end - begin);
            std::fill_n(by_lobe.begin(), count, Sum{});
            std::fill_n(by_lambert.begin(), count, Sum{});
            for (std::size_t k = 0; k < bins; ++k) {
                const Sum* const x = incoming_.data() + s.first_element + k * s.leaf_count + begin;
                for (std::uint32_t i = 0; i < count; ++i) {
                    by_lobe[i] += shares[k] * x[i];
                    by_lambert[i] += coupled[k] * x[i];
                }
            }
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t p = s.first_patch + begin + i;
                const Sum g = by_lobe[i], l = towards * by_lambert[i];
                Spectrum sent = sources_.emission[p] + emission +
                                lobe * Spectrum(g[0], g[1], g[2]) +
                                sources_.albedo[p] * Spectrum(l[0], l[1], l[2]);
                if (has_direct) sent += direct_towards(s, p, d, coupling);
                exchange.set_radiance(p, sent);
            }
        }
    });
}

void GlossyElements::receive(Exchange& exchange, const Bundle& bundle, double weight) {
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        const glm::vec3 d = direction_above(c.side, bundle);
        const int bin = bin_at(square_of_direction(d), s.bin_level);
        const auto w = static_cast<float>(weight);
        for (std::uint32_t leaf = c.begin; leaf < c.end; ++leaf) {
            const std::uint32_t p = s.first_patch + leaf;
            const Received r = exchange.take(p);
            Received& sum = block_[first_glossy_patch_[c.side] + leaf];
            sum.radiance += r.radiance;
            sum.coverage += r.coverage;
            const Spectrum radiance(r.radiance);
            sums_[s.element(bin, p)] +=
                w * Sum{radiance.x, radiance.y, radiance.z, static_cast<float>(r.coverage)};
        }
    });
}

Received GlossyElements::take(std::uint32_t patch) {
    const GlossySide& s = *side_of(patch);
    return std::exchange(block_[first_glossy_patch_[number_of(s)] + patch - s.first_patch], {});
}

SpectrumSum GlossyElements::incoming(std::uint32_t patch, const Spectrum& fallback) const {
    const GlossySide& s = *side_of(patch);
    SpectrumSum sum(0.0);
    for (int k = 0; k < s.bins(); ++k) sum += SpectrumSum(ratio(s.element(k, patch), fallback));
    return sum / static_cast<double>(s.bins());
}

SpectrumSum GlossyElements::reflected(std::uint32_t patch, const Spectrum& fallback) const {
    const GlossySide& s = *side_of(patch);
    const ProjectedBrdf& projection = projected(s);
    SpectrumSum by_lobe(0.0), by_lambert(0.0);
    double coupling = 0.0;
    for (int k = 0; k < s.bins(); ++k) {
        const Spectrum x = ratio(s.element(k, patch), fallback);
        by_lobe += SpectrumSum(projection.lobe_albedo(k) * x);
        by_lambert += SpectrumSum(projection.coupling(k) * x);
        coupling += double{projection.coupling(k)};
    }
    const double mean = mean_diffuse_coupling(brdf(s));
    return by_lobe / static_cast<double>(s.bins()) +
           SpectrumSum(sources_.albedo[patch]) * by_lambert * (mean / coupling);
}

Spectrum GlossyElements::mean_emission(std::uint32_t patch) const {
    return mean_emission_.empty() ? Spectrum(0.0f) : mean_emission_[number_of(*side_of(patch))];
}

Spectrum GlossyElements::mean_albedo(std::uint32_t patch) const {
    Brdf f = brdf(*side_of(patch));
    f.diffuse = sources_.albedo[patch];
    return transillum::mean_albedo(f);
}

template <class Body>
void GlossyElements::for_bins(std::uint32_t patch, Body body) {
    const GlossySide& s = *side_of(patch);
    for (int k = 0; k < s.bins(); ++k) body(sums_[s.element(k, patch)]);
}

void GlossyElements::scale_incoming(std::uint32_t patch, const SpectrumSum& factor) {
    const Spectrum f(factor);
    for_bins(patch, [&](Sum& s) { s *= Sum{f.x, f.y, f.z, 1.0f}; });
}

void GlossyElements::set_incoming(std::uint32_t patch, const SpectrumSum& incoming) {
    const Spectrum x(incoming);
    for_bins(patch, [&](Sum& s) { s = s[3] * Sum{x.x, x.y, x.z, 1.0f}; });
}

void GlossyElements::restore(std::span<const Spectrum> values) {
    for (std::size_t i = 0; i < sums_.size(); ++i)
        sums_[i] = Sum{values[i].x, values[i].y, values[i].z, 1.0f};
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

std::vector<Spectrum> GlossyElements::values(const std::vector<Spectrum>& fallback) const {
    std::vector<Spectrum> values(sums_.size());
    for_chunks([&](const Chunk& c) {
        const GlossySide& s = sides_[c.side];
        for (int k = 0; k < s.bins(); ++k)
            for (std::uint32_t p = s.first_patch + c.begin; p < s.first_patch + c.end; ++p)
                values[s.element(k, p)] = ratio(s.element(k, p), fallback[p]);
    });
    return values;
}

}  // namespace transillum
