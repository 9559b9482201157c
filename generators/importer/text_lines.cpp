#include "generators/importer/text_lines.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

constexpr std::string_view kWhite = " \t\r\v\f";

template <class T>
bool parse(std::string_view word, T* value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), *value);
  return error == std::errc() && end == word.data() + word.size();
}

/// The line up to a `#` at the start of a word.
std::string_view before_comment(std::string_view line, std::string_view between) {
  for (size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1))
    if (at == 0 || between.find(line[at - 1]) != std::string_view::npos) return line.substr(0, at);
  return line;
}

}  // namespace

TextLines::TextLines(std::string path, std::string_view separators, Backslash backslash)
    : path_(std::move(path)), text_(read_text(path_)), separators_(separators), backslash_(backslash) {}

bool TextLines::next() {
  words_.clear();
  while (position_ < text_.size()) {
    const size_t end = std::min(text_.find('\n', position_), text_.size());
    std::string_view line(text_.data() + position_, end - position_);
    position_ = std::min(end + 1, text_.size());
    ++line_;
    const size_t last = line.find_last_not_of(kWhite);
    bool continued =
        backslash_ == Backslash::continues && last != std::string_view::npos && line[last] == '\\';
    if (continued) line = line.substr(0, last);
    const std::string_view text = before_comment(line, std::string(kWhite) + std::string(separators_));
    continued = continued && text.size() == line.size();  // a comment may end so
    split(text);
    if (!words_.empty() && !continued) return true;
  }
  return !words_.empty();
}

void TextLines::split(std::string_view text) {
  constexpr size_t kNone = std::string_view::npos;
  const bool semicolons = separators_.find(';') != kNone && text.find(';') != kNone;
  const std::string_view separators = semicolons ? ";" : separators_;
  const std::string between = std::string(kWhite) + std::string(separators);
  for (size_t start = text.find_first_not_of(kWhite); start != kNone;) {
    const size_t stop = std::min(text.find_first_of(between, start), text.size());
    words_.push_back(text.substr(start, stop - start));
    start = text.find_first_not_of(kWhite, stop);
    if (start != kNone && separators.find(text[start]) != kNone)
      start = text.find_first_not_of(kWhite, start + 1);
  }
  while (!words_.empty() && words_.back().empty()) words_.pop_back();  // a table pads its short rows
}

std::string_view TextLines::rest(size_t word) const {
  if (word >= words_.size()) return {};
  return {words_[word].data(),
          static_cast<size_t>(words_.back().data() + words_.back().size() - words_[word].data())};
}

void TextLines::fail(const std::string& message) const {
  throw InputError(where(), subject_.empty() ? message : fmt::format("{}: {}", subject_, message));
}

double TextLines::number(size_t word, const std::string& context) const {
  double value = 0.0;
  if (word >= words_.size())
    fail(fmt::format("a number is missing after '{}', the line has {}{}", words_.back(),
                     counted(words_.size(), "word"), context));
  if (words_[word].empty()) fail(fmt::format("value {} of the row is empty, a number is required", word + 1));
  if (!parse(words_[word], &value) || !std::isfinite(value))
    fail(fmt::format("'{}' is not a finite number{}", words_[word], context));
  return value;
}

long TextLines::integer(size_t word) const {
  long value = 0;
  if (word >= words_.size())
    fail(fmt::format("a whole number is missing, the line has {}", counted(words_.size(), "word")));
  if (!parse(words_[word], &value)) fail(fmt::format("'{}' is not a whole number", words_[word]));
  return value;
}

Vec3 TextLines::point(size_t first) const {
  return {number(first), number(first + 1), number(first + 2)};
}

size_t TextLines::count(size_t word, size_t bytes_each) const {
  const long value = integer(word);
  if (value < 0 || static_cast<size_t>(value) > bytes_left() / bytes_each + 1)
    fail(fmt::format("declares {}, but the rest of the file has {}", counted(value, "item"),
                     counted(bytes_left(), "byte")));
  return static_cast<size_t>(value);
}

}  // namespace cupola
