#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>

#include <vtkNew.h>
#include <vtkPoints.h>

#include <cmath>

namespace transillum {

namespace {

constexpr std::uint32_t most_emitters = 1 << 20;

/// Calls `each(array name, member, number of values)`.
template <class Each>
void for_light_members(const Solution& solution, Each each) {
    const std::size_t patches = solution.patches.patch_count();
    each("IndirectIrradiance", &EmitterPart::indirect_irradiance, patches);
    each("StandardError", &EmitterPart::standard_error, patches);
    each("GlossyElements", &EmitterPart::glossy_elements, solution.glossy.element_count);
}

template <class Each>
void for_fluxes(Each each) {
    each("EnergyEmitted", &EnergyBalance::emitted);
    each("EnergyEntered", &EnergyBalance::entered);
    each("EnergyAbsorbed", &EnergyBalance::absorbed);
    each("EnergyEscaped", &EnergyBalance::escaped);
    each("EnergyBlackBacks", &EnergyBalance::black_backs);
}

void require(bool holds, const Path& file, const std::string& what) {
    if (!holds) throw InputError(file.string(), what);
}

bool is_finite_light(const Spectrum& s) {
    for (int c = 0; c < channel_count; ++c)
        if (!(s[c] >= 0.0f) || !std::isfinite(s[c])) return false;
    return true;
}

std::size_t count_of(const Solution& s, Emitter::Kind kind) {
    switch (kind) {
        case Emitter::Kind::material:
            return s.surface.materials.size();
        case Emitter::Kind::light:
            return s.lighting.lights.size();
        case Emitter::Kind::environment:
            return s.lighting.environment.shines() ? 1 : 0;
    }
    return 0;
}

}  // namespace

std::string emitter_piece_name(std::size_t number) {
    const std::string digits = std::to_string(number + 1);
    return "emitter-" + std::string(digits.size() < 2 ? 1 : 0, '0') + digits;
}

PolyData emitter_piece(const EmitterSolution& solution, std::size_t number) {
    const EmitterPart& part = solution.parts[number];
    auto piece = PolyData::New();
    piece->SetPoints(vtkNew<vtkPoints>());  // VTK cannot read a file without
    vtkFieldData& fields = *piece->GetFieldData();
    add_strings(fields, "SceneHash", {solution.all.scene_hash});
    add_strings(fields, "Name", {part.emitter.name});
    add_value(fields, "EmitterCount", static_cast<std::uint32_t>(solution.parts.size()));
    add_value(fields, "Kind", static_cast<std::uint8_t>(part.emitter.kind));
    add_value(fields, "Index", part.emitter.index);
    add_value(fields, "RelativeError", part.relative_error);
    for_fluxes([&](const char* name, auto flux) { add_value(fields, name, part.balance.*flux); });
    for_light_members(solution.all, [&](const char* name, auto member, std::size_t) {
        add_array(fields, name, (part.*member).size(),
                  [&](std::size_t i) { return (part.*member)[i]; });
    });
    return piece;
}

std::size_t read_emitter_count(vtkPolyData& piece, const Path& file) {
    const auto count =
        ArrayReader{*piece.GetFieldData(), file}.read_value<std::uint32_t>("EmitterCount");
    require(count > 0 && count <= most_emitters, file,
            "array 'EmitterCount': " + std::to_string(count));
    return count;
}

void read_emitter_piece(vtkPolyData& piece, const Path& file, EmitterSolution& solution) {
    const ArrayReader reader{*piece.GetFieldData(), file};
    require(reader.read_strings("SceneHash", 1)[0] == solution.all.scene_hash, file,
            "array 'SceneHash': the light is of another scene");
    EmitterPart part;
    part.emitter.name = reader.read_strings("Name", 1)[0];
    const auto kind = reader.read_value<std::uint8_t>("Kind");
    require(kind <= 2, file, "array 'Kind': " + std::to_string(kind) + "; accepted: 0 to 2");
    part.emitter.kind = static_cast<Emitter::Kind>(kind);
    part.emitter.index = reader.read_value<std::uint32_t>("Index");
    require(part.emitter.index < count_of(solution.all, part.emitter.kind), file,
            "array 'Index': there is no number " + std::to_string(part.emitter.index));
    part.relative_error = reader.read_value<double>("RelativeError");
    require(std::isfinite(part.relative_error) && part.relative_error >= 0.0, file,
            "array 'RelativeError' is not a finite number of at least 0");
    for_fluxes([&](const char* name, auto flux) {
        part.balance.*flux = reader.read_value<SpectrumSum>(name);
    });
    for_light_members(solution.all, [&](const char* name, auto member, std::size_t count) {
        part.*member = reader.read<Spectrum>(name, count);
        for (std::size_t i = 0; i < count; ++i)
            require(is_finite_light((part.*member)[i]), file,
                    std::string("array '") + name + "', entry " + std::to_string(i) +
                        " is not a finite number of at least 0");
    });
    solution.parts.push_back(std::move(part));
}

}  // namespace transillum
