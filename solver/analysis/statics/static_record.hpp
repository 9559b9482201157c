#pragma once

#include <vector>

#include "assembly/model/results.hpp"
#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

Status status_of(StaticOutcome outcome, bool proven);

/// law_violations() of a static solve.
std::vector<double> static_violations(const ContactSet& contacts, const StaticSolution& solution,
                                      const FlowRule& law);

/// A clause for the message if joints were drawn with gaps above 1e-3 of the smallest block, the least width
/// of a joint (joint_rule.hpp): their number and the largest gap. They count as joints because they are within
/// `contact.margin`. Empty if there are none: what supports have opened is no gap of the drawing.
std::string gaps_note(const Model& model, const State& start, const ContactSet& contacts);

/// Warns if a displacement (m) is large, because equilibrium is that of the geometry as built.
void warn_of_large_displacement(const Case& scene, const Assembly& assembly, double displacement,
                                std::vector<std::string>* warnings);

/// The frame of a static solve. Equilibrium: displacements h v, gaps after the displacement, velocities zero.
/// Motion: no displacements, velocities scaled so that the fastest block moves at 1 m/s. Unconverged:
/// neither.
Frame static_frame(const Model& model, const State& start, const ContactSet& contacts,
                   const ContactMemories& memories, const StaticSolution& solution,
                   const StaticOptions& options);

/// Role of the frame of a stage of construction.
FrameRole stage_role(StaticOutcome outcome);

/// Sets the fields of the summary that say how accurate the forces of a static solve are.
void summarize_accuracy(const StaticSolution& solution, double tolerance, Summary* summary);

/// Sets the fields of the summary that follow from a static solve and its frame.
void summarize_static(const StaticSolution& solution, const Frame& frame, const Model& model,
                      double tolerance, Summary* summary);

}  // namespace cupola
