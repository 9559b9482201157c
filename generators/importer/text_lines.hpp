#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// A text file, read line by line and split into words. Messages name file and line.
class TextLines {
 public:
  /// What a `\` at the end of a line means.
  enum class Backslash : std::uint8_t { is_text, continues };

  /// `separators`: characters besides white space that separate words. Two of them enclose an empty word,
  /// except at the end of a line. If `;` is one, it is the only one of a line that has it: a comma there is
  /// that of a decimal.
  TextLines(std::string path, std::string_view separators = "", Backslash backslash = Backslash::is_text);

  /// Moves to the next line with words. A `#` at the start of a word begins a comment. Returns false at the
  /// end of the file.
  bool next();
  const std::vector<std::string_view>& words() const { return words_; }
  /// The line from a word to the end of the last word, as written; empty without that word.
  std::string_view rest(size_t word) const;
  FileLocation where() const { return {path_, line_, 0}; }
  size_t bytes_left() const { return text_.size() - position_; }
  const std::string& path() const { return path_; }

  /// Sets the prefix of messages for the following lines, e.g. "block 7".
  void enter(std::string subject) { subject_ = std::move(subject); }
  [[noreturn]] void fail(const std::string& message) const;  ///< throws InputError for this line
  /// Fails if it is not finite; `context` ends the message.
  double number(size_t word, const std::string& context = "") const;
  long integer(size_t word) const;
  Vec3 point(size_t first_word) const;
  /// A count of items; fails if the rest of the file is too short for them at `bytes_each`.
  size_t count(size_t word, size_t bytes_each) const;

 private:
  void split(std::string_view text);  ///< appends its words

  std::string path_, text_, subject_;
  std::string_view separators_;
  Backslash backslash_;
  size_t position_ = 0;
  int line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace cupola
