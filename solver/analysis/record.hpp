#pragma once

#include "solver/analysis/static_solve.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Joints of a contact set: contacts of one block pair and one kind belong together, numbered in order.
struct JointNumbers {
  std::vector<int> of_contact;  ///< (nc)
  int count = 0;
};
JointNumbers number_joints(const ContactSet& contacts);

/// A frame for the results folder from the state at the end of a step and the impulses of that step.
/// `displacement`: of each block's centroid, m.
Frame make_frame(const Model& model, const State& state, const ContactSet& contacts,
                 const std::vector<Vec3>& contact_forces, const ContactMemories& memories,
                 const std::vector<Vec3>& displacement);

/// What the contacts and blocks of a frame contribute to the summary.
void summarize_frame(const Frame& frame, const Model& model, Summary* summary);

/// The frame at the end of a static step: displacement h v, gaps as they end up, blocks at rest.
Frame static_frame(const Model& model, const State& start, const ContactSet& contacts,
                   const ContactMemories& memories, const StaticSolution& solution,
                   const StaticOptions& options);

/// Tolerance, method and law of the case for a static solve.
StaticOptions static_options(const Analysis& analysis);

/// What a static solve contributes to the summary.
void summarize_static(const StaticSolution& solution, double tolerance, Summary* summary);

}  // namespace cupola
