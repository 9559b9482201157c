#include "postproc/report/warnings.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "postproc/report/html.hpp"

namespace cupola {
namespace {

constexpr size_t kMostAlike = 3;  // warnings that are shown one by one

/// What two warnings about different blocks have in common: the words without a digit after the last colon,
/// before which the blocks are named.
std::string kind_of(const std::string& warning) {
  const size_t colon = warning.rfind(": ");
  std::istringstream words(colon == std::string::npos ? warning : warning.substr(colon));
  std::string kind;
  for (std::string word; words >> word;)
    if (std::ranges::none_of(word, [](char c) { return c >= '0' && c <= '9'; })) kind += word + " ";
  return kind;
}

/// Warnings alike.
struct Alike {
  std::string kind;
  std::vector<std::string> warnings;
};

std::vector<Alike> alike(const std::vector<std::string>& warnings) {
  std::vector<Alike> kinds;
  for (const std::string& warning : warnings) {
    const std::string kind = kind_of(warning);
    auto same = std::ranges::find(kinds, kind, &Alike::kind);
    if (same == kinds.end()) same = kinds.insert(kinds.end(), {kind, {}});
    same->warnings.push_back(warning);
  }
  return kinds;
}

}  // namespace

std::string warnings_html(const std::vector<std::string>& warnings) {
  std::string out;
  for (const Alike& some : alike(warnings)) {
    if (some.warnings.size() <= kMostAlike) {
      for (const std::string& warning : some.warnings)
        out += "<p class=\"warning\"><strong>Warning:</strong> " + html_text(warning) + "</p>\n";
      continue;
    }
    out += fmt::format(
        "<details class=\"warning\"><summary><strong>{} warnings</strong> like this: {}</summary>\n<ul>\n",
        some.warnings.size(), html_text(some.warnings.front()));
    for (const std::string& warning : some.warnings) out += "<li>" + html_text(warning) + "</li>\n";
    out += "</ul></details>\n";
  }
  return out;
}

std::vector<std::string> warning_lines(const std::vector<std::string>& warnings) {
  std::vector<std::string> lines;
  for (const Alike& some : alike(warnings))
    if (some.warnings.size() <= kMostAlike)
      lines.insert(lines.end(), some.warnings.begin(), some.warnings.end());
    else
      lines.push_back(fmt::format("{} like this: {}", some.warnings.size(), some.warnings.front()));
  return lines;
}

}  // namespace cupola
