#include <transillum/base/error.h>
#include <transillum/transport/plain_sums.h>

#include "transport/iteration_sums.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace transillum {

namespace {

/// Some of the doubles that a struct consists of, with what may stand there.
struct Columns {
    const char* name;
    int first, count;
    bool may_be_negative;
};

/// Residuals have signs, and so have their sums.
constexpr Columns of_patch[] = {
    {"Received", 0, 3, true},         {"Coverage", 3, 1, false},
    {"Fragments", 4, 1, false},       {"ReceivedSquared", 5, 3, false},
    {"ReceivedCoverage", 8, 3, true}, {"CoverageSquared", 11, 1, false}};
constexpr Columns of_transfer[] = {{"Radiance", 0, 3, true}, {"Fragments", 3, 1, false}};
constexpr Columns of_scene[] = {
    {"Escaped", 0, 3, true}, {"Entered", 3, 3, true}, {"Weights", 6, 1, false}};
/// FiniteElementSums but for its vectors.
struct SceneSums {
    SpectrumSum escaped{0.0}, entered{0.0};
    double weights = 0.0;
};
// A member that is added must be stored too.
static_assert(sizeof(PatchSums) == 12 * sizeof(double));
static_assert(sizeof(Received) == 4 * sizeof(double));
static_assert(sizeof(SceneSums) == 7 * sizeof(double));
static_assert(sizeof(GlossySum) == 4 * sizeof(float));

/// Structs of doubles to tables, one for every group of columns.
class Writer {
public:
    PlainSums plain;

    template <class Count>
    void count(const std::string& name, Count value, std::uint64_t) {
        plain.counts.push_back({name, 1, {static_cast<std::uint64_t>(value)}});
    }
    void number(const std::string& name, double value) {
        plain.doubles.push_back({name, 1, {value}});
    }
    template <class Row, std::size_t N>
    void rows(const std::string& prefix, const Columns (&columns)[N], const std::vector<Row>& rows,
              std::size_t) {
        constexpr std::size_t width = sizeof(Row) / sizeof(double);
        for (const Columns& c : columns) {
            NumberTable<double> table{prefix + c.name, c.count, {}};
            const auto parts = static_cast<std::size_t>(c.count);
            table.values.resize(parts * rows.size());
            for (std::size_t i = 0; i < rows.size(); ++i) {
                double row[width];
                std::memcpy(row, &rows[i], sizeof(row));
                std::copy_n(row + c.first, parts, &table.values[i * parts]);
            }
            plain.doubles.push_back(std::move(table));
        }
    }
    void glossy(const std::string& name, const std::vector<GlossySum>& sums, std::size_t) {
        NumberTable<float> table{name, 4, std::vector<float>(4 * sums.size())};
        if (!sums.empty())
            std::memcpy(table.values.data(), sums.data(), sums.size() * sizeof(GlossySum));
        plain.floats.push_back(std::move(table));
    }
};

class Reader {
public:
    explicit Reader(const PlainSums& plain) : plain_(plain) {}

    template <class Count>
    void count(const std::string& name, Count& value, std::uint64_t most) {
        const std::uint64_t found = find(plain_.counts, name, 1, 1)[0];
        if (found > most)
            throw UsageError("array '" + name + "': " + std::to_string(found) +
                             "; accepted: at most " + std::to_string(most));
        value = static_cast<Count>(found);
    }
    void number(const std::string& name, double& value) {
        value = find(plain_.doubles, name, 1, 1)[0];
    }
    template <class Row, std::size_t N>
    void rows(const std::string& prefix, const Columns (&columns)[N], std::vector<Row>& rows,
              std::size_t count) {
        constexpr std::size_t width = sizeof(Row) / sizeof(double);
        rows.resize(count);
        for (const Columns& c : columns) {
            const auto& values = find(plain_.doubles, prefix + c.name, c.count, count);
            const auto parts = static_cast<std::size_t>(c.count);
            for (std::size_t i = 0; i < count; ++i) {
                double row[width];
                std::memcpy(row, &rows[i], sizeof(row));
                for (std::size_t k = 0; k < parts; ++k)
                    row[c.first + k] =
                        checked(values[i * parts + k], c.may_be_negative, prefix + c.name);
                std::memcpy(static_cast<void*>(&rows[i]), row, sizeof(row));
            }
        }
    }
    void glossy(const std::string& name, std::vector<GlossySum>& sums, std::size_t count) {
        const auto& values = find(plain_.floats, name, 4, count);
        for (std::size_t i = 0; i < values.size(); ++i)
            static_cast<void>(checked(double{values[i]}, i % 4 != 3, name));
        sums.resize(count);
        if (count > 0) std::memcpy(sums.data(), values.data(), count * sizeof(GlossySum));
    }

