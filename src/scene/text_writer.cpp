#include "scene/text_writer.h"

#include <array>
#include <charconv>

namespace transillum {

namespace {

template <class T>
std::string shortest(T value) {
    std::array<char, 32> digits{};
    char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return std::string(digits.data(), end);
}

}  // namespace

void TextWriter::begin_word() {
    if (in_line_) text_ += ' ';
    in_line_ = true;
}

TextWriter& TextWriter::word(std::string_view text) {
    begin_word();
    text_ += text;
    return *this;
}

TextWriter& TextWriter::number(double value) {
    return word(shortest(value));
}

TextWriter& TextWriter::number(float value) {
    const std::string text = shortest(value);
    double read = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    return static_cast<float>(read) == value ? word(text) : number(static_cast<double>(value));
}

TextWriter& TextWriter::integer(std::uint64_t value) {
    return word(shortest(value));
}

void TextWriter::end_line() {
    text_ += '\n';
    in_line_ = false;
}

}  // namespace transillum
