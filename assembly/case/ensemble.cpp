#include "assembly/case/ensemble.hpp"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

#include <boost/math/distributions/normal.hpp>

#include "assembly/base/error.hpp"
#include "assembly/base/variant.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

/// Independent uniform numbers in (0, 1). The engine is fixed by the C++ standard, its distributions are not:
/// hence our own.
class UniformStream {
 public:
  /// Different names give different streams. FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo).
  UniformStream(int seed, const std::string& name) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : std::to_string(seed) + " " + name)
      hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    engine_.seed(hash);
  }
  double next() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/// Appends one number in each of n equal intervals of (0, 1), in random order.
void add_strata(int n, UniformStream* stream, std::vector<double>* values) {
  std::vector<int> order(static_cast<size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (size_t i = order.size() - 1; i > 0; --i)
    std::swap(order[i], order[static_cast<size_t>(stream->next() * static_cast<double>(i + 1))]);
  for (const int stratum : order) values->push_back((stratum + stream->next()) / n);
}

std::vector<double> uniform_numbers(const Ensemble& ensemble, const std::string& key) {
  UniformStream stream(ensemble.seed, key);
  std::vector<double> values;
  if (ensemble.design == Ensemble::Design::latin_hypercube) {
    for (int i = 0; i < Ensemble::kReplicates; ++i)
      add_strata(ensemble.members / Ensemble::kReplicates, &stream, &values);
  } else {
    for (int i = 0; i < ensemble.members; ++i) values.push_back(stream.next());
  }
  return values;
}

double standard_normal(double u) {
  return boost::math::quantile(boost::math::normal_distribution<double>(0.0, 1.0), u);
}

double lognormal(const LognormalValues& v, double u) {
  const double variance = std::log1p(std::pow(v.deviation / v.mean, 2));  // of the logarithm
  return v.mean * std::exp(std::sqrt(variance) * standard_normal(u) - 0.5 * variance);
}

double triangular(const TriangularValues& v, double u) {
  const double width = v.to - v.from, rise = v.mode - v.from;
  if (u * width < rise) return v.from + std::sqrt(u * width * rise);
  return v.to - std::sqrt((1.0 - u) * width * (v.to - v.mode));
}

const std::string& table_value(const TableOfValues& v, double u) {
  const auto weight = [&v](size_t i) { return v.weights.empty() ? 1.0 : v.weights[i]; };
  double total = 0.0, reached = 0.0;
  for (size_t i = 0; i < v.values.size(); ++i) total += weight(i);
  for (size_t i = 0; i + 1 < v.values.size(); ++i) {
    reached += weight(i);
    if (u * total < reached) return v.values[i];
  }
  return v.values.back();
}

}  // namespace

std::string value_at(const Distribution& distribution, double u) {
  CUPOLA_ASSERT(u > 0.0 && u < 1.0);
  return std::visit(
      Overloaded{
          [u](const NormalValues& v) { return format_number(v.mean + v.deviation * standard_normal(u)); },
          [u](const LognormalValues& v) { return format_number(lognormal(v, u)); },
          [u](const UniformValues& v) { return format_number(v.from + u * (v.to - v.from)); },
          [u](const TriangularValues& v) { return format_number(triangular(v, u)); },
          [u](const TableOfValues& v) { return table_value(v, u); },
          [u](const SeedValues&) { return std::to_string(static_cast<int>(u * 0x1p31)); }},
      distribution);
}

Samples draw_samples(const Ensemble& ensemble) {
  Samples samples;
  samples.rows.resize(static_cast<size_t>(ensemble.members));
  for (const VariedKey& varied : ensemble.vary) {
    samples.keys.push_back(varied.key);
    const std::vector<double> u = uniform_numbers(ensemble, varied.key);
    for (size_t i = 0; i < u.size(); ++i) samples.rows[i].push_back(value_at(varied.distribution, u[i]));
  }
  return samples;
}

}  // namespace cupola