    /// As many floats, or none.
    [[nodiscard]] std::vector<float> values_or_none(const std::string& name, std::size_t count) {
        const auto table = std::ranges::find(plain_.floats, name, &NumberTable<float>::name);
        if (table != plain_.floats.end() && table->values.empty()) return {};
        const std::vector<float>& values = find(plain_.floats, name, 1, count);
        for (const float value : values) static_cast<void>(checked(double{value}, true, name));
        return values;
    }

    /// Rows that a table has.
    [[nodiscard]] std::size_t rows_of(const std::string& name) const {
        for (const auto& table : plain_.doubles)
            if (table.name == name)
                return table.values.size() / static_cast<std::size_t>(table.components);
        return 0;
    }

private:
    template <class Number>
    static const std::vector<Number>& find(const std::vector<NumberTable<Number>>& tables,
                                           const std::string& name, int components,
                                           std::size_t rows) {
        const auto table = std::ranges::find(tables, name, &NumberTable<Number>::name);
        if (table == tables.end()) throw UsageError("array '" + name + "' is missing");
        const std::size_t expected = rows * static_cast<std::size_t>(components);
        if (table->components != components || table->values.size() != expected)
            throw UsageError("array '" + name + "': " + std::to_string(table->values.size()) +
                             " numbers, expected " + std::to_string(expected));
        return table->values;
    }
    static double checked(double value, bool may_be_negative, const std::string& name) {
        if (std::isfinite(value) && (may_be_negative || value >= 0.0)) return value;
        throw UsageError("array '" + name + "': " + std::to_string(value) +
                         " is not a finite number" + (may_be_negative ? "" : " of at least 0"));
    }

    const PlainSums& plain_;
};

/// DirectionPart.
struct PlainPart {
    double begin = 0.0, end = 0.0, share = 0.0;
};
/// Of a move: how many parts it has of those that follow each other.
struct PlainMove {
    double parts = 0.0, mean_square = 0.0;
};
constexpr Columns of_part[] = {{"Range", 0, 2, false}, {"Share", 2, 1, true}};
constexpr Columns of_move[] = {{"Parts", 0, 1, false}, {"MeanSquare", 1, 1, false}};

void write_parts(Writer& w, const std::string& prefix, const std::vector<DirectionPart>& parts) {
    std::vector<PlainPart> rows;
    for (const DirectionPart& p : parts)
        rows.push_back({static_cast<double>(p.begin), static_cast<double>(p.end), p.share});
    w.rows(prefix, of_part, rows, 0);
}

/// \throws UsageError unless they are ranges of directions.
std::vector<DirectionPart> read_parts(Reader& r, const std::string& prefix) {
    std::vector<PlainPart> rows;
    r.rows(prefix, of_part, rows, r.rows_of(prefix + "Range"));
    std::vector<DirectionPart> parts;
    for (const PlainPart& p : rows) {
        if (!(p.begin < p.end && p.end <= 0x1p32 && p.begin == std::floor(p.begin) &&
              p.end == std::floor(p.end)))
            throw UsageError("array '" + prefix + "Range': " + std::to_string(p.begin) + " to " +
                             std::to_string(p.end) + "; accepted: whole numbers, ascending");
        parts.push_back(
            {static_cast<std::uint64_t>(p.begin), static_cast<std::uint64_t>(p.end), p.share});
    }
    return parts;
}

void write_error(Writer& w, const ErrorHistory& e) {
    write_parts(w, "Error", e.parts);
    write_parts(w, "ErrorEarlier", e.earlier);
    write_parts(w, "ErrorLast", e.last_parts);
    std::vector<DirectionPart> of_moves;
    std::vector<PlainMove> moves;
    for (const AverageMove& m : e.moves) {
        moves.push_back({static_cast<double>(m.difference.size()), m.mean_square});
        of_moves.insert(of_moves.end(), m.difference.begin(), m.difference.end());
    }
    w.rows("ErrorMove", of_move, moves, 0);
    write_parts(w, "ErrorMove", of_moves);
    w.plain.floats.push_back({"ErrorLast", 1, e.last});
    w.number("ErrorModelC", e.model.c);
    w.number("ErrorModelA", e.model.a);
    w.count("ErrorJumps", e.jumps, 0);
}

/// \throws UsageError where it contradicts itself.
void read_error(Reader& r, ErrorHistory& e, std::size_t patches) {
    e.parts = read_parts(r, "Error");
    e.earlier = read_parts(r, "ErrorEarlier");
    e.last_parts = read_parts(r, "ErrorLast");
    const std::vector<DirectionPart> of_moves = read_parts(r, "ErrorMove");
    std::vector<PlainMove> moves;
    r.rows("ErrorMove", of_move, moves, r.rows_of("ErrorMoveParts"));
    auto next = of_moves.begin();
    for (const PlainMove& m : moves) {
        if (!(m.parts <= static_cast<double>(of_moves.end() - next)))
            throw UsageError("array 'ErrorMoveParts': more than there are");
        const auto end = next + static_cast<std::ptrdiff_t>(m.parts);
        e.moves.push_back({{next, end}, m.mean_square});
        next = end;
    }
    e.last = r.values_or_none("ErrorLast", patches);
    r.number("ErrorModelC", e.model.c);
    r.number("ErrorModelA", e.model.a);
    r.count("ErrorJumps", e.jumps, 1);
}

struct Sizes {
    std::size_t patches = 0, elements = 0, transfers = 0;
};

template <class Archive, class Elements>
void visit_elements(Archive& a, const std::string& prefix, Elements& e, const Sizes& sizes) {
    a.rows(prefix, of_patch, e.patches, sizes.patches);
    a.glossy(prefix + "Glossy", e.glossy, sizes.elements);
    std::vector<SceneSums> scene{{e.escaped, e.entered, e.weights}};
    a.rows(prefix, of_scene, scene, 1);
    a.count(prefix + "Blocks", e.blocks, std::numeric_limits<int>::max());
    if constexpr (!std::is_const_v<Elements>) {
        e.escaped = scene[0].escaped;
        e.entered = scene[0].entered;
        e.weights = scene[0].weights;
    }
}

void visit_float(Writer& w, const char* name, float value) {
    w.number(name, double{value});
}
void visit_float(Reader& r, const char* name, float& value) {
    double found = 0.0;
    r.number(name, found);
    value = static_cast<float>(found);
}

/// The same for both ways.
template <class Archive, class Sums>
void visit(Archive& a, Sums& s, const Sizes& sizes, const Sizes& earlier) {
    constexpr std::uint64_t any = std::numeric_limits<std::uint64_t>::max();
    constexpr std::uint64_t most_directions = std::numeric_limits<std::uint32_t>::max();
    a.number("PixelSize", s.pixel_size);
    a.count("Averaging", s.averaging, std::uint64_t(Averaging::none));
    a.count("MonteCarlo", s.monte_carlo, std::uint64_t(MonteCarlo::wavefront));
    a.count("Directions", s.directions, most_directions);
    a.count("RestartedAt", s.restarted_at, most_directions);
    visit_elements(a, "", s.elements, sizes);
    visit_elements(a, "Earlier", s.earlier, earlier);
    a.rows("Clusters", of_transfer, s.between_clusters.entries, sizes.transfers);
    a.rows("EarlierClusters", of_transfer, s.earlier_between_clusters.entries, sizes.transfers);
    a.count("Representation", s.carried.representation, std::uint64_t(MonteCarlo::wavefront));
    a.count("Carried", s.carried.directions, most_directions);
    a.count("ShuffledFrom", s.carried.shuffled_from, any);
    a.count("ShuffledUntil", s.carried.shuffled_until, any);
    a.count("GivenUp", s.carried.given_up, 1);
    a.number("ResidualEffect", s.carried.effect);
    a.number("RelativeError", s.relative_error);
    a.count("Restarts", s.restarts, 1);
    visit_float(a, "BrightestEnvironment", s.brightest_environment);
}

}  // namespace

