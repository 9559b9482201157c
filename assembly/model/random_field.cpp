#include "assembly/model/random_field.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// The kurtosis of the sum of n random waves is 3 - 1.5 / n.
constexpr int kWaves = 128;

/// Uniform in (0, 1); the distributions of the standard library differ between its implementations, the
/// engine does not.
double uniform(std::mt19937_64* engine) {
  return (static_cast<double>((*engine)() >> 11) + 0.5) * 0x1p-53;
}

/// Mean of a field over a triangle, by the centroids of its parts, `along` along each edge.
double mean_of_triangle(const RandomField& field, const Vec3& a, const Vec3& b, const Vec3& c, int along) {
  double sum = 0.0;
  const auto add = [&](int of_b, int of_c) {  // in thirds of a part
    const int all = 3 * along;
    sum += field.at(((all - of_b - of_c) * a + of_b * b + of_c * c) / all);
  };
  for (int i = 0; i < along; ++i)
    for (int j = 0; i + j < along; ++j) {
      add(3 * i + 1, 3 * j + 1);
      if (i + j + 1 < along) add(3 * i + 2, 3 * j + 2);
    }
  return sum / (along * along);
}

double compute_mean(const RandomField& field, std::span<const Vec3> polygon) {
  constexpr double kResolved = 0.5;  // of the correlation length, of an edge of a part
  // Of a part of the longest edge; beyond, the mean of 1024 independent values varies by a thirtieth as much.
  constexpr double kMost = 32.0;
  double area = 0.0, sum = 0.0;
  for (size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
    const double part = (b - a).cross(c - a).norm();
    area += part;
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double along = std::clamp(std::ceil(longest / (kResolved * field.length())), 1.0, kMost);
    if (part > 0.0) sum += part * mean_of_triangle(field, a, b, c, static_cast<int>(along));
  }
  if (area > 0.0) return sum / area;
  Vec3 middle = Vec3::Zero();  // blocks that touch at an edge or a corner
  for (const Vec3& point : polygon) middle += point;
  return field.at(middle / static_cast<double>(polygon.size()));
}

/// Mean of a field over a polygon that was asked for lately.
struct KnownMean {
  std::vector<Vec3> polygon;  ///< empty: none yet
  double value = 1.0;
};
struct KnownMeans {
  RandomField field;
  std::vector<KnownMean> of_polygons = {};
};
constexpr size_t kKnownFields = 3;  // friction, strength and compliance of one case
constexpr size_t kKnownPolygons = 1 << 14;

size_t slot_of(std::span<const Vec3> polygon) {
  std::uint64_t hash = 0;
  for (const double x :
       {polygon[0].x(), polygon[0].y(), polygon[0].z(), polygon.back().x(), polygon.back().z()})
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
  return static_cast<size_t>(hash >> 50);
}
static_assert(kKnownPolygons == 1 << (64 - 50));

}  // namespace

// Spectral representation with random wave vectors and phases (M. Shinozuka, 1971, J. Acoust. Soc. Am. 49,
// 357-367): the logarithm is s sqrt(2 / n) sum cos(k_j x + phi_j) - s^2 / 2. Wave vectors of the correlation
// exp(-(r / l)^2) are normal with the deviation sqrt(2) / l (its Fourier transform); they are drawn by Box
// and Muller.
RandomField::RandomField(int seed, const std::string& quantity, double length, double variation) {
  CUPOLA_ASSERT(length > 0.0 && variation >= 0.0);
  if (variation == 0.0) return;
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : std::to_string(seed) + " " + quantity)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  std::mt19937_64 engine(hash);
  deviation_ = std::sqrt(std::log1p(variation * variation));
  length_ = length;
  waves_.resize(kWaves, 3);
  phases_.resize(kWaves);
  for (int j = 0; j < kWaves; ++j) {
    for (int axis = 0; axis < 3; ++axis) {
      const double radius = std::sqrt(-2.0 * std::log(uniform(&engine)));
      waves_(j, axis) =
          std::numbers::sqrt2 / length * radius * std::cos(2.0 * std::numbers::pi * uniform(&engine));
    }
    phases_[j] = 2.0 * std::numbers::pi * uniform(&engine);
  }
}

double RandomField::normal_at(const Vec3& point) const {
  return std::sqrt(2.0 / kWaves) * ((waves_ * point).array() + phases_).cos().sum();
}

double RandomField::at(const Vec3& point) const {
  if (is_constant()) return 1.0;
  return std::exp(deviation_ * normal_at(point) - 0.5 * deviation_ * deviation_);
}

double RandomField::quantile_at(const Vec3& point) const {
  CUPOLA_ASSERT(!is_constant());
  return 0.5 * std::erfc(-normal_at(point) / std::numbers::sqrt2);
}

double RandomField::mean_over(std::span<const Vec3> polygon) const {
  if (is_constant()) return 1.0;
  CUPOLA_ASSERT(!polygon.empty());
  // A law is asked for at every contact point of a joint, several times in a step. What is remembered is
  // compared by value, so that it changes no result, and belongs to one thread.
  thread_local std::array<KnownMeans, kKnownFields> known;
  thread_local size_t oldest = 0;
  // Fields with equal phases have the same random numbers, so that their waves differ by the length only.
  const auto same = [this](const KnownMeans& means) {
    return means.field.deviation_ == deviation_ && means.field.waves_(0, 0) == waves_(0, 0) &&
           (means.field.phases_ == phases_).all();
  };
  auto means = std::ranges::find_if(known, same);
  if (means == known.end()) {
    means = known.begin() + static_cast<std::ptrdiff_t>(oldest);
    *means = {*this, std::vector<KnownMean>(kKnownPolygons)};
    oldest = (oldest + 1) % kKnownFields;
  }
  KnownMean& mean = means->of_polygons[slot_of(polygon)];
  if (!std::ranges::equal(mean.polygon, polygon)) {
    mean.polygon.assign(polygon.begin(), polygon.end());
    mean.value = compute_mean(*this, polygon);
  }
  return mean.value;
}

}  // namespace cupola
