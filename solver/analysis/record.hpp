#pragma once

#include "solver/analysis/static_solve.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Joints of a contact set, numbered in the order of their first contact. A joint is all contacts of one pair
/// of blocks and one kind.
struct JointNumbers {
  std::vector<int> of_contact;  ///< joint of each contact (nc)
  int count = 0;
};
JointNumbers number_joints(const ContactSet& contacts);

/// A frame for the results folder from the state at the end of a step and the contact forces of that step
/// (N, nc). `displacement`: that of each block's centroid, m (num_blocks).
Frame make_frame(const Model& model, const State& state, const ContactSet& contacts,
                 const std::vector<Vec3>& contact_forces, const ContactMemories& memories,
                 const std::vector<Vec3>& displacement);

/// Sets the fields of the summary that follow from the contacts and blocks of a frame.
void summarize_frame(const Frame& frame, const Model& model, Summary* summary);

/// The frame at the end of a static step: displacements h v, gaps after the displacement, velocities zero.
Frame static_frame(const Model& model, const State& start, const ContactSet& contacts,
                   const ContactMemories& memories, const StaticSolution& solution,
                   const StaticOptions& options);

/// Sets the fields of the summary that follow from a static solve.
void summarize_static(const StaticSolution& solution, double tolerance, Summary* summary);

}  // namespace cupola
