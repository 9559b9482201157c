#include <algorithm>

#include "assembly/base/error.hpp"
#include "solver/analysis/direct_limit.hpp"
#include "solver/conic/conic_bounds.hpp"
#include "solver/conic/solve_conic.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {
namespace {

// Rows of the equilibrium of the block between the sides of a contact: its force in world axes, and gamma_n + slack =
// p A in a row of the rotations, that of rot y, which plane problems keep.
constexpr int kStressRow = 4;

/// The rigid scene with a block in every contact point. Contacts: those of the scene, from block a to the block in
/// between; those from there to block b; one per point without friction, whose force is what the stress lacks to p.
class StressProblem {
 public:
  explicit StressProblem(const RigidScene& rigid) : rigid_(rigid) {
    const ContactProblem& original = rigid.problem.contacts;
    ContactProblem& p = problem_.contacts;
    p = original;
    double mass = 0.0;
    for (const Mat6& M : original.M) mass += M(0, 0) / original.num_blocks();
    const int num_points = static_cast<int>(rigid.contacts.points.size());
    p.M.resize(p.M.size() + static_cast<size_t>(num_points), mass * Mat6::Identity());
    for (int i = 0; i < num_points; ++i) insert_block(i, original.num_blocks() + i);
    fill_vectors();
  }
  const ConicProblem& problem() const { return problem_; }

 private:
  /// Force in world axes of a unit force in the contact frame.
  Mat63 force_rows(int point) const {
    Mat63 D = Mat63::Zero();
    D.topRows<3>() = contact_frame(rigid_.contacts.points[point].normal);
    if (problem_.contacts.plane) D.row(1).setZero();
    return D;
  }
  void insert_block(int point, int between) {
    ContactProblem& p = problem_.contacts;
    const int block_b = p.block_b[point];
    const Mat63 D_b = p.D_b[point], force = force_rows(point);
    Mat63 stress = Mat63::Zero();
    stress(kStressRow, 0) = 1.0;
    p.block_b[point] = between;
    p.D_b[point] = force + stress;
    add(between, block_b, -force, D_b, p.mu[point]);
    add(ContactProblem::kFixed, between, Mat63::Zero(), stress, 0.0);
  }
  void add(int a, int b, const Mat63& D_a, const Mat63& D_b, double mu) {
    ContactProblem& p = problem_.contacts;
    p.block_a.push_back(a);
    p.block_b.push_back(b);
    p.D_a.push_back(D_a);
    p.D_b.push_back(D_b);
    added_mu_.push_back(mu);
  }
  void fill_vectors() {
    ContactProblem& p = problem_.contacts;
    const Eigen::Index nb = p.num_blocks(), nc = p.num_contacts(), old = p.mu.size();
    p.mu.conservativeResize(nc);
    for (size_t k = 0; k < added_mu_.size(); ++k) p.mu[old + static_cast<Eigen::Index>(k)] = added_mu_[k];
    p.v_star = VecX::Zero(6 * nb);
    p.b = VecX::Zero(3 * nc);
    p.E = VecX::Zero(3 * nc);
    problem_.load = VecX::Zero(6 * nb);
    problem_.load.head(rigid_.problem.load.size()) = rigid_.problem.load;
    problem_.cost = VecX::Zero(3 * nc);
    problem_.rows = MatX(3 * nc, 0);
    VecX areas = VecX::Zero(6 * nb);
    const Eigen::Index first = rigid_.problem.contacts.num_blocks();
    for (size_t i = 0; i < rigid_.contacts.points.size(); ++i)
      areas[6 * (first + static_cast<Eigen::Index>(i)) + kStressRow] = -rigid_.contacts.points[i].area;
    problem_ = with_multiplier(std::move(problem_), areas, 1.0);
  }

  const RigidScene& rigid_;
  ConicProblem problem_;
  std::vector<double> added_mu_;
};

}  // namespace

DirectLimit least_peak_stress(const Case& scene, RigidScene rigid, const ReportTrial& report) {
  if (scene.joints.compliance.per != Compliance::Per::area)
    throw InputError(
        "analysis.limit.parameter: peak_stress requires joints.compliance.per: area, with which contact "
        "points "
        "stand for areas");
  const ConicProblem problem = StressProblem(rigid).problem();
  const ConicSolution solution = solve_conic(problem);
  DirectLimit limit;
  limit.trials = 1;
  limit.iterations = solution.iterations;
  if (solution.outcome == ConicOutcome::infeasible) {
    limit.no_state = true;
    limit.message = "no admissible state exists, whatever the stress";
    return limit;
  }
  const ConicBounds bounds = conic_bounds(problem, solution);
  report({bounds.upper, true, {}, solution.iterations});
  limit.found = true;
  limit.admissible = bounds.upper;
  limit.moving = std::min(bounds.lower, bounds.upper);
  limit.gamma = solution.gamma.head(rigid.problem.cost.size());
  limit.at_admissible = std::move(rigid);
  return limit;
}

}  // namespace cupola
