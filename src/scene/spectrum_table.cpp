#include <transillum/scene/spectrum_table.h>

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>

namespace transillum {

namespace {

std::string_view trimmed(std::string_view word) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!word.empty() && is_blank(word.front())) word.remove_prefix(1);
    while (!word.empty() && is_blank(word.back())) word.remove_suffix(1);
    return word;
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos;) {
        cells.push_back(trimmed(line.substr(0, comma)));
        line.remove_prefix(comma + 1);
    }
    cells.push_back(trimmed(line));
    return cells;
}

/// Index of the column. \throws InputError
std::size_t find_column(const TextReader& reader, const std::vector<std::string_view>& names,
                        std::string_view column) {
    if (names.front() != "wavelength")
        reader.fail("first column " + in_quotes(names.front()) + "; accepted: wavelength");
    std::string known;
    for (std::size_t i = 1; i < names.size(); ++i) {
        if (names[i].empty()) reader.fail("a column without a name; accepted: a name for each");
        if (std::ranges::count(names, names[i]) > 1)
            reader.fail("two columns " + in_quotes(names[i]) + "; accepted: different names");
        known += (i > 1 ? ", " : "") + std::string(names[i]);
    }
    const auto found = std::ranges::find(names.begin() + 1, names.end(), column);
    if (found == names.end())
        reader.fail("no column " + in_quotes(column) +
                    "; accepted: " + (known.empty() ? "a file with columns" : known));
    return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

double SpectrumTable::integral(double from, double to) const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < wavelengths.size(); ++i) {
        const double a = std::max(from, wavelengths[i]), b = std::min(to, wavelengths[i + 1]);
        if (!(a < b)) continue;
        const double slope = (values[i + 1] - values[i]) / (wavelengths[i + 1] - wavelengths[i]);
        sum += (b - a) * (values[i] + slope * (0.5 * (a + b) - wavelengths[i]));
    }
    return sum;
}

SpectrumTable parse_spectrum(const std::string& name, std::string_view text,
                             std::string_view column) {
    TextReader reader(name, text, {.comments = true, .continuation = false});
    if (!reader.next_line()) throw InputError(name, "no columns; accepted: a line that names them");
    const std::vector<std::string_view> names = cells_of(reader.rest(0));
    const std::size_t wanted = find_column(reader, names, column);
    SpectrumTable table{name + ", column '" + std::string(column) + "'", {}, {}};
    while (reader.next_line()) {
        const std::vector<std::string_view> cells = cells_of(reader.rest(0));
        if (cells.size() != names.size())
            reader.fail(std::to_string(cells.size()) + " values; accepted: " +
                        std::to_string(names.size()) + ", as many as columns");
        const double wavelength = reader.number(cells.front()),
                     value = reader.number(cells[wanted]);
        if (!table.wavelengths.empty() && !(wavelength > table.wavelengths.back()))
            reader.fail("wavelength " + shown(wavelength) + " follows " +
                        shown(table.wavelengths.back()) + "; accepted: ascending wavelengths");
        if (value < 0.0) reader.fail("value " + shown(value) + "; accepted: 0 or more");
        table.wavelengths.push_back(wavelength);
        table.values.push_back(value);
    }
    if (table.wavelengths.size() < 2)
        throw InputError(
            name, std::to_string(table.wavelengths.size()) + " wavelengths; accepted: two or more");
    return table;
}

SpectrumTable read_spectrum(const std::filesystem::path& path, std::string_view column) {
    return parse_spectrum(path.string(), read_file(path), column);
}

}  // namespace transillum
