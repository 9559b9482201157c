#pragma once

#include <span>
#include <string>

#include <Eigen/Core>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// A random function of place, at each point lognormal with mean 1.
class RandomField {
 public:
  RandomField() = default;  ///< 1 everywhere
  /// `variation`: standard deviation over the mean, >= 0. The logarithm has the correlation exp(-(r /
  /// length)^2) over the distance r (m). Different quantities of one seed are independent.
  RandomField(int seed, const std::string& quantity, double length, double variation);

  double at(const Vec3& point) const;
  /// Share of all seeds whose value at this point is smaller: uniform in (0, 1), with the same correlation of
  /// the normal numbers behind it.
  double quantile_at(const Vec3& point) const;
  /// Mean over a convex polygon (m), by the values at the centroids of triangles with edges of at most half the
  /// correlation length, up to 1024 in each of those of a fan.
  double mean_over(std::span<const Vec3> polygon) const;
  bool is_constant() const { return deviation_ == 0.0; }
  double length() const { return length_; }  ///< m, over which the logarithm has the correlation 1/e

 private:
  double normal_at(const Vec3& point) const;

  Eigen::Matrix<double, Eigen::Dynamic, 3> waves_;  ///< 1/m (number of waves x 3)
  Eigen::ArrayXd phases_;
  double deviation_ = 0.0;  ///< of the logarithm
  double length_ = 1.0;     ///< m
};

}  // namespace cupola
