/// Which emitters get a first shot, and the points that stand for them (paper §4). Lights without
/// extent always do: no direction of the iteration would meet them.
#pragma once

#include <transillum/first_shot/direct_light.h>
#include <transillum/geometry/surface_mesh.h>

#include <cstdint>
#include <vector>

namespace transillum {

enum class FirstShot {
    automatic,  ///< small luminaires; large ones are cheaper in the iteration
    off,        ///< none: all light of surfaces travels by iteration
    hemicube,   ///< every emitter
    vectors     ///< every emitter, kept as light vectors
};

struct LightSampleOptions {
    FirstShot first_shot = FirstShot::automatic;
    int samples = 0;  ///< a luminaire [1, 4096]; 0: chosen from how many luminaires there are
    double large_emitter =
        0.05;  ///< share of the scene's surface from which a luminaire counts as large
    std::uint64_t seed = 1;
};

/// Emitting root sides that touch each other and share a material form a luminaire. Samples are
/// stratified over its area; each stands for an equal piece of it. A light without extent has one
/// sample; those come last. A light vector has one colour: a luminaire along which a texture's
/// emission varies gets one for every run of samples that emit alike.
struct Luminaires {
    std::uint32_t count = 0, shot = 0;  ///< all, and those with samples
    double largest_share = 0.0;         ///< of the scene's surface, among those without samples
    std::vector<LightSample> samples;
    std::vector<std::uint32_t> first_samples;  ///< for light vectors, see DirectLight; else empty
    std::vector<std::uint8_t> shot_sides;      ///< see DirectLight
    std::vector<PunctualLight> lights;         ///< as given: what LightSample::light counts into
    std::uint64_t seed = 1;                    ///< as given, for turning the hemicubes
};

/// \throws UsageError for a count outside its range.
[[nodiscard]] Luminaires sample_luminaires(const SurfaceMesh& mesh,
                                           const LightSampleOptions& options,
                                           const std::vector<PunctualLight>& lights = {});

/// Sets what samples send anew, of emitters and lights that are where they were.
void relight_samples(const SurfaceMesh& mesh, const std::vector<PunctualLight>& lights,
                     std::vector<LightSample>& samples);

/// Memory [bytes] that a first shot's tables will take on so many patches, one way and the other.
[[nodiscard]] std::uint64_t sample_table_bytes(std::size_t samples, std::uint64_t patches);
[[nodiscard]] std::uint64_t light_vector_bytes(std::size_t vectors, std::uint64_t patches);
/// As `luminaires` is going to be kept.
[[nodiscard]] std::uint64_t first_shot_bytes(const Luminaires& luminaires, std::uint64_t patches);

}  // namespace transillum
