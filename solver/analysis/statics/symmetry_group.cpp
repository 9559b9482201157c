#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "solver/analysis/statics/model_symmetry.hpp"

namespace cupola {
namespace {

Vec3 centre_of_mass(const Model& model, const State& start) {
  Vec3 sum = Vec3::Zero();
  double mass = 0.0;
  for (const int block : model.free_blocks) {
    sum += model.assembly->blocks[block].mass * start.poses[block].p_WB;
    mass += model.assembly->blocks[block].mass;
  }
  return sum / mass;
}

/// Azimuths about the centre of the contacts on which a symmetry could map the one farthest from the axis, or
/// that one. Their number is a multiple of that of equal sectors.
std::vector<double> azimuths_of_farthest(const ContactSet& contacts, const Vec3& centre) {
  constexpr double kSame = 1e-6;  // of the distance from the axis
  std::vector<Vec3> places;
  for (const Contact& contact : contacts.points)
    places.push_back(0.5 * (contact.point_a + contact.point_b) - centre);
  if (places.empty()) return {};
  const auto distance = [](const Vec3& place) { return place.head<2>().norm(); };
  const Vec3 farthest = *std::ranges::max_element(places, {}, distance);
  const double same = kSame * distance(farthest);
  std::vector<double> azimuths;
  for (const Vec3& place : places)
    if (std::abs(distance(place) - distance(farthest)) <= same && std::abs(place.z() - farthest.z()) <= same)
      azimuths.push_back(std::atan2(place.y(), place.x()));
  return azimuths;
}

Mat3 rotation(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

/// In the vertical plane that halves the angle between two azimuths.
Mat3 reflection(double azimuth, double other) {
  return rotation(azimuth + other) * Vec3(1.0, -1.0, 1.0).asDiagonal();
}

class SymmetrySearch {
 public:
  SymmetrySearch(const Model& model, const State& start, const ContactSet& contacts)
      : model_(model),
        start_(start),
        contacts_(contacts),
        centre_(centre_of_mass(model, start)),
        azimuths_(azimuths_of_farthest(contacts, centre_)) {}

  /// The smallest rotation.
  std::optional<ModelSymmetry> turn() const {
    const int most = static_cast<int>(azimuths_.size());
    for (int sectors = most; sectors > 1; --sectors)
      if (most % sectors == 0)
        if (auto found = symmetry(rotation(2.0 * std::numbers::pi / sectors))) return found;
    return std::nullopt;
  }
  /// Any reflection.
  std::optional<ModelSymmetry> mirror() const {
    for (const double other : azimuths_)
      if (auto found = symmetry(reflection(azimuths_.front(), other))) return found;
    return std::nullopt;
  }

 private:
  std::optional<ModelSymmetry> symmetry(const Mat3& R) const {
    try {
      return find_symmetry(model_, start_, contacts_, R, centre_);
    } catch (const NotSymmetric&) {  // it has not this one
      return std::nullopt;
    }
  }

  const Model& model_;
  const State& start_;
  const ContactSet& contacts_;
  Vec3 centre_;
  std::vector<double> azimuths_;
};

/// turn, turn^2, ... without the identity.
std::vector<ModelSymmetry> powers(const ModelSymmetry& turn) {
  constexpr double kRounding = 1e-9;  // of thousands of products
  std::vector<ModelSymmetry> powers{turn};
  while (true) {
    ModelSymmetry next = turn * powers.back();
    if (next.R.isIdentity(kRounding)) return powers;
    powers.push_back(std::move(next));
  }
}

}  // namespace

int num_equal_sectors(const Model& model, const State& start, const ContactSet& contacts) {
  const std::optional<ModelSymmetry> turn = SymmetrySearch(model, start, contacts).turn();
  return turn ? static_cast<int>(powers(*turn).size()) + 1 : 1;
}

std::vector<ModelSymmetry> find_symmetries(const Model& model, const State& start,
                                           const ContactSet& contacts) {
  const SymmetrySearch search(model, start, contacts);
  std::vector<ModelSymmetry> group;
  if (const auto turn = search.turn()) group = powers(*turn);
  if (const auto mirror = search.mirror()) {
    const size_t rotations = group.size();
    group.push_back(*mirror);
    for (size_t k = 0; k < rotations; ++k) group.push_back(group[k] * *mirror);
  }
  return group;
}

}  // namespace cupola
