// The matrix of conditions that light must be found under: what each comes to, as a table, and as
// CSV where asked for. Exits with 1 where a condition isn't met.
//
//   stress [--full] [--only TEXT] [--csv FILE] [--help]
#include "physics/stability/measure.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

namespace {

using namespace transillum;
using namespace transillum::stability;

constexpr const char* help =
    "stress [--full] [--only TEXT] [--csv FILE]\n"
    "\n"
    "Bakes under extremes of light, place and shape, and prints what comes out of each. Exits "
    "with\n"
    "1 where energy, a bound or a closed form isn't met. About a minute on two cores.\n"
    "\n"
    "--full        four times the directions, all random rooms, and conditions that take long:\n"
    "              10^6 directions, 10^6 triangles in a pixel, the deepest level; about half\n"
    "              an hour\n"
    "--only TEXT   those with TEXT in their name\n"
    "--csv FILE    the table as CSV, too\n";

struct Arguments {
    bool full = false;
    std::string only, csv;
};

std::optional<Arguments> parse(int argc, char** argv) {
    Arguments a;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == "--full")
            a.full = true;
        else if (name == "--only" && i + 1 < argc)
            a.only = argv[++i];
        else if (name == "--csv" && i + 1 < argc)
            a.csv = argv[++i];
        else
            return std::nullopt;
    }
    return a;
}

void print_head() {
    fmt::print("{:66} {:>7} {:>7} {:>5} {:>9} {:>8} {:>9} {:>8} {:>8} {:>9} {:>7} {:>7}\n",
               "condition", "leaves", "direct.", "seeds", "energy", "allowed", "closed f.",
               "allowed", "least", "of bound", "unseen", "CPU s");
}

void print(const Row& r) {
    const std::string closed_form =
        r.has_closed_form
            ? fmt::format("{:9.1e} {:8.1e}", r.closed_form.mean, r.closed_form.allowed)
            : std::string(18, ' ');
    fmt::print("{:66} {:7} {:7} {:5} {:9.1e} {:8.1e} {} {:8.1e} {:9.7f} {:7.1e} {:7.2f}\n", r.name,
               r.leaves, r.directions, r.seeds, r.energy.mean, r.energy.allowed, closed_form,
               r.least, r.most_over_bound, r.unseen, r.cpu_seconds);
    for (const std::string& fault : r.faults) fmt::print("    FAILED: {}\n", fault);
    std::fflush(stdout);
}

void write_csv(const std::string& file, const std::vector<Row>& rows) {
    auto out = fmt::output_file(file);
    out.print(
        "condition,leaves,directions,seeds,energy_error,energy_allowed,closed_form_error,"
        "closed_form_allowed,least_radiance,largest_over_bound,unseen,cpu_seconds,passed\n");
    for (const Row& r : rows)
        out.print("\"{}\",{},{},{},{:.3e},{:.3e},{},{},{:.3e},{:.8f},{:.3e},{:.3f},{}\n", r.name,
                  r.leaves, r.directions, r.seeds, r.energy.mean, r.energy.allowed,
                  r.has_closed_form ? fmt::format("{:.3e}", r.closed_form.mean) : "",
                  r.has_closed_form ? fmt::format("{:.3e}", r.closed_form.allowed) : "", r.least,
                  r.most_over_bound, r.unseen, r.cpu_seconds, r.passed() ? 1 : 0);
}

template <class Figure>
void print_worst(const char* what, const std::vector<Row>& rows, Figure figure) {
    const Row* worst = nullptr;
    for (const Row& r : rows)
        if (!worst || !(figure(r) <= figure(*worst))) worst = &r;
    if (worst) fmt::print("worst {}: {:.2e} ({})\n", what, figure(*worst), worst->name);
}

int run(const Arguments& a) {
    const Workers workers;
    const Effort effort = a.full ? Effort{1024, 4} : Effort{};
    std::vector<Row> rows;
    print_head();
    for (const Condition& c : all_conditions()) {
        if ((c.is_long && !a.full) || c.name.find(a.only) == std::string::npos) continue;
        rows.push_back(measure(c, effort, workers));
        print(rows.back());
    }
    fmt::print("\n");
    print_worst("energy error", rows,
                [](const Row& r) { return r.is_balanced ? std::abs(r.energy.mean) : 0.0; });
    print_worst("closed-form error", rows, [](const Row& r) {
        return r.has_closed_form ? std::abs(r.closed_form.mean) : 0.0;
    });
    const auto failed = std::ranges::count_if(rows, [](const Row& r) { return !r.passed(); });
    double seconds = 0.0;
    for (const Row& r : rows) seconds += r.cpu_seconds;
    fmt::print("{} conditions, {} failed, {:.0f} s of CPU time\n", rows.size(), failed, seconds);
    if (!a.csv.empty()) write_csv(a.csv, rows);
    return failed > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    const std::optional<Arguments> arguments = parse(argc, argv);
    if (arguments) return run(*arguments);
    const bool is_asked = argc == 2 && std::string(argv[1]) == "--help";
    std::fputs(help, is_asked ? stdout : stderr);
    return is_asked ? EXIT_SUCCESS : 2;
}
