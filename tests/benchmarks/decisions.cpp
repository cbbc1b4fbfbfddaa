// What it saves to leave out what a scene doesn't need: each decision as a bake makes it, and
// forced the other way.
//
//   bench_decisions > decisions.csv
//
// A row is a decision: medians over rounds, in which both bakes take turns, each in a process of
// its own. seconds: of the whole bake; cpu: of all its threads, which others on the machine disturb
// less, and their ratio; peak_mb: of its process [10^6 bytes]; error: as each
// estimates it of itself; bias, rms: how far the forced bake is from the other, relative, in the
// irradiance of all fronts (rms: empty where their patches differ).
// "unchanged": a bake whose solution is there already, against the bake and its saving.
#include "benchmarks/clock.h"
#include "support/decision_cases.h"

#include <transillum/solution/load_solution.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace transillum;
using namespace transillum::benchmarks;
using namespace transillum::testing_support;

struct Arguments {
    std::vector<std::string> only;
    DecisionSize size{20'000, 512, 3, 24, 1000};
    int rounds = 3;
    int threads = 2;
};

struct Measured {
    double seconds = std::numeric_limits<double>::quiet_NaN();
    double cpu_seconds = seconds, peak_megabytes = seconds;
    std::uint64_t told = 0;
    FrontField field;
};

/// Of this process so far.
void add_usage(Measured& m) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    m.peak_megabytes = static_cast<double>(usage.ru_maxrss) * 1024.0 * 1e-6;
    m.cpu_seconds = 0.0;
    for (const timeval& t : {usage.ru_utime, usage.ru_stime})
        m.cpu_seconds += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// A pipe's end, for plain numbers.
class Stream {
public:
    explicit Stream(int descriptor, const char* mode) : file_(fdopen(descriptor, mode)) {}
    ~Stream() { std::fclose(file_); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    template <class Number>
    void put(const Number& x) {
        std::fwrite(&x, sizeof(x), 1, file_);
    }
    void put(const std::vector<double>& all) {
        put(std::uint64_t{all.size()});
        std::fwrite(all.data(), sizeof(double), all.size(), file_);
    }
    template <class Number>
    bool get(Number& x) {
        return std::fread(&x, sizeof(x), 1, file_) == 1;
    }
    bool get(std::vector<double>& all) {
        std::uint64_t size = 0;
        if (!get(size)) return false;
        all.resize(size);
        return std::fread(all.data(), sizeof(double), size, file_) == size;
    }

private:
    std::FILE* file_;
};

/// In a process of its own, so that its peak is; NaN where that fails.
Measured measure_apart(const std::function<Measured()>& measure) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        try {
            const Measured m = measure();
            Stream out(ends[1], "w");
            out.put(m.seconds);
            out.put(m.cpu_seconds);
            out.put(m.peak_megabytes);
            out.put(m.told);
            out.put(m.field.relative_error);
            out.put(m.field.values);
            out.put(m.field.areas);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s\n", e.what());
        }
        std::_Exit(EXIT_SUCCESS);
    }
    close(ends[1]);
    Measured m;
    {
        Stream in(ends[0], "r");
        const bool is_whole = in.get(m.seconds) && in.get(m.cpu_seconds) &&
                              in.get(m.peak_megabytes) && in.get(m.told) &&
                              in.get(m.field.relative_error) && in.get(m.field.values) &&
                              in.get(m.field.areas);
        if (!is_whole) std::fputs("a bake failed\n", stderr);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return m;
}

Measured baked(const Scene& scene, const BakeOptions& options, const char* told, int threads) {
    Monitor silent;
    Measured m;
    const Clock clock;
    const Solution s = bake(scene, options, Workers(threads), silent);
    m.seconds = clock.seconds();
    add_usage(m);
    m.told = tells(s, told) ? 1 : 0;
    m.field = fronts_of(s);
    return m;
}

double median(const std::vector<Measured>& rounds, double Measured::*member) {
    std::vector<double> values;
    for (const Measured& m : rounds) values.push_back(m.*member);
    std::ranges::sort(values);
    return values[values.size() / 2];
}

using Way = std::function<Measured()>;

void print_row(const std::string& name, int rounds, const Way& decide, const Way& force) {
    std::vector<Measured> decided, forced;
    for (int i = 0; i < rounds; ++i) {
        decided.push_back(measure_apart(decide));
        forced.push_back(measure_apart(force));
    }
    const FrontField &a = decided[0].field, &b = forced[0].field;
    const double cpu = median(decided, &Measured::cpu_seconds);
    const double cpu_forced = median(forced, &Measured::cpu_seconds);
    fmt::print("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.1f},{:.1f},{:.2e},{:.2e},{:.2e},{}\n",
               name, decided[0].told, median(decided, &Measured::seconds),
               median(forced, &Measured::seconds), cpu, cpu_forced, cpu_forced / cpu,
               median(decided, &Measured::peak_megabytes),
               median(forced, &Measured::peak_megabytes), a.relative_error, b.relative_error,
               b.mean() / a.mean() - 1.0,
               a.values.size() == b.values.size() ? fmt::format("{:.2e}", relative_rms(b, a)) : "");
    std::fflush(stdout);
}

/// A solution that is there already.
void print_unchanged(const DecisionCase& c, const Arguments& a) {
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::temp_directory_path() / ("bench_decisions_" + std::to_string(getpid()));
    fs::create_directories(folder);
    const fs::path path = folder / "room.vtm";
    const auto bake_and_save = [&] {
        Monitor silent;
        Measured m;
        const Clock clock;
        RunRecord run;
        const Solution s = bake(c.scene, c.options, Workers(a.threads), silent, &run);
        save_solution(s, run, path);
        m.seconds = clock.seconds();
        add_usage(m);
        m.field = fronts_of(s);
        return m;
    };
    measure_apart(bake_and_save);
    const auto find = [&] {
        Measured m;
        const Clock clock;
        const auto s = find_baked(path, hash_input(c.scene, c.options));
        m.seconds = clock.seconds();
        add_usage(m);
        m.told = s ? 1 : 0;
        if (s) m.field = fronts_of(*s);
        return m;
    };
    print_row("unchanged", a.rounds, find, bake_and_save);
    fs::remove_all(folder);
}

int run(const Arguments& a) {
    fmt::print(
        "decision,told,seconds,seconds_forced,cpu,cpu_forced,ratio,peak_mb,peak_mb_forced,error,"
        "error_forced,"
        "bias,rms\n");
    const auto is_asked_for = [&](const std::string& name) {
        return a.only.empty() || std::ranges::find(a.only, name) != a.only.end();
    };
    const std::vector<DecisionCase> cases = decision_cases(a.size);
    for (const DecisionCase& c : cases) {
        if (!is_asked_for(c.name)) continue;
        std::fprintf(stderr, "%s ...\n", c.name.c_str());
        print_row(
            c.name, a.rounds, [&] { return baked(c.scene, c.options, c.told, a.threads); },
            [&] { return baked(c.forced_scene, c.forced_options, c.told, a.threads); });
    }
    if (is_asked_for("unchanged")) print_unchanged(cases[0], a);
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) try {
    Arguments a;
    CLI::App program(
        "Bakes that leave out what a scene doesn't need, beside bakes that don't. CSV on stdout.");
    program.add_option("--only", a.only, "these decisions, by name");
    program.add_option("--leaves", a.size.leaves)->capture_default_str();
    program.add_option("--directions", a.size.directions)
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    program.add_option("--spheres", a.size.spheres, "in a room, along each edge of the grid")
        ->capture_default_str();
    program.add_option("--rounds", a.rounds)->check(CLI::PositiveNumber)->capture_default_str();
    program.add_option("--threads", a.threads)->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    return run(a);
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_decisions: %s\n", e.what());
    return EXIT_FAILURE;
}
