#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// A text file read line by line and split into words, with the place of each for messages.
class TextLines {
 public:
  /// `separators`: characters between words, besides white space.
  TextLines(std::string path, std::string_view separators = "");

  /// Moves to the next line that has words before any `#`; false at the end.
  bool next();
  const std::vector<std::string_view>& words() const { return words_; }
  FileLocation where() const { return {path_, line_, 0}; }
  size_t bytes_left() const { return text_.size() - position_; }
  const std::string& path() const { return path_; }

  /// What the lines from here on describe, for messages: "block 7".
  void enter(std::string subject) { subject_ = std::move(subject); }
  [[noreturn]] void fail(const std::string& message) const;  ///< InputError at this line
  double number(size_t word) const;                          ///< finite, or fails
  long integer(size_t word) const;
  Vec3 point(size_t first_word) const;
  /// A count that the rest of the file can hold at `bytes_each`, or fails.
  size_t count(size_t word, size_t bytes_each) const;

 private:
  std::string path_, text_, subject_;
  std::string_view separators_;
  size_t position_ = 0;
  int line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace cupola
