#include "postproc/studies/ensemble_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kTail = 0.025;  // beyond each end of an interval
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> known(const std::vector<double>& values) {
  std::vector<double> out;
  std::ranges::copy_if(values, std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

double average(const std::vector<double>& values) {
  return values.empty()
             ? kNan
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Interval of the mean of independent values; none if one is infinite.
std::optional<ConfidenceInterval> student(const std::vector<double>& values) {
  if (values.size() < 2 || known(values).size() < values.size()) return {};
  const double n = static_cast<double>(values.size()), mean = average(values);
  const double t = quantile(complement(boost::math::students_t(n - 1.0), kTail));
  const double half = t * deviation_of(values) / std::sqrt(n);
  return ConfidenceInterval{mean - half, mean + half};
}

/// The values from the least, infinite ones included.
std::vector<double> sorted_values(std::vector<double> values) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  std::ranges::sort(values);
  return values;
}

/// The sorted values of each replicate.
std::vector<std::vector<double>> groups_of(const DrawnValues& drawn) {
  const size_t count = static_cast<size_t>(drawn.replicates), size = drawn.values.size() / count;
  std::vector<std::vector<double>> groups;
  for (size_t i = 0; i < count; ++i) {
    const auto first = drawn.values.begin() + static_cast<std::ptrdiff_t>(i * size);
    if (auto group = sorted_values({first, first + static_cast<std::ptrdiff_t>(size)}); !group.empty())
      groups.push_back(std::move(group));
  }
  return groups;
}

double sorted_quantile(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(at), above = std::min(below + 1, sorted.size() - 1);
  const double beyond = at - static_cast<double>(below);
  if (beyond == 0.0 || std::isinf(sorted[below])) return sorted[below];
  return sorted[below] + beyond * (sorted[above] - sorted[below]);
}

/// The number of values below the quantile is binomial. Open ends where too few values lie beyond it.
std::optional<ConfidenceInterval> order_interval(const std::vector<double>& sorted, double p) {
  const int n = static_cast<int>(sorted.size());
  const boost::math::binomial_distribution<double> below(n, p);
  int low = -1, high = n;
  for (int k = 0; k < n; ++k) {
    if (k > 0 && cdf(below, k - 1) <= kTail) low = k - 1;  // P(X_(k) > quantile)
    if (high == n && cdf(complement(below, k)) <= kTail) high = k;
  }
  if (low < 0 || high == n) return {};
  return ConfidenceInterval{sorted[static_cast<size_t>(low)], sorted[static_cast<size_t>(high)]};
}

/// The shares of the replicates below a quantile scatter about p. Between the order statistics k and k + 1 a
/// share of k / n lies below. One more on either side: shares of small replicates may agree by chance.
std::optional<ConfidenceInterval> replicate_interval(const DrawnValues& drawn,
                                                     const std::vector<double>& sorted, double p) {
  std::vector<double> shares;
  for (const auto& group : groups_of(drawn))
    shares.push_back(
        static_cast<double>(std::ranges::upper_bound(group, sorted_quantile(sorted, p)) - group.begin()) /
        static_cast<double>(group.size()));
  const std::optional<ConfidenceInterval> share = student(shares);
  if (!share) return {};
  const double n = static_cast<double>(sorted.size()), half = 0.5 * (share->high - share->low);
  const double low = std::floor(n * (p - half)), high = std::ceil(n * (p + half));
  if (low < 1.0 || high >= n) return {};
  return ConfidenceInterval{sorted[static_cast<size_t>(std::max(low - 1.0, 1.0)) - 1],
                            sorted[static_cast<size_t>(std::min(high + 1.0, n - 1.0))]};
}

/// Ranks from 0, of ties their mean.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&values](size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (size_t first = 0; first < order.size();) {
    size_t end = first;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (size_t k = first; k < end; ++k) ranks[order[k]] = 0.5 * static_cast<double>(first + end - 1);
    first = end;
  }
  return ranks;
}

}  // namespace

