#include "solver/dynamics/time_step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/dynamics/joint_damage.hpp"

namespace cupola {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Columns of D of one body: u = [R_WC; r x R_WC]^T v, with r (`arm`, m) from its centroid to the contact
/// point.
Mat63 contact_columns(const Vec3& arm, const Mat3& R_WC) {
  Mat63 D;
  D.topRows<3>() = R_WC;
  for (int k = 0; k < 3; ++k) D.col(k).tail<3>() = arm.cross(R_WC.col(k));
  return D;
}

void resize_rows(int num_rows, StepProblem* step) {
  ContactProblem& problem = step->problem;
  problem.block_a.resize(num_rows);
  problem.block_b.resize(num_rows);
  problem.D_a.resize(num_rows);
  problem.D_b.resize(num_rows);
  problem.b = VecX::Zero(3 * num_rows);
  problem.E.resize(3 * num_rows);
  problem.mu = VecX::Zero(num_rows);
  step->support_velocity = VecX::Zero(3 * num_rows);
}

void set_free_velocities(const Model& model, const State& state, const StepOptions& options,
                         ContactProblem* problem) {
  const int nb = model.num_free();
  const VecX f = applied_forces(model, state, state.time + options.load_advance());
  problem->M.resize(nb);
  problem->v_star = state.v;
  for (int i = 0; i < nb; ++i) {
    const int block = model.free_blocks[i];
    problem->M[i] = mass_matrix(model.assembly->blocks[block], state.poses[block].q_WB);
    problem->v_star.segment<6>(6 * i) += options.h * problem->M[i].llt().solve(f.segment<6>(6 * i));
  }
}

/// The three rows of a contact or tie between two blocks. The force on each block acts at its own point.
void set_row(const Model& model, const State& state, int row, int block_a, int block_b, const Vec3& point_a,
             const Vec3& point_b, const Mat3& R_WC, ContactProblem* problem) {
  problem->block_a[row] = model.free_index[block_a];
  problem->block_b[row] = model.free_index[block_b];
  problem->D_a[row] = -contact_columns(point_a - state.poses[block_a].p_WB, R_WC);
  problem->D_b[row] = contact_columns(point_b - state.poses[block_b].p_WB, R_WC);
}

void set_contact_rows(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories, const StepOptions& options, ContactProblem* problem) {
  const double h = options.h;
  const double h_alpha = h + options.damping;
  const double end = state.time + options.advance();
  for (int i = 0; i < static_cast<int>(contacts.points.size()); ++i) {
    const Contact& contact = contacts.points[i];
    const ContactMemory& memory = memories.values[i];
    CUPOLA_ASSERT(contact.block_a < contact.block_b);
    const Mat3 R_WC = contact_frame(contact.normal);
    // One point for both bodies, so that action and reaction have no net moment across a gap.
    const Vec3 point = 0.5 * (contact.point_a + contact.point_b);
    set_row(model, state, i, contact.block_a, contact.block_b, point, point, R_WC, problem);

    const JointLaw law = joint_law(model, contacts, contact, end);
    problem->mu[i] = law.mu;
    StepBond bond;
    if (model.joints.has_strength()) {
      bond = bond_in_step(law, memory.joint);
      problem->strength[i] = {h * bond.strength.tension, h * bond.strength.cohesion,
                              h * bond.strength.compression};
    }
    problem->E.segment<3>(3 * i) << law.compliance_normal, law.compliance_tangential,
        law.compliance_tangential;
    problem->E.segment<3>(3 * i) /= h * h_alpha;

    const double excess =
        std::max(contact.gap - bond.zero_gap - memory.elastic_gap, -options.recovery_speed * h_alpha);
    problem->b[3 * i] = (memory.elastic_gap + excess) / h_alpha;
    if (options.tangential == TangentialSpring::memory) {
      const Vec3 slip_C = R_WC.transpose() * (state.poses[contact.block_a].q_WB * memory.elastic_slip_A);
      problem->b.segment<2>(3 * i + 1) = slip_C.tail<2>() / h_alpha;
    }
  }
}

void set_tie_rows(const Model& model, const State& state, const StepOptions& options, int first_row,
                  ContactProblem* problem) {
  const double h_alpha = options.h + options.damping;
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const Tie& tie = model.ties[k];
    const int row = first_row + static_cast<int>(k);
    const TieGeometry now = tie_geometry(tie, state.poses);
    set_row(model, state, row, tie.block_a, tie.block_b, now.point_a, now.point_b, contact_frame(now.normal),
            problem);
    problem->E.segment<3>(3 * row).setConstant(tie.compliance / (options.h * h_alpha));
    problem->b[3 * row] = now.gap / h_alpha;
  }
}

/// Restricts all rows to motion in the x-z plane.
void drop_rows_out_of_plane(ContactProblem* problem) {
  problem->plane = true;
  for (std::vector<Mat63>* D : {&problem->D_a, &problem->D_b})
    for (Mat63& rows : *D)
      for (const int out : {1, 3, 5}) rows.row(out).setZero();
}

