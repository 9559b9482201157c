#pragma once

#include "assembly/model/results.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Joints of a contact set, numbered in the order of their first contact. A joint is all contacts of one pair
/// of blocks and one kind.
struct JointNumbers {
  std::vector<int> of_contact;  ///< joint of each contact (nc)
  int count = 0;
};
JointNumbers number_joints(const ContactSet& contacts);

/// The contact of a frame with the largest violation of its law. None without contacts.
std::optional<LawViolation> largest_violation(const Frame& frame);

/// The worst accuracy of the steps or stages of a run.
struct WorstOfRun {
  Residuals residuals;  ///< each the largest
  std::optional<ForceCertificate> certificate;
  ForcesUnique unique;
  std::optional<LawViolation> violation;
  std::optional<WorstSteps> steps;  ///< of a motion

  /// `certificate`: none if no contact is loaded. `step`: of a motion.
  void include(const Residuals& of_step, const std::optional<ForceCertificate>& certificate_of_step,
               const ForcesUnique& unique_in_step, const std::optional<LawViolation>& violation_of_step,
               const std::optional<RunStep>& step = {});
  /// Sets the fields of the summary.
  void summarize(Summary* summary) const;
};

/// m: opening of the faces at a gap (m), beyond the elastic elongation of the joint.
double crack_opening(double gap, const ContactMemory& memory);

/// A frame for the results folder from the state at the end of a step, the forces of that step
/// and their violation of the contact law (nc). `displacement`: that of each block's centroid, m
/// (num_blocks).
Frame make_frame(const Model& model, const State& state, const ContactSet& contacts,
                 const JointForces& forces, const std::vector<double>& violations,
                 const ContactMemories& memories, const std::vector<Vec3>& displacement);

/// Records where the ties of a frame pulled in `found`, at whose poses its contacts were found.
void set_tie_ends(const Model& model, const State& found, Frame* frame);
/// The same, and where the blocks stood there.
void set_contact_poses(const Model& model, const State& found, Frame* frame);
/// The same unless the blocks stood there as built, which is what a frame without these poses means.
void set_contact_poses_if_moved(const Model& model, const State& found, Frame* frame);

/// Appends, without force, the points of `built`, the contacts as built in the poses of the frame, that stand
/// farther apart than `margin` (m) and that `found`, the contacts of the frame, no longer holds.
void append_parted(const Model& model, const ContactSet& built, const ContactSet& found, double margin,
                   Frame* frame);

/// Sets the fields of the summary that follow from the contacts and blocks of a frame, except displacement
/// and speed, whose meaning depends on the analysis.
void summarize_frame(const Frame& frame, const Model& model, Summary* summary);

/// Largest displacement of a block, m.
double largest_displacement(const Frame& frame);

/// Sets the loads, the reactions and the residual of an equilibrium.
void summarize_balance(const Equilibrium& balance, Summary* summary);

}  // namespace cupola
