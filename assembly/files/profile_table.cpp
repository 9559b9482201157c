#include "assembly/files/profile_table.hpp"

#include <algorithm>
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
    if (!all && table.r.empty() && !is_number(words[0], values.data())) continue;  // a heading
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