ConfidenceInterval clopper_pearson(int hits, int trials) {
  CUPOLA_ASSERT(0 <= hits && hits <= trials && trials > 0);
  using boost::math::beta_distribution;
  ConfidenceInterval interval{0.0, 1.0};
  if (hits > 0) interval.low = quantile(beta_distribution<double>(hits, trials - hits + 1), kTail);
  if (hits < trials)
    interval.high = quantile(complement(beta_distribution<double>(hits + 1, trials - hits), kTail));
  return interval;
}

double mcnemar(int only_first, int only_second) {
  const int pairs = only_first + only_second;
  if (pairs == 0) return 1.0;
  const boost::math::binomial_distribution<double> even(pairs, 0.5);
  return std::min(1.0, 2.0 * cdf(even, std::min(only_first, only_second)));
}

IntervalEstimate mean_of(const DrawnValues& drawn) {
  IntervalEstimate mean{average(known(drawn.values)), {}};
  if (drawn.replicates == 0) return mean;
  std::vector<double> means;
  for (const auto& group : groups_of(drawn)) means.push_back(average(group));
  mean.interval = student(means);
  return mean;
}

IntervalEstimate quantile_of(const DrawnValues& drawn, double p) {
  const std::vector<double> sorted = sorted_values(drawn.values);
  if (sorted.empty()) return {kNan, {}};
  IntervalEstimate quantile{sorted_quantile(sorted, p), {}};
  if (drawn.replicates == 0) return quantile;
  quantile.interval = drawn.replicates == static_cast<int>(drawn.values.size())
                          ? order_interval(sorted, p)
                          : replicate_interval(drawn, sorted, p);
  return quantile;
}

double deviation_of(const std::vector<double>& values) {
  const std::vector<double> all = known(values);
  if (all.size() < 2) return kNan;
  const double mean = average(all);
  double sum = 0.0;
  for (const double v : all) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(all.size() - 1));
}

IntervalEstimate scatter_ratio(const DrawnValues& first, const DrawnValues& second) {
  CUPOLA_ASSERT(first.values.size() == second.values.size());
  std::vector<double> x, y;
  for (size_t i = 0; i < first.values.size(); ++i) {
    const double a = first.values[i], b = second.values[i];
    if (a <= 0.0 || b <= 0.0) return {kNan, {}};
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    x.push_back(std::log(a));
    y.push_back(std::log(b));
  }
  const double of_x = deviation_of(x), of_y = deviation_of(y), n = static_cast<double>(x.size());
  if (n < 3.0 || of_x == 0.0 || of_y == 0.0) return {kNan, {}};
  IntervalEstimate ratio{of_x / of_y, {}};
  if (static_cast<size_t>(first.replicates) != first.values.size()) return ratio;
  double covariance = 0.0;
  for (size_t i = 0; i < x.size(); ++i) covariance += (x[i] - average(x)) * (y[i] - average(y)) / (n - 1.0);
  const double r = covariance / (of_x * of_y);
  const double t = quantile(complement(boost::math::students_t(n - 2.0), kTail));
  const double k = 1.0 + 2.0 * std::max(1.0 - r * r, 0.0) * t * t / (n - 2.0), root = std::sqrt(k * k - 1.0);
  ratio.interval = {ratio.value * std::sqrt(k - root), ratio.value * std::sqrt(k + root)};
  return ratio;
}

double rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  CUPOLA_ASSERT(x.size() == y.size());
  const std::vector<double> a = ranks_of(x), b = ranks_of(y);
  const double middle = 0.5 * (static_cast<double>(x.size()) - 1.0);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - middle) * (a[i] - middle);
    bb += (b[i] - middle) * (b[i] - middle);
    ab += (a[i] - middle) * (b[i] - middle);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : kNan;
}

double first_order_index(const std::vector<double>& x, const std::vector<double>& y) {
  CUPOLA_ASSERT(x.size() == y.size());
  const double mean = average(y);
  std::vector<size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&x](size_t i) { return x[i]; });
  double pairs = 0.0, squares = 0.0;
  for (size_t k = 0; k < order.size(); ++k) {
    const double value = y[order[k]] - mean, next = y[order[(k + 1) % order.size()]] - mean;
    pairs += value * next;
    squares += value * value;
  }
  return squares > 0.0 ? pairs / squares : kNan;
}

}  // namespace cupola
