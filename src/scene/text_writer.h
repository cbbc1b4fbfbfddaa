/// Lines of words and numbers, which read back as what they were written from.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace transillum {

class TextWriter {
public:
    TextWriter& word(std::string_view text);
    TextWriter& number(double value);
    /// Short, and the same float also where it is read by way of a double.
    TextWriter& number(float value);
    TextWriter& integer(std::uint64_t value);
    void end_line();

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void begin_word();

    std::string text_;
    bool in_line_ = false;
};

}  // namespace transillum
