#include "solver/analysis/statics/model_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <Eigen/LU>
#include <fmt/format.h>

namespace cupola {
namespace {

// Relative to the size of a block. Rounding in the generator is 1e-14; imported coordinates have at least six
// digits.
constexpr double kTolerance = 1e-6;

/// What maps moments and angular velocities.
Mat3 axial(const Mat3& R) {
  return R.determinant() * R;
}

class SymmetryFinder {
 public:
  SymmetryFinder(const Model& model, const State& start, const ContactSet& contacts, const Mat3& R,
                 const Vec3& centre);
  ModelSymmetry find() const;

 private:
  [[noreturn]] void refuse(const std::string& reason) const { throw NotSymmetric(reason); }
  Vec3 image_of(const Vec3& point) const { return centre_ + R_ * (point - centre_); }
  std::vector<int> block_images() const;
  void check_block_image(int row, int image) const;
  std::vector<int> contact_images(const std::vector<int>& blocks, std::vector<char>* swapped) const;
  void check_contact_image(int contact, int image) const;
  std::pair<int, int> pair_of(const Contact& contact) const;
  Vec3 point_of(const Contact& contact) const { return 0.5 * (contact.point_a + contact.point_b); }
  double size_of(int row) const { return std::cbrt(model_.assembly->blocks[model_.free_blocks[row]].volume); }

  const Model& model_;
  const ContactSet& contacts_;
  double time_;
  std::vector<Vec3> centroids_;        ///< of the free blocks
  std::vector<Vec3> patch_centroids_;  ///< tell apart two patches that share a corner and a normal
  VecX loads_;
  Mat3 R_;
  Vec3 centre_;
};

SymmetryFinder::SymmetryFinder(const Model& model, const State& start, const ContactSet& contacts,
                               const Mat3& R, const Vec3& centre)
    : model_(model),
      contacts_(contacts),
      time_(start.time),
      loads_(applied_forces(model, start, start.time)),
      R_(R),
      centre_(centre) {
  for (int block : model.free_blocks) centroids_.push_back(start.poses[block].p_WB);
  for (const Patch& patch : contacts.patches) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : patch.polygon) sum += corner;
    patch_centroids_.push_back(sum / std::max<double>(1.0, static_cast<double>(patch.polygon.size())));
  }
}

/// Row of the image of each free block.
std::vector<int> SymmetryFinder::block_images() const {
  std::vector<int> by_x(centroids_.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  const auto x_of = [&](int row) { return centroids_[row].x(); };
  std::ranges::stable_sort(by_x, {}, x_of);
  std::vector<int> image(centroids_.size(), -1);
  for (int row = 0; row < static_cast<int>(centroids_.size()); ++row) {
    const Vec3 target = image_of(centroids_[row]);
    const double tolerance = kTolerance * size_of(row);
    auto it = std::ranges::lower_bound(by_x, target.x() - tolerance, {}, x_of);
    for (; it != by_x.end() && x_of(*it) <= target.x() + tolerance && image[row] < 0; ++it)
      if ((centroids_[*it] - target).norm() <= tolerance) image[row] = *it;
    if (image[row] < 0)
      refuse(fmt::format("the rotation moves block {} to ({:.3f}, {:.3f}, {:.3f}) m, where there is no block",
                         model_.free_blocks[row], target.x(), target.y(), target.z()));
    check_block_image(row, image[row]);
  }
  return image;
}

void SymmetryFinder::check_block_image(int row, int image) const {
  const Block& block = model_.assembly->blocks[model_.free_blocks[row]];
  const Block& other = model_.assembly->blocks[model_.free_blocks[image]];
  const Mat3 inertia = R_ * block.inertia * R_.transpose();
  if (std::abs(block.mass - other.mass) > kTolerance * block.mass ||
      (inertia - other.inertia).norm() > kTolerance * inertia.norm())
    refuse(fmt::format("blocks {} and {} have different masses or shapes", model_.free_blocks[row],
                       model_.free_blocks[image]));
  const auto force = [&](int i) -> Vec3 { return loads_.segment<3>(6 * i); };
  const auto moment = [&](int i) -> Vec3 { return loads_.segment<3>(6 * i + 3); };
  const double scale = kTolerance * (force(row).norm() + moment(row).norm() / size_of(row));
  if ((R_ * force(row) - force(image)).norm() > scale ||
      (axial(R_) * moment(row) - moment(image)).norm() > scale * size_of(row))
    refuse(fmt::format("the loads on blocks {} and {} differ", model_.free_blocks[row],
                       model_.free_blocks[image]));
}

/// Rows of the two blocks, the smaller first; all fixed blocks have the same row.
std::pair<int, int> SymmetryFinder::pair_of(const Contact& contact) const {
  return std::minmax(model_.free_index[contact.block_a], model_.free_index[contact.block_b]);
}

/// Image of each contact. Several contacts may lie at one point, with
/// different normals or in different patches; each is the image of exactly one contact.
std::vector<int> SymmetryFinder::contact_images(const std::vector<int>& blocks,
                                                std::vector<char>* swapped) const {
  const std::vector<Contact>& contacts = contacts_.points;
  std::vector<int> by_pair(contacts.size());
  std::iota(by_pair.begin(), by_pair.end(), 0);
  const auto key = [&](int i) { return pair_of(contacts[i]); };
  std::ranges::stable_sort(by_pair, {}, key);
  const auto turned_row = [&](int block) {
    const int row = model_.free_index[block];
    return row == ContactProblem::kFixed ? row : blocks[row];
  };
  std::vector<int> image(contacts.size(), -1);
  std::vector<char> taken(contacts.size(), 0);
  swapped->assign(contacts.size(), 0);
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
    const Contact& contact = contacts[i];
    const int row_a = turned_row(contact.block_a);
    const std::pair<int, int> rows(std::minmax(row_a, turned_row(contact.block_b)));
    const auto first = std::ranges::lower_bound(by_pair, rows, {}, key);
    const std::span<const int> candidates(first, std::ranges::upper_bound(by_pair, rows, {}, key));
    const Vec3 point = image_of(point_of(contact));
    const double size =
        size_of(std::max(model_.free_index[contact.block_a], model_.free_index[contact.block_b]));
    double nearest = kTolerance * size;
    for (int k : candidates) {
      const bool swaps = model_.free_index[contacts[k].block_a] != row_a;
      const Vec3 normal = (swaps ? -1.0 : 1.0) * (R_ * contact.normal);
      const double distance =
          (point_of(contacts[k]) - point).norm() + size * (contacts[k].normal - normal).norm() +
          (patch_centroids_[contacts[k].patch] - image_of(patch_centroids_[contact.patch])).norm();
      if (taken[k] || distance > nearest) continue;
      nearest = distance;
      image[i] = k;
      (*swapped)[i] = swaps;
    }
    if (image[i] < 0)
      refuse(fmt::format("the contact between blocks {} and {} at ({:.3f}, {:.3f}, {:.3f}) m has no image",
                         contact.block_a, contact.block_b, point_of(contact).x(), point_of(contact).y(),
                         point_of(contact).z()));
    taken[image[i]] = 1;
    check_contact_image(i, image[i]);
  }
  return image;
}

