#include "solver/dynamics/time_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/dynamics/joint_damage.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

void resize_rows(int num_rows, StepProblem* step) {
  ContactProblem& problem = step->problem;
  problem.block_a.resize(num_rows);
  problem.block_b.resize(num_rows);
  problem.D_a.resize(num_rows);
  problem.D_b.resize(num_rows);
  problem.b = VecX::Zero(3 * num_rows);
  problem.E.resize(3 * num_rows);
  problem.mu = VecX::Zero(num_rows);
}

/// The three rows of a contact or tie between two blocks. The force on each block acts at its own point.
void set_row(const Model& model, const State& state, int row, int block_a, int block_b, const Vec3& point_a,
             const Vec3& point_b, const Mat3& R_WC, ContactProblem* problem) {
  problem->block_a[row] = model.free_index[block_a];
  problem->block_b[row] = model.free_index[block_b];
  problem->D_a[row] = {-R_WC, point_a - state.poses[block_a].p_WB};
  problem->D_b[row] = {R_WC, point_b - state.poses[block_b].p_WB};
}

void set_rows(const Model& model, const State& state, const ContactSet& contacts, StepProblem* step) {
  constexpr double kOperationsPerContact = 200.0;
  const auto nc = static_cast<int>(contacts.points.size());
  share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const Contact& contact = contacts.points[i];
      CUPOLA_ASSERT(contact.block_a < contact.block_b);
      // One point for both bodies, so that action and reaction have no net moment across a gap.
      const Vec3 point = 0.5 * (contact.point_a + contact.point_b);
      set_row(model, state, i, contact.block_a, contact.block_b, point, point, contact_frame(contact.normal),
              &step->problem);
    }
  });
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const Tie& tie = model.ties[k];
    const TieGeometry now = tie_geometry(tie, state.poses, state.ground);
    set_row(model, state, step->num_contacts + static_cast<int>(k), tie.block_a, tie.block_b, now.point_a,
            now.point_b, contact_frame(now.normal), &step->problem);
  }
}

/// M^-1 f of every block.
VecX accelerations(const ContactProblem& problem, const VecX& f) {
  VecX a(f.size());
  for (int i = 0; i < problem.num_blocks(); ++i)
    a.segment<6>(6 * i) = problem.M[i].llt().solve(f.segment<6>(6 * i));
  return a;
}

/// The part of the impulses that follows from the forces at the start of the step, and the filtered
/// accelerations.
void set_past(const Model& model, const State& state, const ContactSet& contacts,
              const ContactMemories& memories, const StepOptions& options, StepProblem* step) {
  if (options.integrator.is_euler()) return;
  const Integrator& scheme = options.integrator;
  step->past_impulse = VecX::Zero(step->problem.b.size());
  VecX filtered = step->past_impulse;
  for (int i = 0; i < step->num_contacts; ++i) {
    const ContactMemory& memory = memories.of(i);
    if (!has_past(memory, options)) continue;
    const Contact& contact = contacts.points[i];
    const Mat3 R_CA =
        (state.poses[contact.block_a].q_WB.conjugate() * contact_frame(contact.normal)).transpose();
    const Vec3 force = R_CA * memory.force_A;
    filtered.segment<3>(3 * i) = R_CA * memory.filtered_A;
    step->past_impulse.segment<3>(3 * i) =
        options.h * (scheme.filtered * filtered.segment<3>(3 * i) + scheme.start * force);
    step->impulse_time[i] = options.h * scheme.end;
  }
  const VecX f = applied_forces(model, state, state.time + options.load_advance());
  step->acceleration = accelerations(step->problem, f + generalized_impulse(step->problem, filtered));
}

constexpr std::array kOutOfPlane{1, 3, 5};  // of the velocities of a block that moves in the x-z plane

/// Nothing holds a plane scene in its plane: over the long steps of statics, the rounding of its loads would
/// turn blocks out of it.
void stay_in_plane(VecX* v) {
  for (const int out : kOutOfPlane)
    for (Eigen::Index row = out; row < v->size(); row += 6) (*v)[row] = 0.0;
}

