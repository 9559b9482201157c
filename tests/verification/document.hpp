#pragma once

#include <string>

#include "postproc/tables/table.hpp"

namespace cupola::verification {

/// A text of headings, paragraphs and tables, written as HTML and as Markdown at the same time.
class Document {
 public:
  void heading(int level, const std::string& text);
  void paragraph(const std::string& text);
  /// Every column is headed by its meaning.
  void table(const Table& table);

  std::string html(const std::string& title) const;
  const std::string& markdown() const { return markdown_; }

 private:
  std::string html_, markdown_;
};

}  // namespace cupola::verification
