#include "quantities.h"

#include <fmt/format.h>

namespace transillum::viewer {

namespace {

constexpr const char* radiance_unit = "W sr^-1 m^-2";

std::string rgb(const Spectrum& s) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", s.x, s.y, s.z);
}

}  // namespace

std::vector<Quantity> quantities_of(const Solution& s) {
    const auto of_spectra = [](const std::vector<Spectrum>& values) {
        return [&values](std::uint32_t p) { return luminance(SpectrumSum(values[p])); };
    };
    const auto of_floats = [](const std::vector<float>& values) {
        return [&values](std::uint32_t p) { return double{values[p]}; };
    };
    std::vector<Quantity> all{
        {"total radiance", radiance_unit, true, {}, {}},
        {"emission", radiance_unit, true, {true, false, false, false}, {}},
        {"direct radiance", radiance_unit, true, {false, true, false, false}, {}},
        {"finite-element radiance", radiance_unit, true, {false, false, true, false}, {}},
        {"direct irradiance", "W m^-2", false, {}, of_spectra(s.direct_irradiance)},
        {"indirect irradiance", "W m^-2", false, {}, of_spectra(s.indirect_irradiance)},
        {"level",
         "",
         false,
         {},
         [&s](std::uint32_t p) {
             return double(s.patches.level_of_leaf(s.patches.leaf_of_patch(p)));
         }},
        {"standard error", radiance_unit, false, {}, of_spectra(s.standard_error)}};
    if (!s.spatial_error.empty()) {
        all.push_back(
            {"V_s, spatial error", "W^2 sr^-2 m^-4", false, {}, of_floats(s.spatial_error)});
        all.push_back({"V_d, directional error",
                       "W^2 sr^-2 m^-4",
                       false,
                       {},
                       of_floats(s.directional_error)});
    }
    return all;
}

std::string describe_patch(const Solution& s, std::uint32_t patch) {
    const std::uint32_t leaf = s.patches.leaf_of_patch(patch);
    const RootTriangle& root = s.surface.triangles[s.patches.root_of_leaf[leaf]];
    return fmt::format(
        "patch {} ({}), level {}\nobject {}, face {}, material {}\n"
        "emission {}\ndirect radiance {}\nfinite-element radiance {}\nstandard error {}\n"
        "direct irradiance {}\nindirect irradiance {}",
        patch, s.patches.is_back(patch) ? "back" : "front", s.patches.level_of_leaf(leaf),
        s.surface.objects[root.object], root.source_face, s.surface.materials[root.material].name,
        rgb(s.emission(patch)), rgb(s.direct_radiance(patch)),
        rgb(s.finite_element_radiance(patch)), rgb(s.standard_error[patch]),
        rgb(s.direct_irradiance[patch]), rgb(s.indirect_irradiance[patch]));
}

}  // namespace transillum::viewer