/// Adds the imposed velocities of supports to b.
void add_support_velocities(const Model& model, const State& state, const ContactSet& contacts,
                            const StepOptions& options, StepProblem* step) {
  std::vector<Pose> moved = state.poses;
  place_supports(*model.assembly, model.support_motions, state.time + options.advance(), &moved);
  const Eigen::Matrix<double, 6, Eigen::Dynamic> v = block_velocities(state.poses, moved, options.h);
  ContactProblem& problem = step->problem;
  for (int row = 0; row < problem.num_contacts(); ++row) {
    const bool is_contact = row < step->num_contacts;
    const size_t tie = is_contact ? 0 : static_cast<size_t>(row - step->num_contacts);
    const int a = is_contact ? contacts.points[row].block_a : model.ties[tie].block_a;
    const int b = is_contact ? contacts.points[row].block_b : model.ties[tie].block_b;
    step->support_velocity.segment<3>(3 * row) =
        problem.D_a[row].transpose() * v.col(a) + problem.D_b[row].transpose() * v.col(b);
  }
  problem.b += step->support_velocity;
}

}  // namespace

Mat3 contact_frame(const Vec3& normal) {
  CUPOLA_ASSERT(std::abs(normal.squaredNorm() - 1.0) < 1e-9);
  // The world axis least aligned with n gives the best conditioned cross product.
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  Mat3 R_WC;
  R_WC.col(0) = normal;
  R_WC.col(1) = normal.cross(Vec3::Unit(axis)).normalized();
  R_WC.col(2) = normal.cross(R_WC.col(1));
  return R_WC;
}

StepProblem build_step_problem(const Model& model, const State& state, const ContactSet& contacts,
                               const ContactMemories& memories, const StepOptions& options) {
  CUPOLA_ASSERT(options.h > 0.0);
  CUPOLA_ASSERT(state.v.size() == 6 * model.num_free());
  CUPOLA_ASSERT(memories.values.size() == contacts.points.size());
  StepProblem step;
  step.num_contacts = static_cast<int>(contacts.points.size());
  step.problem.h = options.h;
  resize_rows(step.num_contacts + static_cast<int>(model.ties.size()), &step);
  if (model.joints.has_strength()) step.problem.strength.resize(step.problem.block_a.size());
  set_free_velocities(model, state, options, &step.problem);
  set_contact_rows(model, state, contacts, memories, options, &step.problem);
  set_tie_rows(model, state, options, step.num_contacts, &step.problem);
  if (model.plane) drop_rows_out_of_plane(&step.problem);
  if (!model.support_motions.empty()) add_support_velocities(model, state, contacts, options, &step);
  return step;
}

void update_memories(const Model& model, const StepProblem& step, const ContactSolution& solution,
                     const State& state, const ContactSet& contacts, const StepOptions& options,
                     ContactMemories* memories) {
  const ContactProblem& problem = step.problem;
  CUPOLA_ASSERT(solution.gamma.size() == 3 * problem.num_contacts());
  CUPOLA_ASSERT(static_cast<int>(memories->values.size()) == step.num_contacts);
  const VecX u = relative_velocity(problem, solution.v) + step.support_velocity;
  const double h = options.h;
  for (int i = 0; i < step.num_contacts; ++i) {
    const Contact& contact = contacts.points[i];
    ContactMemory& memory = memories->values[i];
    const Vec3 gamma = solution.gamma.segment<3>(3 * i);
    const Vec3 b = problem.b.segment<3>(3 * i) - step.support_velocity.segment<3>(3 * i);
    const Vec3 u_el = -(b + problem.E.segment<3>(3 * i).cwiseProduct(gamma));
    memory.impulse = gamma;
    const double elastic_gap = b[0] * (h + options.damping) + h * u_el[0];
    const bool is_pulled = gamma[0] < 0.0 && !problem.strength.empty();
    memory.elastic_gap = is_pulled         ? std::max(0.0, elastic_gap)
                         : gamma[0] <= 0.0 ? 0.0
                                           : std::min(0.0, elastic_gap);
    const bool carries_shear = gamma[0] > 0.0 || (!problem.strength.empty() && !gamma.tail<2>().isZero(0.0));
    memory.plastic_slip += carries_shear ? h * (u.segment<2>(3 * i + 1) - u_el.tail<2>()).norm() : 0.0;
    if (!problem.strength.empty())
      add_inelastic_displacement(joint_law(model, contacts, contact, state.time + options.advance()),
                                 h * (u.segment<3>(3 * i) - u_el), gamma, &memory.joint);

    const Vec3 slip_C = Vec3(0.0, b[1], b[2]) * (h + options.damping) + h * Vec3(0.0, u_el[1], u_el[2]);
    memory.elastic_slip_A =
        state.poses[contact.block_a].q_WB.conjugate() * (contact_frame(contact.normal) * slip_C);
    if (options.tangential == TangentialSpring::literal) memory.elastic_slip_A.setZero();
  }
  const int num_ties = problem.num_contacts() - step.num_contacts;
  memories->tie_impulses.resize(num_ties);
  for (int k = 0; k < num_ties; ++k) memories->tie_impulses[k] = solution.gamma[3 * (step.num_contacts + k)];
}

ContactSolution warm_start(const StepProblem& step, const State& state, const ContactMemories& memories) {
  CUPOLA_ASSERT(static_cast<int>(memories.values.size()) == step.num_contacts);
  ContactSolution guess;
  guess.v = state.v;
  guess.gamma = VecX::Zero(step.problem.b.size());
  for (int i = 0; i < step.num_contacts; ++i) guess.gamma.segment<3>(3 * i) = memories.values[i].impulse;
  for (size_t k = 0; k < memories.tie_impulses.size(); ++k)
    guess.gamma[3 * (step.num_contacts + static_cast<int>(k))] = memories.tie_impulses[k];
  return guess;
}

}  // namespace cupola
