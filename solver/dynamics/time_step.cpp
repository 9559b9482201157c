#include "solver/dynamics/time_step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cupola {
namespace {

/// Rows of one body: u = [R_WC; r x R_WC]^T v, arm r from its centroid to the contact point.
Mat63 contact_columns(const Vec3& arm, const Mat3& R_WC) {
  Mat63 D;
  D.topRows<3>() = R_WC;
  for (int k = 0; k < 3; ++k) D.col(k).tail<3>() = arm.cross(R_WC.col(k));
  return D;
}

}  // namespace

Mat3 contact_frame(const Vec3& normal) {
  // The world axis least aligned with n gives a tangent of good length.
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  Mat3 R_WC;
  R_WC.col(0) = normal;
  R_WC.col(1) = normal.cross(Vec3::Unit(axis)).normalized();
  R_WC.col(2) = normal.cross(R_WC.col(1));
  return R_WC;
}

ContactProblem build_contact_problem(const Model& model, const State& state, const ContactSet& contacts,
                                     const ContactMemories& memories, const StepOptions& options) {
  ContactProblem problem;
  const int nb = model.num_free();
  const int nc = static_cast<int>(contacts.contacts.size());
  const double h = options.h;
  const double h_alpha = h + options.damping;
  problem.h = h;

  const VecX f = applied_forces(model, state);
  problem.M.resize(nb);
  problem.v_star = state.v;
  for (int i = 0; i < nb; ++i) {
    const int block = model.free_blocks[i];
    problem.M[i] = mass_matrix(model.assembly->blocks[block], state.poses[block].q_WB);
    problem.v_star.segment<6>(6 * i) += h * problem.M[i].llt().solve(f.segment<6>(6 * i));
  }

  problem.block_a.resize(nc);
  problem.block_b.resize(nc);
  problem.D_a.resize(nc);
  problem.D_b.resize(nc);
  problem.b = VecX::Zero(3 * nc);
  problem.E.resize(3 * nc);
  problem.mu.resize(nc);
  for (int i = 0; i < nc; ++i) {
    const Contact& contact = contacts.contacts[i];
    const ContactMemory& memory = memories.values[i];
    const Mat3 R_WC = contact_frame(contact.normal);
    // One point for both bodies, so that action and reaction have no moment when there is a gap.
    const Vec3 point = 0.5 * (contact.point_a + contact.point_b);
    problem.block_a[i] = model.free_index[contact.block_a];
    problem.block_b[i] = model.free_index[contact.block_b];
    problem.D_a[i] = -contact_columns(point - state.poses[contact.block_a].p_WB, R_WC);
    problem.D_b[i] = contact_columns(point - state.poses[contact.block_b].p_WB, R_WC);

    const JointLaw law = joint_law(model, contact);
    problem.mu[i] = law.mu;
    problem.E.segment<3>(3 * i) << law.compliance_normal, law.compliance_tangential,
        law.compliance_tangential;
    problem.E.segment<3>(3 * i) /= h * h_alpha;

    const double unexplained = std::max(contact.gap - memory.elastic_gap, -options.recovery_speed * h_alpha);
    problem.b[3 * i] = (memory.elastic_gap + unexplained) / h_alpha;
    if (options.tangential == TangentialSpring::memory) {
      const Vec3 slip_C = R_WC.transpose() * (state.poses[contact.block_a].q_WB * memory.elastic_slip_A);
      problem.b.segment<2>(3 * i + 1) = slip_C.tail<2>() / h_alpha;
    }
  }
  return problem;
}

void update_memories(const ContactProblem& problem, const ContactSolution& solution, const State& state,
                     const ContactSet& contacts, const StepOptions& options, ContactMemories* memories) {
  const VecX u = relative_velocity(problem, solution.v);
  const double h = options.h;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const Contact& contact = contacts.contacts[i];
    ContactMemory& memory = memories->values[i];
    const Vec3 gamma = solution.gamma.segment<3>(3 * i);
    const Vec3 b = problem.b.segment<3>(3 * i);
    const Vec3 u_el = -(b + problem.E.segment<3>(3 * i).cwiseProduct(gamma));
    memory.impulse = gamma;
    memory.elastic_gap = std::min(0.0, b[0] * (h + options.damping) + h * u_el[0]);
    if (gamma[0] <= 0.0) memory.elastic_gap = 0.0;
    memory.plastic_slip += gamma[0] > 0.0 ? h * (u.segment<2>(3 * i + 1) - u_el.tail<2>()).norm() : 0.0;

    const Vec3 slip_C = Vec3(0.0, b[1], b[2]) * (h + options.damping) + h * Vec3(0.0, u_el[1], u_el[2]);
    memory.elastic_slip_A =
        state.poses[contact.block_a].q_WB.conjugate() * (contact_frame(contact.normal) * slip_C);
    if (options.tangential == TangentialSpring::literal) memory.elastic_slip_A.setZero();
  }
}

ContactSolution warm_start(const State& state, const ContactMemories& memories) {
  ContactSolution guess;
  guess.v = state.v;
  guess.gamma.resize(3 * static_cast<Eigen::Index>(memories.values.size()));
  for (size_t i = 0; i < memories.values.size(); ++i)
    guess.gamma.segment<3>(3 * static_cast<Eigen::Index>(i)) = memories.values[i].impulse;
  return guess;
}

}  // namespace cupola
