#include "postproc/studies/saltelli.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace cupola {
namespace {

/// Every `stride`-th number from `first`, n of them.
std::vector<size_t> numbers(size_t first, size_t stride, size_t n) {
  std::vector<size_t> rows;
  for (size_t j = 0; j < n; ++j) rows.push_back(first + j * stride);
  return rows;
}

/// Pairs one after the other, of `each` rows.
SaltelliDesign interleaved(size_t inputs, size_t each, size_t n) {
  SaltelliDesign design{numbers(0, each, n), numbers(each - 1, each, n), {}};
  for (size_t i = 0; i < inputs; ++i) design.a_b.push_back(numbers(1 + i, each, n));
  return design;
}

SaltelliDesign in_blocks(size_t inputs, size_t n) {
  SaltelliDesign design{numbers(0, 1, n), numbers(n, 1, n), {}};
  for (size_t i = 0; i < inputs; ++i) design.a_b.push_back(numbers((2 + i) * n, 1, n));
  return design;
}

bool fits(const SaltelliDesign& design, const Samples& samples) {
  bool differ = false;
  for (size_t j = 0; j < design.a.size(); ++j) {
    const auto &a = samples.rows[design.a[j]], &b = samples.rows[design.b[j]];
    differ = differ || a != b;
    for (size_t i = 0; i < design.a_b.size(); ++i) {
      std::vector<std::string> expected = a;
      expected[i] = b[i];
      if (samples.rows[design.a_b[i][j]] != expected) return false;
    }
  }
  return differ;
}

/// False if A and B are no samples of the same inputs: an input that takes few values, and others in A than in
/// B, is a column of a table of all combinations, which has the same members.
bool same_inputs(const SaltelliDesign& design, const Samples& samples) {
  for (size_t i = 0; i < design.a_b.size(); ++i) {
    std::set<std::string> a, b;
    for (const size_t row : design.a) a.insert(samples.rows[row][i]);
    for (const size_t row : design.b) b.insert(samples.rows[row][i]);
    const bool repeats = a.size() < design.a.size() || b.size() < design.b.size();
    if (repeats && std::ranges::none_of(a, [&b](const std::string& value) { return b.contains(value); }))
      return false;
  }
  return true;
}

IntervalEstimate share(const std::vector<double>& terms, double variance) {
  IntervalEstimate estimate = mean_of({terms, static_cast<int>(terms.size())});
  estimate.value /= variance;
  if (estimate.interval) {
    estimate.interval->low /= variance;
    estimate.interval->high /= variance;
  }
  return estimate;
}

}  // namespace

std::optional<SaltelliDesign> saltelli_design(const Samples& samples) {
  const size_t inputs = samples.keys.size(), rows = samples.rows.size();
  std::vector<SaltelliDesign> candidates;
  for (const size_t each : {inputs + 2, 2 * inputs + 2})
    if (rows % each == 0 && rows / each >= 2) candidates.push_back(interleaved(inputs, each, rows / each));
  if (rows % (inputs + 2) == 0 && rows / (inputs + 2) >= 2)
    candidates.push_back(in_blocks(inputs, rows / (inputs + 2)));
  for (const SaltelliDesign& design : candidates)
    if (fits(design, samples) && same_inputs(design, samples)) return design;
  return {};
}

SobolIndices sobol_indices(const SaltelliDesign& design, size_t input, const std::vector<double>& y) {
  std::vector<double> independent, first, total;
  for (size_t j = 0; j < design.a.size(); ++j) {
    const double a = y[design.a[j]], b = y[design.b[j]], ab = y[design.a_b[input][j]];
    if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(ab)) continue;
    independent.push_back(a);
    independent.push_back(b);
  }
  const double mean = mean_of({independent, 0}).value;
  for (size_t j = 0; j < design.a.size(); ++j) {
    const double a = y[design.a[j]], b = y[design.b[j]], ab = y[design.a_b[input][j]];
    if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(ab)) continue;
    first.push_back((b - mean) * (ab - a));
    total.push_back(0.5 * (a - ab) * (a - ab));
  }
  const double variance = std::pow(deviation_of(independent), 2);
  if (!(variance > 0.0)) return {{std::nan(""), {}}, {std::nan(""), {}}};
  return {share(first, variance), share(total, variance)};
}

}  // namespace cupola