void SymmetryFinder::check_contact_image(int contact, int image) const {
  const Contact& c = contacts_.points[contact];
  const Contact& d = contacts_.points[image];
  const std::string between = fmt::format("between blocks {} and {}, and blocks {} and {}", c.block_a,
                                          c.block_b, d.block_a, d.block_b);
  const double size = size_of(std::max(model_.free_index[c.block_a], model_.free_index[c.block_b]));
  // Gaps act through their ratio to the small elastic penetrations. Coordinates are less accurate than 1e-12
  // of a block.
  if (std::abs(c.gap - d.gap) > 1e-12 * size + 1e-9 * std::abs(c.gap))
    refuse(fmt::format("the gaps of {:.3e} m and {:.3e} m differ {}", c.gap, d.gap, between));
  const JointLaw law = joint_law(model_, contacts_, c, time_);
  const JointLaw other = joint_law(model_, contacts_, d, time_);
  const auto differ = [](double x, double y) { return std::abs(x - y) > kTolerance * std::abs(x); };
  if (differ(law.mu, other.mu) || differ(law.compliance_normal, other.compliance_normal) ||
      differ(law.compliance_tangential, other.compliance_tangential) ||
      differ(law.strength.tension, other.strength.tension) ||
      differ(law.strength.cohesion, other.strength.cohesion) ||
      differ(law.strength.compression, other.strength.compression))
    refuse("the joint laws differ " + between);
}

ModelSymmetry SymmetryFinder::find() const {
  if (!model_.ties.empty()) refuse("ties are not supported");
  if (!model_.support_motions.empty()) refuse("moving supports are not supported");
  ModelSymmetry symmetry{R_, block_images(), {}, {}};
  symmetry.contacts = contact_images(symmetry.blocks, &symmetry.swapped);
  return symmetry;
}

}  // namespace

VecX ModelSymmetry::velocities(const VecX& v) const {
  VecX image(v.size());
  for (size_t k = 0; k < blocks.size(); ++k) {
    const Eigen::Index from = 6 * static_cast<Eigen::Index>(k), to = 6 * Eigen::Index{blocks[k]};
    image.segment<3>(to) = R * v.segment<3>(from);
    image.segment<3>(to + 3) = axial(R) * v.segment<3>(from + 3);
  }
  return image;
}

VecX ModelSymmetry::forces(const ContactProblem& problem, const VecX& gamma) const {
  const auto frame = [&](int contact) -> const Mat3& { return problem.D_b[contact].frame; };
  VecX image(gamma.size());
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const Vec3 force = R * (frame(i) * gamma.segment<3>(3 * i));
    image.segment<3>(3 * contacts[i]) = (swapped[i] ? -1.0 : 1.0) * (frame(contacts[i]).transpose() * force);
  }
  return image;
}

ModelSymmetry operator*(const ModelSymmetry& a, const ModelSymmetry& b) {
  ModelSymmetry product = b;
  product.R = a.R * b.R;
  for (int& block : product.blocks) block = a.blocks[block];
  for (size_t i = 0; i < b.contacts.size(); ++i) {
    product.swapped[i] = b.swapped[i] != a.swapped[b.contacts[i]];
    product.contacts[i] = a.contacts[b.contacts[i]];
  }
  return product;
}

ModelSymmetry find_symmetry(const Model& model, const State& start, const ContactSet& contacts, const Mat3& R,
                            const Vec3& centre) {
  return SymmetryFinder(model, start, contacts, R, centre).find();
}

}  // namespace cupola
