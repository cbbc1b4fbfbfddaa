/// Direct light of small emitters, kept as incoming radiance (paper §4, "incoming first shot") or
/// as light vectors (its other possibility), and of lights without extent.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/scene/lighting.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace transillum {

/// A point that stands for a piece of an emitter, or a light without extent.
struct LightSample {
    enum class Kind : std::uint8_t {
        area,        ///< a piece of an emitting surface
        point,       ///< a point or spot light, with or without photometry
        directional  ///< a light from infinitely far
    };
    glm::dvec3 position{0.0};          ///< directional: no meaning
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit; area: light leaves on this side; point: the axis;
                                       ///< directional: the way light travels
    double area = 0.0;                 ///< of the piece [square scene units]; else 0
    /// area: emitted radiance [W sr^-1 m^-2]; point: PunctualLight::intensity [W sr^-1];
    /// directional: irradiance of a surface that faces it [W m^-2]
    Spectrum emitted{0.0f};
    std::uint32_t root = 0;  ///< area: root triangle it lies on
    bool back = false;       ///< area: it lies on that triangle's back
    Kind kind = Kind::area;
    std::uint32_t light = 0;  ///< else: index into Lighting::lights
};

/// What arrives at the patches from the light samples, in one of two ways; both row-major, one row
/// a patch.
///   A column a sample: entry [patch * samples.size() + sample] of two tables.
///   Irradiance of a patch = sum over samples of emitted * visibility * geometry_factor.
///   A column a luminaire: entry [patch * first_samples.size() + luminaire] of `vectors`.
///   Irradiance of a patch = sum over luminaires of emitted * length of the vector.
struct DirectLight {
    std::vector<LightSample> samples;  ///< empty where no emitter needs a first shot
    /// Of each luminaire, the first of its samples, which all emit alike: ascending from 0. Empty
    /// unless it is kept as light vectors.
    std::vector<std::uint32_t> first_samples;
    /// Points to where the luminaire's light comes from, the mean over its samples by what they
    /// bring; as long as their visibility * geometry_factor together.
    std::vector<glm::vec3> vectors;
    /// Patch mean, as if unoccluded, of, cos at the sample, cos' at the patch:
    /// area: area * cos * cos' / r^2, the projected solid angle [sr];
    /// point: PunctualLight::distribution * cos' / r^2 [sr / square scene unit];
    /// directional: cos' [1].
    /// Close to emitting surfaces, bounded: what they fill together is at most pi.
    std::vector<float> geometry_factor;
    std::vector<float> visibility;  ///< seen share of that [0, 1]
    /// Per root triangle and side (2 * root + back): its emission travels by first shot, so the
    /// iteration leaves it out.
    std::vector<std::uint8_t> shot_sides;

    /// Edge of a pixel of the views that found the visibility, 0 where that is unknown: at distance
    /// 1, and of directional lights' [scene units].
    double view_pixel = 0.0, parallel_pixel = 0.0;

    [[nodiscard]] bool has_vectors() const { return !first_samples.empty(); }
    [[nodiscard]] std::size_t columns() const {
        return has_vectors() ? first_samples.size() : samples.size();
    }
    /// The column's sample; a luminaire's first, for the kind and emission that all share.
    [[nodiscard]] const LightSample& light(std::size_t column) const {
        return samples[has_vectors() ? first_samples[column] : column];
    }
    /// Where the column's samples begin and end.
    [[nodiscard]] std::pair<std::size_t, std::size_t> samples_of(std::size_t column) const;
    /// Irradiance of a patch by what a column emits.
    [[nodiscard]] double share(std::size_t patch, std::size_t column) const;
    void scale(std::size_t patch, std::size_t column, double factor);
    /// Where a column's light comes from, seen from a point of the patch. Not unit.
    [[nodiscard]] glm::dvec3 direction(std::size_t patch, std::size_t column,
                                       const glm::dvec3& point) const;
};

/// From a point to a light sample; not unit.
[[nodiscard]] glm::dvec3 way_to_light(const LightSample& sample, const glm::dvec3& point);

/// What a light sample sends to a point, as if unoccluded.
struct Incident {
    glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit, to the light
    double distance = 0.0;                ///< to the light; infinite: directional
    Spectrum irradiance{0.0f};  ///< of a surface at the point that faces the light [W m^-2]
};

/// Nothing comes from an area sample behind it, nor to the very place of a light.
/// \pre the sample's light is one of `lighting`.
[[nodiscard]] Incident incident_light(const LightSample& sample, const Lighting& lighting,
                                      const glm::dvec3& point);

}  // namespace transillum
