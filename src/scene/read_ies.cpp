#include <transillum/scene/read_ies.h>

#include "scene/soup.h"
#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace transillum {

namespace {

constexpr std::int64_t most_angles = 3600;

enum class Version { of_1986, of_1991, of_1995, of_2002 };

class IesReader {
public:
    IesReader(const std::filesystem::path& path, Monitor& monitor)
        : name_(path.string()), monitor_(monitor), text_(read_file(path)) {
        // Numbers may be parted by commas; some programs end a file as DOS did.
        std::ranges::replace(text_, '\x1a', ' ');
    }
    Photometry read();

private:
    void read_header();
    void read_tilt(TextReader& numbers) const;
    std::int64_t count(TextReader& numbers, const char* what) const;
    double positive(TextReader& numbers, const char* what) const;
    std::vector<double> angles(TextReader& numbers, std::int64_t count, const char* what) const;

    std::string name_;
    Monitor& monitor_;
    std::string text_;
    Version version_ = Version::of_1986;
    std::string tilt_;
    std::size_t numbers_at_ = 0, numbers_line_ = 0;  ///< behind the line of TILT
};

std::string_view trimmed(std::string_view line) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    return line;
}

Version version_of(const std::string& where, std::string_view line) {
    if (line == "IESNA91" || line == "IESNA:LM-63-1991") return Version::of_1991;
    if (line == "IESNA:LM-63-1995") return Version::of_1995;
    if (line == "IESNA:LM-63-2002") return Version::of_2002;
    throw InputError(where, in_quotes(line) +
                                " found; accepted: IESNA91, IESNA:LM-63-1995, IESNA:LM-63-2002, "
                                "or no such line (1986)");
}

/// Up to the line of TILT: the version, and text about the luminaire.
void IesReader::read_header() {
    std::size_t at = 0;
    for (std::size_t line = 1; at < text_.size(); ++line) {
        const std::size_t end = std::min(text_.find('\n', at), text_.size());
        const std::string_view words = trimmed(std::string_view(text_).substr(at, end - at));
        at = end + 1;
        if (line == 1 && words.starts_with("IES")) version_ = version_of(name_ + ":1", words);
        if (!words.starts_with("TILT=")) continue;
        tilt_ = trimmed(words.substr(5));
        if (tilt_ != "NONE" && tilt_ != "INCLUDE")
            throw InputError(name_ + ":" + std::to_string(line),
                             "TILT=" + tilt_ + " found; accepted: TILT=NONE, TILT=INCLUDE");
        numbers_at_ = std::min(at, text_.size());
        numbers_line_ = line + 1;
        return;
    }
    throw InputError(name_, "no line begins with TILT=; accepted: an IES LM-63 file");
}

std::int64_t IesReader::count(TextReader& numbers, const char* what) const {
    const std::int64_t n = numbers.integer(numbers.next_word());
    if (n < 1 || n > most_angles)
        numbers.fail(std::to_string(n) + " " + what + "; accepted: 1 to " +
                     std::to_string(most_angles));
    return n;
}

double IesReader::positive(TextReader& numbers, const char* what) const {
    const double value = numbers.number(numbers.next_word());
    if (!(value > 0.0))
        numbers.fail(std::string(what) + " is " + shown(value) + "; accepted: above 0");
    return value;
}

std::vector<double> IesReader::angles(TextReader& numbers, std::int64_t count,
                                      const char* what) const {
    std::vector<double> result;
    for (std::int64_t i = 0; i < count; ++i) {
        const double angle = numbers.number(numbers.next_word());
        if (!result.empty() && !(angle > result.back()))
            numbers.fail(std::string(what) + " angle " + shown(angle) + " follows " +
                         shown(result.back()) + "; accepted: ascending angles");
        result.push_back(angle);
    }
    return result;
}