/// v + M^-1 (h f + D (p - gamma)), with the gyroscopic moment in the middle of the step if it has one.
void set_free_velocities(const Model& model, const State& state, const StepOptions& options,
                         StepProblem* step) {
  ContactProblem& problem = step->problem;
  const double time = state.time + options.load_advance();
  problem.v_star = state.v;
  if (options.integrator.is_euler()) {
    const VecX f = applied_forces(model, state, time);
    for (int i = 0; i < problem.num_blocks(); ++i)
      problem.v_star.segment<6>(6 * i) += options.h * problem.M[i].llt().solve(f.segment<6>(6 * i));
    return;
  }
  State middle = state;
  middle.v += options.integrator.middle * options.h * step->acceleration;
  const VecX f = applied_forces(model, middle, time);
  problem.v_star += accelerations(problem, options.h * f + generalized_impulse(problem, step->past_impulse));
}

void set_contact_laws(const Model& model, const State& state, const ContactSet& contacts,
                      const ContactMemories& memories, const StepOptions& options, StepProblem* step) {
  const double h = options.h;
  const double h_alpha = options.damped_reach();
  const double end = state.time + options.advance();
  ContactProblem* problem = &step->problem;
  const auto set_law = [&](int i) {
    const Contact& contact = contacts.points[i];
    const ContactMemory& memory = memories.of(i);
    const Mat3 R_WC = contact_frame(contact.normal);

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
    problem->E.segment<3>(3 * i) /= step->impulse_time[i] * h_alpha;

    const KnownMotion known = known_motion(*step, i, state.v, options);
    const bool smooth = options.integrator.is_euler() || has_past(memory, options);
    const double unlimited =
        options.recovery == Recovery::compliant ? memory.elastic_gap + known.to_middle[0] : 0.0;
    const double excess = std::max(contact.gap - bond.zero_gap - memory.rest_gap - unlimited,
                                   -options.recovery_speed * h_alpha);
    double gap = unlimited + excess + known.rest[0];
    // A contact that closes stops there. In the rest of the step it would be pushed back to where it closed.
    if (!smooth) gap = std::max(gap, memory.elastic_gap);
    problem->b[3 * i] = gap / options.reach_of(gap, memory.elastic_gap);
    if (options.tangential == TangentialSpring::memory) {
      Vec3 slip_C = R_WC.transpose() * (state.poses[contact.block_a].q_WB * memory.elastic_slip_A);
      if (smooth) slip_C += known.to_middle + known.rest;
      problem->b.segment<2>(3 * i + 1) = slip_C.tail<2>() / h_alpha;
    }
  };
  constexpr double kOperationsPerContact = 150.0;
  share_range(kOperationsPerContact * step->num_contacts, step->num_contacts, [&](int first, int last) {
    for (int i = first; i < last; ++i) set_law(i);
  });
}

void set_tie_laws(const Model& model, const State& state, const ContactMemories& memories,
                  const StepOptions& options, int first_row, ContactProblem* problem) {
  const double h_alpha = options.damped_reach();
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const Tie& tie = model.ties[k];
    const int row = first_row + static_cast<int>(k);
    problem->E.segment<3>(3 * row).setConstant(tie.compliance / (options.h * h_alpha));
    const double yielded = memories.ties.empty() ? 0.0 : memories.ties[k].yielded;
    const double gap = tie_gap(model, state, k) + yielded;
    problem->b[3 * row] = gap / options.reach_of(gap, 0.0);
    if (std::isfinite(tie.yield_force)) problem->strength[row].compression = options.h * tie.yield_force;
  }
}

/// Restricts all rows and masses to motion in the x-z plane.
void drop_rows_out_of_plane(ContactProblem* problem) {
  problem->plane = true;
  for (std::vector<Lever>* side : {&problem->D_a, &problem->D_b}) {
    for (Lever& D : *side) {
      D.frame.row(1).setZero();
      D.arm[1] = 0.0;
    }
  }
  for (const int out : kOutOfPlane) {
    for (Mat6& M : problem->M)
      for (const int in : {0, 2, 4}) M(out, in) = M(in, out) = 0.0;
  }
}

