#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>
#include <transillum/solution/save_solution.h>

namespace transillum {

namespace {

/// The first or second members of pairs.
template <class Pair, class Member>
std::vector<std::string> column(const std::vector<Pair>& pairs, Member Pair::*member) {
    std::vector<std::string> values;
    for (const Pair& pair : pairs) values.push_back(pair.*member);
    return values;
}

template <class Pair>
std::vector<Pair> read_pairs(const ArrayReader& reader, const char* first, const char* second) {
    const auto firsts = reader.read_strings(first);
    const auto seconds = reader.read_strings(second, firsts.size());
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < firsts.size(); ++i) pairs.push_back({firsts[i], seconds[i]});
    return pairs;
}

void add_units(vtkFieldData& fields) {
    add_strings(
        fields, "Units",
        {"radiance, emission, standard error: W sr^-1 m^-2", "irradiance: W m^-2",
         "projected solid angle: sr", "energy: W, with radiance and lengths as in the scene",
         "lengths and areas: scene units"});
}

}  // namespace

void add_summary(const Solution& solution, vtkFieldData& fields) {
    add_value(fields, "FormatVersion", std::int32_t{solution_format_version});
    add_strings(fields, "ProgramVersion", {TRANSILLUM_VERSION});
    add_units(fields);
    add_value(fields, "Iterations", solution.iterations);
    add_value(fields, "Seed", solution.seed);
    add_value(fields, "RelativeError", solution.relative_error);
    add_value(fields, "Interrupted", std::uint8_t{solution.interrupted});
    add_value(fields, "EnergyEmitted", solution.balance.emitted);
    add_value(fields, "EnergyEntered", solution.balance.entered);
    add_value(fields, "EnergyAbsorbed", solution.balance.absorbed);
    add_value(fields, "EnergyEscaped", solution.balance.escaped);
    add_value(fields, "EnergyBlackBacks", solution.balance.black_backs);
    add_strings(fields, "DecisionWhat", column(solution.decisions, &Decision::what));
    add_strings(fields, "DecisionWhy", column(solution.decisions, &Decision::why));
    using Setting = std::pair<std::string, std::string>;
    add_strings(fields, "SettingName", column(solution.settings, &Setting::first));
    add_strings(fields, "SettingValue", column(solution.settings, &Setting::second));
    add_strings(fields, "SceneHash", {solution.scene_hash});
}

void read_summary(vtkFieldData& fields, const Path& file, Solution& solution) {
    const ArrayReader reader{fields, file};
    const auto format = reader.read_value<std::int32_t>("FormatVersion");
    if (format != solution_format_version) {
        throw InputError(file.string(), "format " + std::to_string(format) + ", expected " +
                                            std::to_string(solution_format_version));
    }
    solution.iterations = reader.read_value<std::uint64_t>("Iterations");
    solution.seed = reader.read_value<std::uint64_t>("Seed");
    solution.relative_error = reader.read_value<double>("RelativeError");
    solution.interrupted = reader.read_flags("Interrupted", 1)[0] != 0;
    solution.balance.emitted = reader.read_value<SpectrumSum>("EnergyEmitted");
    solution.balance.entered = reader.read_value<SpectrumSum>("EnergyEntered");
    solution.balance.absorbed = reader.read_value<SpectrumSum>("EnergyAbsorbed");
    solution.balance.escaped = reader.read_value<SpectrumSum>("EnergyEscaped");
    solution.balance.black_backs = reader.read_value<SpectrumSum>("EnergyBlackBacks");
    solution.decisions = read_pairs<Decision>(reader, "DecisionWhat", "DecisionWhy");
    solution.settings =
        read_pairs<std::pair<std::string, std::string>>(reader, "SettingName", "SettingValue");
    solution.scene_hash = reader.read_strings("SceneHash", 1)[0];
}

}  // namespace transillum
