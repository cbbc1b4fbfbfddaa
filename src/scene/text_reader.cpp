#include "scene/text_reader.h"

#include <transillum/base/error.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace transillum {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// std::from_chars knows no leading plus.
std::string_view without_plus(std::string_view word) {
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return plus ? word.substr(1) : word;
}

template <class T>
bool parse(std::string_view word, T& value) {
    word = without_plus(word);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        throw IoError(path.string(), "is a folder, not a file");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw IoError(path.string(), std::string("cannot be read: ") + std::strerror(errno));
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad()) throw IoError(path.string(), "cannot be read to its end");
    if (bytes.empty()) throw InputError(path.string(), "the file is empty");
    return bytes;
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t longest = 60;
    std::string shown = "'";
    for (const char c : word.substr(0, longest))
        shown += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
    return shown + (word.size() > longest ? "...'" : "'");
}

TextReader::TextReader(std::string path, std::string_view text, Syntax syntax,
                       std::size_t first_line)
    : path_(std::move(path)), text_(text), syntax_(syntax), next_line_(first_line) {}

bool TextReader::next_line() {
    words_.clear();
    taken_ = 0;
    while (words_.empty() && position_ < text_.size()) read_line();
    return !words_.empty();
}

void TextReader::read_line() {
    line_ = next_line_;
    std::size_t& at = position_;
    while (at < text_.size() && text_[at] != '\n') {
        if (is_blank(text_[at])) {
            ++at;
        } else if (syntax_.comments && text_[at] == '#') {
            at = std::min(text_.find('\n', at), text_.size());
        } else if (const std::size_t length = continuation(at)) {
            at += length;
            ++next_line_;
        } else {
            std::size_t end = at;
            while (end < text_.size() && !is_blank(text_[end]) && text_[end] != '\n' &&
                   !continuation(end))
                ++end;
            words_.push_back(text_.substr(at, end - at));
            at = end;
        }
    }
    ++at;
    ++next_line_;
}

std::size_t TextReader::continuation(std::size_t at) const {
    if (!syntax_.continuation || text_[at] != '\\') return 0;
    std::size_t end = at + 1;
    while (end < text_.size() && is_blank(text_[end])) ++end;
    return end < text_.size() && text_[end] == '\n' ? end + 1 - at : 0;
}

std::string_view TextReader::rest(std::size_t word) const {
    if (word >= words_.size()) return {};
    const char* begin = words_[word].data();
    return {begin, static_cast<std::size_t>(words_.back().data() + words_.back().size() - begin)};
}

std::string_view TextReader::next_word() {
    if (taken_ == words_.size() && !next_line()) {
        line_ = next_line_ - 1;
        fail("the file ends too early");
    }
    return words_[taken_++];
}

void TextReader::end_record() {
    if (taken_ < words_.size())
        fail("unexpected " + in_quotes(words_[taken_]) + "; accepted: the end of the line");
}

double TextReader::number(std::string_view word) const {
    double value = 0.0;
    if (!parse(word, value) || !std::isfinite(value))
        fail(in_quotes(word) + " found; accepted: a finite number");
    return value;
}

std::int64_t TextReader::integer(std::string_view word) const {
    std::int64_t value = 0;
    if (!parse(word, value)) fail(in_quotes(word) + " found; accepted: an integer");
    return value;
}

void TextReader::fail(const std::string& what) const {
    throw InputError(path_ + ":" + std::to_string(line_), what);
}

}  // namespace transillum