PlainSums plain_sums(const IterationSums& sums) {
    Writer writer;
    visit(writer, sums, {}, {});
    writer.count("ClusterCount", sums.between_clusters.count, 0);
    write_error(writer, sums.error);
    return std::move(writer.plain);
}

std::shared_ptr<const IterationSums> sums_of(const PlainSums& plain, const PatchHierarchy& patches,
                                             const GlossySides& glossy) {
    auto sums = std::make_shared<IterationSums>();
    sums->patches = patches;
    sums->sides = glossy.sides;
    Reader reader(plain);
    std::uint32_t clusters = 0;
    reader.count("ClusterCount", clusters, most_clusters);
    sums->between_clusters = sums->earlier_between_clusters = ClusterTransfer(clusters);
    const std::size_t transfers = sums->between_clusters.entries.size();
    const Sizes sizes{patches.patch_count(), glossy.element_count, transfers};
    const bool has_earlier = reader.rows_of("EarlierReceived") > 0;
    visit(reader, *sums, sizes, has_earlier ? sizes : Sizes{});
    read_error(reader, sums->error, sizes.patches);
    if (!(sums->pixel_size > 0.0) || !std::isfinite(sums->pixel_size))
        throw UsageError("array 'PixelSize': " + std::to_string(sums->pixel_size) +
                         "; accepted: finite and above 0");
    return sums;
}

IterationOptions options_to_go_on(std::shared_ptr<const IterationSums> sums) {
    IterationOptions options;
    options.pixel_size = sums->pixel_size;
    options.averaging = sums->averaging;
    options.monte_carlo = sums->monte_carlo;
    options.start = std::move(sums);
    return options;
}

}  // namespace transillum
