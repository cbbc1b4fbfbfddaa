#include "cli/bake_output.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <utility>

namespace transillum::cli {

namespace {

struct RelightArguments {
    std::string solution, output;
    std::vector<std::string> factors;  ///< NAME=F or NAME=R,G,B
};

/// \param argument NAME=F or NAME=R,G,B
Spectrum parse_factor(const std::string& argument) {
    const std::size_t equals = argument.rfind('=');
    const std::string text = equals == std::string::npos ? "" : argument.substr(equals + 1);
    std::vector<float> numbers(1);
    const char* at = text.data();
    const char* const last = text.data() + text.size();
    for (;;) {
        const auto [end, error] = std::from_chars(at, last, numbers.back());
        const bool is_number = error == std::errc();
        if (is_number && end == last && numbers.size() == 1) return Spectrum(numbers[0]);
        if (is_number && end == last && numbers.size() == 3)
            return {numbers[0], numbers[1], numbers[2]};
        if (!is_number || *end != ',' || numbers.size() == 3)
            throw UsageError("--emitter " + argument +
                             "; accepted: NAME=FACTOR or NAME=RED,GREEN,BLUE");
        numbers.push_back(0.0f);
        at = end + 1;
    }
}

int run(const RelightArguments& a, const Common& common) {
    Console console(common);
    if (!a.output.ends_with(".vtm"))
        throw UsageError("--output " + a.output + "; accepted: a name that ends in .vtm");
    EmitterSolution solution = load_emitter_solution(a.solution);
    require_writable(a.output);
    for (const EmitterPart& part : solution.parts) console.note("emitter " + part.emitter.name);
    for (const std::string& argument : a.factors) {
        const Spectrum factor = parse_factor(argument);
        scale_emitter(solution, argument.substr(0, argument.rfind('=')), factor);
    }
    RunRecord record = load_run_record(a.solution);
    record.input_hash.clear();  // it was of what is changed here
    record.command_line = common.command_line;
    save_emitter_solution(solution, record, a.output);
    print_summary(solution.all, a.output);
    return ExitCode::done;
}

}  // namespace

void add_relight(CLI::App& program, const Common& common, int& exit_code) {
    auto a = std::make_shared<RelightArguments>();
    CLI::App* command = program.add_subcommand(
        "relight", "Dim or tint emitters of a solution, without another bake");
    command->add_option("SOLUTION", a->solution, "what bake --keep-emitters wrote: NAME.vtm")
        ->required();
    command->add_option("-o,--output", a->output, "solution to write, NAME.vtm")->required();
    command
        ->add_option("--emitter", a->factors,
                     "NAME=FACTOR or NAME=RED,GREEN,BLUE: what to multiply an emitter by; NAME of "
                     "a material, a light, or environment; may be repeated")
        ->required();
    command->footer(
        "Example:\n"
        "  transillum relight room.vtm --emitter lamp=0.5 -o dim.vtm");
    command->callback([a, &common, &exit_code] { exit_code = run(*a, common); });
}

}  // namespace transillum::cli
