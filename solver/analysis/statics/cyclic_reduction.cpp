#include "solver/analysis/statics/cyclic_reduction.hpp"

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Rotates the translational and the rotational half of generalised velocities.
Vec6 rotated(const Mat3& R, const Vec6& x) {
  Vec6 y;
  y << R * x.head<3>(), R * x.tail<3>();
  return y;
}

}  // namespace

ContactProblem reduce(const ContactProblem& problem, const CyclicSymmetry& symmetry) {
  CUPOLA_ASSERT(static_cast<int>(symmetry.blocks.size()) == problem.num_blocks());
  CUPOLA_ASSERT(static_cast<int>(symmetry.contacts.size()) == problem.num_contacts());
  ContactProblem reduced;
  reduced.h = problem.h;
  const int nb = static_cast<int>(symmetry.block_of_orbit.size());
  const int nc = static_cast<int>(symmetry.contact_of_orbit.size());
  reduced.v_star.resize(6 * nb);
  for (int i = 0; i < nb; ++i) {
    const int row = symmetry.block_of_orbit[i];
    reduced.M.push_back(problem.M[row]);
    reduced.v_star.segment<6>(6 * i) = problem.v_star.segment<6>(6 * row);
  }
  reduced.b.resize(3 * nc);
  reduced.E.resize(3 * nc);
  reduced.mu.resize(nc);
  for (int i = 0; i < nc; ++i) {
    const int row = symmetry.contact_of_orbit[i];
    reduced.b.segment<3>(3 * i) = problem.b.segment<3>(3 * row);
    reduced.E.segment<3>(3 * i) = problem.E.segment<3>(3 * row);
    reduced.mu[i] = problem.mu[row];
    if (!problem.strength.empty()) reduced.strength.push_back(problem.strength[row]);
    // u = D^T v and v = R v_representative, so that the columns of the representative are R^T D.
    const auto add_side = [&](int block, const Lever& D, std::vector<int>* blocks,
                              std::vector<Lever>* sides) {
      const bool fixed = block == ContactProblem::kFixed;
      blocks->push_back(fixed ? block : symmetry.blocks[block].orbit);
      const Mat3 R = fixed ? Mat3::Identity() : symmetry.rotation(-symmetry.blocks[block].turns);
      sides->push_back({R * D.frame, R * D.arm});
    };
    add_side(problem.block_a[row], problem.D_a[row], &reduced.block_a, &reduced.D_a);
    add_side(problem.block_b[row], problem.D_b[row], &reduced.block_b, &reduced.D_b);
  }
  return reduced;
}

ContactSolution restrict(const ContactSolution& whole, const CyclicSymmetry& symmetry) {
  ContactSolution reduced;
  if (whole.v.size() > 0) {
    reduced.v.resize(6 * static_cast<Eigen::Index>(symmetry.block_of_orbit.size()));
    for (size_t i = 0; i < symmetry.block_of_orbit.size(); ++i)
      reduced.v.segment<6>(6 * i) = whole.v.segment<6>(6 * symmetry.block_of_orbit[i]);
  }
  if (whole.gamma.size() > 0) {
    reduced.gamma.resize(3 * static_cast<Eigen::Index>(symmetry.contact_of_orbit.size()));
    for (size_t i = 0; i < symmetry.contact_of_orbit.size(); ++i)
      reduced.gamma.segment<3>(3 * i) = whole.gamma.segment<3>(3 * symmetry.contact_of_orbit[i]);
  }
  return reduced;
}

ContactSolution expand(const ContactSolution& reduced, const ContactProblem& problem,
                       const CyclicSymmetry& symmetry) {
  CUPOLA_ASSERT(reduced.v.size() == 6 * static_cast<Eigen::Index>(symmetry.block_of_orbit.size()));
  CUPOLA_ASSERT(reduced.gamma.size() == 3 * static_cast<Eigen::Index>(symmetry.contact_of_orbit.size()));
  ContactSolution whole;
  whole.v.resize(6 * problem.num_blocks());
  for (int i = 0; i < problem.num_blocks(); ++i) {
    const CyclicSymmetry::Image& image = symmetry.blocks[i];
    const Vec6 v = reduced.v.segment<6>(6 * image.orbit);
    whole.v.segment<6>(6 * i) = rotated(symmetry.rotation(image.turns), v);
  }
  whole.gamma.resize(3 * problem.num_contacts());
  const auto frame = [&](int contact) -> const Mat3& { return problem.D_b[contact].frame; };
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const CyclicSymmetry::Image& image = symmetry.contacts[i];
    const Vec3 impulse =
        frame(symmetry.contact_of_orbit[image.orbit]) * reduced.gamma.segment<3>(3 * image.orbit);
    whole.gamma.segment<3>(3 * i) =
        (image.swapped ? -1.0 : 1.0) * (frame(i).transpose() * (symmetry.rotation(image.turns) * impulse));
  }
  return whole;
}

}  // namespace cupola
