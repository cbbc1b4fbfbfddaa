/// Strict reading of text formats: every word and number is accounted for, every error names its
/// line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace transillum {

/// The bytes of a file. \throws IoError when it cannot be read, InputError when it is empty.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// A word as it may stand in a one-line message: in quotes, short, printable.
[[nodiscard]] std::string in_quotes(std::string_view word);

/// Splits text into lines of words. A line can be taken as a whole (`next_line`, `words`), or words
/// can be taken one by one across line ends (`next_word`, `end_record`) for formats of numbers.
/// Comments run from a word that begins with `#` to the end of the line.
class TextReader {
public:
    struct Syntax {
        bool comments = true;
        bool continuation = false;  ///< a `\` at its end joins a line to the next
    };

    /// `text` must outlive the reader. `first_line` is the number of its first line in the file.
    TextReader(std::string path, std::string_view text, Syntax syntax, std::size_t first_line = 1);

    /// Moves to the next line that holds a word; false at the end.
    bool next_line();
    [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
    /// The line from a word on, blanks within included; empty where there is no such word.
    [[nodiscard]] std::string_view rest(std::size_t word) const;
    [[nodiscard]] std::size_t line() const { return line_; }

    /// The next word, from this line or a later one. \throws InputError at the end of the file.
    std::string_view next_word();
    /// \throws InputError unless every word of the line has been taken.
    void end_record();
    void skip_line() { taken_ = words_.size(); }

    /// A finite number. \throws InputError
    [[nodiscard]] double number(std::string_view word) const;
    /// An integer. \throws InputError
    [[nodiscard]] std::int64_t integer(std::string_view word) const;

    /// \throws InputError naming file and line.
    [[noreturn]] void fail(const std::string& what) const;

private:
    void read_line();
    /// Length of a join to the next line, 0 where there is none.
    [[nodiscard]] std::size_t continuation(std::size_t at) const;

    std::string path_;
    std::string_view text_;
    Syntax syntax_;
    std::size_t position_ = 0;
    std::size_t line_ = 0;       ///< of the words
    std::size_t next_line_ = 1;  ///< of the text at position_
    std::vector<std::string_view> words_;
    std::size_t taken_ = 0;
};

}  // namespace transillum