void IesReader::read_tilt(TextReader& numbers) const {
    if (tilt_ == "NONE") return;
    const std::int64_t geometry = numbers.integer(numbers.next_word());
    if (geometry < 1 || geometry > 3)
        numbers.fail("lamp-to-luminaire geometry " + std::to_string(geometry) +
                     "; accepted: 1 to 3");
    const std::int64_t pairs = count(numbers, "tilt angles");
    (void)angles(numbers, pairs, "tilt");
    for (std::int64_t i = 0; i < pairs; ++i) (void)positive(numbers, "tilt multiplier");
    monitor_.note(name_ + ": not honoured: TILT=INCLUDE (the luminaire is taken as measured)");
}

void check_symmetry(const TextReader& numbers, const Photometry& p) {
    const double top = p.vertical.front(), bottom = p.vertical.back();
    const bool is_sphere_part =
        (top == 0.0 || top == 90.0) && (bottom == 90.0 || bottom == 180.0) && top < bottom;
    if (!is_sphere_part)
        numbers.fail("vertical angles from " + shown(top) + " to " + shown(bottom) +
                     "; accepted for type C: from 0 or 90 to 90 or 180");
    const double first = p.horizontal.front(), last = p.horizontal.back();
    const bool from_0 =
        first == 0.0 && (last == 0.0 || last == 90.0 || last == 180.0 || last == 360.0);
    if (!from_0 && !(first == 90.0 && last == 270.0))
        numbers.fail("horizontal angles from " + shown(first) + " to " + shown(last) +
                     "; accepted for type C: 0 alone, 0 to 90, 0 to 180, 0 to 360, 90 to 270");
}

Photometry IesReader::read() {
    read_header();
    std::replace(text_.begin() + static_cast<std::ptrdiff_t>(numbers_at_), text_.end(), ',', ' ');
    TextReader numbers(name_, std::string_view(text_).substr(numbers_at_),
                       {.comments = false, .continuation = false}, numbers_line_);
    read_tilt(numbers);
    (void)numbers.number(numbers.next_word());  // lamps
    (void)numbers.number(numbers.next_word());  // lumens a lamp, or -1
    double factor = positive(numbers, "candela multiplier");
    const std::int64_t verticals = count(numbers, "vertical angles");
    const std::int64_t horizontals = count(numbers, "horizontal angles");
    const std::int64_t type = numbers.integer(numbers.next_word());
    if (type != 1)
        numbers.fail("photometric type " + std::to_string(type) +
                     (type == 2   ? " (B)"
                      : type == 3 ? " (A)"
                                  : "") +
                     "; accepted: 1 (C)");
    const std::int64_t units = numbers.integer(numbers.next_word());
    if (units != 1 && units != 2)
        numbers.fail("units " + std::to_string(units) + "; accepted: 1 (feet), 2 (metres)");
    for (int i = 0; i < 3; ++i) (void)numbers.number(numbers.next_word());  // luminous opening
    factor *= positive(numbers, "ballast factor");
    const double ballast_lamp = positive(numbers, "ballast-lamp photometric factor");
    if (version_ < Version::of_1995) factor *= ballast_lamp;
    (void)numbers.number(numbers.next_word());  // input watts

    Photometry result;
    result.name = name_;
    result.vertical = angles(numbers, verticals, "vertical");
    result.horizontal = angles(numbers, horizontals, "horizontal");
    check_symmetry(numbers, result);
    for (std::int64_t i = 0; i < verticals * horizontals; ++i) {
        const double value = numbers.number(numbers.next_word());
        if (value < 0.0) numbers.fail("candela value " + shown(value) + "; accepted: 0 or more");
        result.candela.push_back(factor * value);
    }
    numbers.end_record();
    if (numbers.next_line())
        numbers.fail(in_quotes(numbers.words().front()) + " found behind the last of " +
                     std::to_string(verticals * horizontals) +
                     " candela values; accepted: nothing");
    return result;
}

}  // namespace

Photometry read_ies(const std::filesystem::path& path, Monitor& monitor) {
    return IesReader(path, monitor).read();
}

}  // namespace transillum
