#include "cli/command.h"
#include "cli/scene_options.h"

#include <transillum/base/error.h>
#include <transillum/render/image.h>
#include <transillum/solution/compare_solutions.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace transillum::cli {

namespace {

struct CompareArguments {
    std::string a, b;
    double fail_above = -1.0;
    bool json = false;
};

struct Difference {
    double bias, relative_rmse, largest;
    std::uint64_t compared, left_out;
    const char* unit;
};

Difference measure(const CompareArguments& arguments) {
    const bool a_is_solution = arguments.a.ends_with(".vtm"),
               b_is_solution = arguments.b.ends_with(".vtm");
    if (a_is_solution != b_is_solution)
        throw UsageError("compare: two solutions (.vtm) or two images, not one of each");
    if (a_is_solution) {
        const SolutionDifference d =
            compare_solutions(load_solution(arguments.a), load_solution(arguments.b));
        return {d.bias, d.relative_rmse, d.largest, d.patches, 0, "patches"};
    }
    const ImageDifference d = compare_images(read_image(arguments.a), read_image(arguments.b));
    return {d.bias, d.relative_rmse, d.largest, d.compared, d.left_out, "pixels"};
}

int run(const CompareArguments& arguments) {
    const Difference d = measure(arguments);
    if (arguments.json) {
        fmt::print("{}\n", nlohmann::ordered_json{{"bias", d.bias},
                                                  {"relative_rmse", d.relative_rmse},
                                                  {"largest", d.largest},
                                                  {"compared", d.compared},
                                                  {"left_out", d.left_out}}
                               .dump(2));
    } else {
        fmt::print("bias {:+.3f} %  relative RMSE {:.3f} %  largest {:.1f} %  of {} {}",
                   100.0 * d.bias, 100.0 * d.relative_rmse, 100.0 * d.largest, d.compared, d.unit);
        fmt::print("{}\n", d.left_out > 0
                               ? fmt::format(" ({} that see an emitter, and neighbours, left out)",
                                             d.left_out)
                               : "");
    }
    const bool failed = arguments.fail_above >= 0.0 &&
                        !(std::max(std::abs(d.bias), d.relative_rmse) <= arguments.fail_above);
    return failed ? ExitCode::comparison_failed : ExitCode::done;
}

}  // namespace

void add_compare(CLI::App& program, const Common&, int& exit_code) {
    auto a = std::make_shared<CompareArguments>();
    CLI::App* command = program.add_subcommand(
        "compare", "Difference of A from the reference B: two images or two solutions");
    command->add_option("A", a->a, "image or solution")->required();
    command->add_option("B", a->b, "the reference")->required();
    command
        ->add_option("--fail-above", a->fail_above,
                     "exit with 1 when bias or relative RMSE is larger, as 0.03")
        ->check(not_negative());
    command->add_flag("--json", a->json, "machine-readable");
    command->footer(
        "Example:\n"
        "  transillum compare room.exr reference.exr --fail-above 0.05");
    command->callback([a, &exit_code] { exit_code = run(*a); });
}

}  // namespace transillum::cli
