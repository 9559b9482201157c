#include <algorithm>
#include <cmath>
#include <numeric>

#include "assembly/base/error.hpp"
#include "postproc/claims/quantity.hpp"

namespace cupola {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double squared_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean(x), my = mean(y);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
    xy += (x[i] - mx) * (y[i] - my);
  }
  return xy * xy / (xx * yy);
}

double variation(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - m) * (v - m);
  return std::sqrt(sum / static_cast<double>(values.size())) / std::abs(m);
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double roughness(const std::vector<double>& values) {
  if (values.size() < 3) return 0.0;
  double sum = 0.0;
  for (size_t i = 1; i + 1 < values.size(); ++i)
    sum += std::abs(values[i - 1] - 2.0 * values[i] + values[i + 1]);
  return sum / static_cast<double>(values.size() - 2) / std::abs(mean(values));
}

}  // namespace

double reduce(Take take, const std::vector<double>& values, const std::vector<double>& against) {
  if (take == Take::count) return static_cast<double>(values.size());
  if (take == Take::sum) return std::accumulate(values.begin(), values.end(), 0.0);
  CUPOLA_ASSERT(!values.empty());
  CUPOLA_ASSERT(take != Take::linearity || against.size() == values.size());
  const auto [smallest, largest] = std::minmax_element(values.begin(), values.end());
  switch (take) {
    case Take::only:
    case Take::first:
      return values.front();
    case Take::mean:
      return mean(values);
    case Take::median:
      return median(values);
    case Take::largest:
      return *largest;
    case Take::smallest:
      return *smallest;
    case Take::last:
      return values.back();
    case Take::sum:
    case Take::count:
      break;  // above
    case Take::spread:
      return (*largest - *smallest) / std::abs(mean(values));
    case Take::variation:
      return variation(values);
    case Take::rms:
      return root_mean_square(values);
    case Take::linearity:
      return squared_correlation(values, against);
    case Take::roughness:
      return roughness(values);
  }
  return 0.0;
}

}  // namespace cupola
