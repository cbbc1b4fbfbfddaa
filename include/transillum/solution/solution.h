/// A baked solution: everything needed to look at it again, without the scene file.
#pragma once

#include <transillum/base/spectrum.h>
#include <transillum/first_shot/direct_light.h>
#include <transillum/geometry/patch_hierarchy.h>
#include <transillum/geometry/surface_mesh.h>
#include <transillum/scene/lighting.h>
#include <transillum/transport/glossy_sides.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace transillum {

/// A part of the method that was left out or chosen for the user, and why.
struct Decision {
    std::string what;
    std::string why;
};

/// Total flux [W] (radiance unit * sr * square scene units) by where it went.
struct EnergyBalance {
    SpectrumSum emitted{0.0};   ///< by all emitters
    SpectrumSum entered{0.0};   ///< from the environment and lights without extent
    SpectrumSum absorbed{0.0};  ///< by patches
    SpectrumSum escaped{0.0};   ///< out of the scene (estimate of the iteration and the first shot)
    SpectrumSum black_backs{
        0.0};  ///< met the back of a one-sided surface: a mesh wound inside out, or a leak
};

struct IterationSums;

/// What a bake needs to go on, beside the solution that it has come to.
struct Continuation {
    std::shared_ptr<const IterationSums> sums;
    EnergyBalance first_shot;  ///< of its light alone, with what sides received that aren't stored
};

struct Solution {
    SurfaceMesh surface;
    PatchHierarchy patches;
    DirectLight direct;
    GlossySides glossy;
    Lighting lighting;  ///< what `direct` samples beside the surface, and the environment
    std::vector<Camera> cameras;

    /// Means of textures, one a leaf; empty where no material in use has such a texture.
    std::vector<Spectrum> leaf_diffuse, leaf_emission;

    // One a patch (PatchHierarchy: fronts, then backs). Sides that neither reflect nor emit hold
    // zeros.
    std::vector<Spectrum> direct_irradiance;    ///< by first shot [W m^-2]
    std::vector<Spectrum> indirect_irradiance;  ///< by the iteration [W m^-2]
    std::vector<Spectrum> standard_error;       ///< of the finite-element radiance [W sr^-1 m^-2]
    /// V_s and V_d of the Monte-Carlo component [W^2 sr^-2 m^-4] (see TransportResult). May be
    /// empty.
    std::vector<float> spatial_error, directional_error;
    std::vector<float> coverage;            ///< fragments seen, summed over directions
    std::vector<Spectrum> glossy_elements;  ///< as glossy_sides.h lays them out

    std::uint64_t iterations = 0;  ///< directions transferred, each both ways
    std::uint64_t seed = 0;
    double relative_error = 0.0;  ///< estimated: root of the area-weighted mean squared error of
                                  ///< the indirect irradiance, over its mean
    bool interrupted = false;     ///< stopped by the user before any criterion was met
    EnergyBalance balance;
    std::vector<Decision> decisions;  ///< what was skipped or chosen, with the reason
    /// Options the result depends on, by name (never thread count, file names or times).
    std::vector<std::pair<std::string, std::string>> settings;
    std::string scene_hash;  ///< of the geometry and materials that were baked, hexadecimal
    std::shared_ptr<const Continuation> continuation;  ///< null unless it was kept, and loaded

    [[nodiscard]] const Material& material_of(std::uint32_t patch) const {
        return surface.materials
            [surface.triangles[patches.root_of_leaf[patches.leaf_of_patch(patch)]].material];
    }
    /// False for the black back of a one-sided surface.
    [[nodiscard]] bool reflects(std::uint32_t patch) const {
        return !patches.is_back(patch) || material_of(patch).back_reflects;
    }
    [[nodiscard]] bool emits(std::uint32_t patch) const {
        const Material& m = material_of(patch);
        return m.emits() && (!patches.is_back(patch) || m.back_emits);
    }
    /// Emitted radiance [W sr^-1 m^-2].
    [[nodiscard]] Spectrum emission(std::uint32_t patch) const {
        if (!emits(patch)) return Spectrum(0.0f);
        return leaf_emission.empty() ? material_of(patch).emission
                                     : leaf_emission[patches.leaf_of_patch(patch)];
    }
    /// Albedo of the Lambert part [1]; 0 for a black back.
    [[nodiscard]] Spectrum diffuse(std::uint32_t patch) const {
        if (!reflects(patch)) return Spectrum(0.0f);
        return leaf_diffuse.empty() ? material_of(patch).diffuse
                                    : leaf_diffuse[patches.leaf_of_patch(patch)];
    }
    /// Null for a patch without a lobe.
    [[nodiscard]] const GlossySide* glossy_side(std::uint32_t patch) const;
    /// Reflected radiance [W sr^-1 m^-2], cosine-weighted mean over outgoing directions: of the
    /// first shot, and of the finite elements.
    [[nodiscard]] Spectrum direct_radiance(std::uint32_t patch) const;
    [[nodiscard]] Spectrum finite_element_radiance(std::uint32_t patch) const;
};

}  // namespace transillum