/// Adds the imposed velocities of supports to b.
void add_support_velocities(const Model& model, const State& state, const ContactSet& contacts,
                            const StepOptions& options, StepProblem* step) {
  std::vector<Pose> moved = state.poses;
  place_supports(*model.assembly, model.support_motions, state.time + options.advance(), &moved);
  const Eigen::Matrix<double, 6, Eigen::Dynamic> v = block_velocities(state.poses, moved, options.h);
  Vec6 v_ground = Vec6::Zero();
  v_ground.head<3>() = (model.ground.displacement(state.time + options.advance()) - state.ground) / options.h;
  ContactProblem& problem = step->problem;
  for (int row = 0; row < problem.num_contacts(); ++row) {
    const bool is_contact = row < step->num_contacts;
    const size_t tie = is_contact ? 0 : static_cast<size_t>(row - step->num_contacts);
    const int a = is_contact ? contacts.points[row].block_a : model.ties[tie].block_a;
    const int b = is_contact ? contacts.points[row].block_b : model.ties[tie].block_b;
    const bool is_grounded = !is_contact && model.ties[tie].is_restraint();
    const Vec6 v_a = is_grounded ? v_ground : Vec6(v.col(a));
    step->support_velocity.segment<3>(3 * row) =
        problem.D_a[row].velocity(v_a) + problem.D_b[row].velocity(v.col(b));
  }
}

/// Adds the velocities at which the heated faces of a contact, or ends of a tie, separate, at the end of the
/// step: over reach().
void add_expansion(const Model& model, const State& state, const ContactSet& contacts,
                   const StepOptions& options, StepProblem* step) {
  int row = 0;
  const auto add = [&](const Contact& contact) {
    const Vec3 change = model.heat.separation(state.poses, contact, state.time + options.advance()) -
                        model.heat.separation_before(state.poses, contact, state.time);
    step->support_velocity.segment<3>(3 * row++) +=
        contact_frame(contact.normal).transpose() * change / options.reach();
  };
  for (const Contact& contact : contacts.points) add(contact);
  for (const Tie& tie : model.ties) add(as_contact(tie, tie_geometry(tie, state.poses, state.ground)));
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
  CUPOLA_ASSERT(memories.ids.size() == contacts.points.size());
  StepProblem step;
  step.num_contacts = static_cast<int>(contacts.points.size());
  step.problem.h = options.h;
  resize_rows(step.num_contacts + static_cast<int>(model.ties.size()), &step);
  step.reach = options.reach();
  step.impulse_time = VecX::Constant(step.problem.num_contacts(), options.h);
  if (model.has_strength()) step.problem.strength.resize(step.problem.block_a.size());
  step.problem.M.resize(model.num_free());
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    step.problem.M[i] = mass_matrix(model.bodies[block], state.poses[block].q_WB);
  }
  set_rows(model, state, contacts, &step);
  if (model.plane) drop_rows_out_of_plane(&step.problem);
  set_past(model, state, contacts, memories, options, &step);
  if (model.plane) stay_in_plane(&step.acceleration);
  set_free_velocities(model, state, options, &step);
  if (model.plane) stay_in_plane(&step.problem.v_star);
  set_contact_laws(model, state, contacts, memories, options, &step);
  set_tie_laws(model, state, memories, options, step.num_contacts, &step.problem);
  if (model.support_motions.empty() && model.heat.empty()) return step;
  step.support_velocity = VecX::Zero(step.problem.b.size());
  if (!model.support_motions.empty()) add_support_velocities(model, state, contacts, options, &step);
  if (!model.heat.empty()) add_expansion(model, state, contacts, options, &step);
  step.problem.b += step.support_velocity;
  return step;
}

}  // namespace cupola
