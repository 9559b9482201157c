#include "assembly/files/profile_table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

/// The words of a line without its comment.
std::vector<std::string> words_of(std::string line) {
  line.erase(std::find(line.begin(), line.end(), '#'), line.end());
  std::ranges::replace(line, ',', ' ');
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool is_number(const std::string& word, double* value) {
  std::istringstream in(word);
  return static_cast<bool>(in >> *value) && in.eof() && std::isfinite(*value);
}

/// The names of columns in a heading, without their units: r of `r (m)` and of `r_m`.
std::vector<std::string> names_of(const std::vector<std::string>& heading) {
  std::vector<std::string> names;
  for (const std::string& word : heading) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    if (word.front() == '(' || word.front() == '[') continue;
    const auto first = std::ranges::find_if(word, is_letter);  // behind quotation marks
    names.emplace_back(first, std::find_if_not(first, word.end(), is_letter));
  }
  return names;
}

bool is_heading(const std::vector<std::string>& words) {
  const std::vector<std::string> names = names_of(words), columns{"r", "z", "radius"};
  return names.size() > 1 && names.size() < 4 && std::equal(names.begin(), names.end(), columns.begin());
}

}  // namespace

ProfileTable read_profile_table(const std::string& path) {
  ProfileTable table;
  std::istringstream lines(read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    std::vector<double> values(words.size());
    bool all = true;
    for (size_t i = 0; i < words.size(); ++i) all = is_number(words[i], &values[i]) && all;
    if (!all && table.r.empty() && !is_number(words[0], values.data())) {
      if (is_heading(words)) continue;
      throw InputError({path, number, 1},
                       "the columns must be r, z and perhaps radius, in this order; this heading names "
                       "others");
    }
    if (!all || words.size() < 2 || words.size() > 3)
      throw InputError({path, number, 1},
                       "expected two or three numbers: r (m), z (m) and perhaps the radius (m)");
    table.r.push_back(values[0]);
    table.z.push_back(values[1]);
    table.radius.push_back(words.size() > 2 ? values[2] : 0.0);
  }
  if (table.r.size() < 2)
    throw InputError(
        {path, 0, 0},
        "has fewer than two points; expected the columns r (m) and z (m), from the springing upwards");
  return table;
}

void scale_to_span(double span, ProfileTable* table) {
  const double scale = 0.5 * span / table->r.front();
  for (std::vector<double>* lengths : {&table->r, &table->z, &table->radius})
    for (double& length : *lengths) length *= scale;
  for (std::optional<CurveControls>& curve : table->curves)
    if (curve) curve = CurveControls{scale * curve->first, scale * curve->second};
  table->r.front() = 0.5 * span;
}

}  // namespace cupola
