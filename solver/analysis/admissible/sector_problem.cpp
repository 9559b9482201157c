#include "solver/analysis/admissible/sector_problem.hpp"

#include "solver/analysis/statics/cyclic_reduction.hpp"

namespace cupola {

SectorProblem::SectorProblem(const RigidScene& scene, int sectors)
    : scene_(scene), symmetry_(find_cyclic_symmetry(scene.model, scene.start, scene.contacts, sectors)) {
  problem_.contacts = reduce(scene.problem.contacts, symmetry_);
  const auto num_blocks = static_cast<Eigen::Index>(symmetry_.block_of_orbit.size());
  problem_.load.resize(6 * num_blocks);
  for (Eigen::Index k = 0; k < num_blocks; ++k)
    problem_.load.segment<6>(6 * k) =
        scene.problem.load.segment<6>(6 * Eigen::Index{symmetry_.block_of_orbit[static_cast<size_t>(k)]});
  problem_.cost = VecX::Zero(3 * problem_.contacts.num_contacts());
  problem_.load_columns = MatX(problem_.load.size(), 0);
  problem_.rows = MatX(problem_.cost.size(), 0);
}

std::optional<VecX> SectorProblem::coefficients(const VecX& whole, bool mean) const {
  constexpr double kSame =
      1e-6;  // of the largest coefficient; the symmetry itself is found to 1e-6 of a block
  const auto orbits = static_cast<Eigen::Index>(symmetry_.contact_of_orbit.size());
  const auto frame = [this](int contact) -> Mat3 { return scene_.problem.contacts.D_b[contact].frame; };
  const double different = kSame * (whole.size() > 0 ? whole.cwiseAbs().maxCoeff() : 0.0);
  VecX sum = VecX::Zero(3 * orbits);
  for (int i = 0; i < static_cast<int>(symmetry_.contacts.size()); ++i) {
    const CyclicSymmetry::Image& image = symmetry_.contacts[i];
    const int representative = symmetry_.contact_of_orbit[image.orbit];
    // The transpose of expand(), which gives the force of an image.
    const Vec3 term = (image.swapped ? -1.0 : 1.0) *
                      (frame(representative).transpose() *
                       (symmetry_.rotation(image.turns).transpose() * (frame(i) * whole.segment<3>(3 * i))));
    if (!mean && (term - whole.segment<3>(3 * representative)).cwiseAbs().maxCoeff() > different)
      return std::nullopt;
    sum.segment<3>(3 * image.orbit) += term;
  }
  return sum;
}

VecX SectorProblem::whole_forces(const VecX& gamma) const {
  return expand({VecX::Zero(problem_.load.size()), gamma}, scene_.problem.contacts, symmetry_).gamma;
}

}  // namespace cupola
