#pragma once

#include <functional>
#include <vector>

#include "tests/extremes/extreme_scene.hpp"
#include "tests/extremes/true_forces.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola {

using Rows = std::vector<ExtremeScene>;

void add_contrast_rows(Rows* rows);
void add_friction_rows(Rows* rows);
void add_critical_rows(Rows* rows);
void add_shape_rows(Rows* rows);
void add_scale_rows(Rows* rows);
void add_edge_rows(Rows* rows);
void add_large_rows(Rows* rows);
void add_motion_rows(Rows* rows);
void add_random_rows(Rows* rows);

/// Tolerances of the presets `draft` and `standard` of a static analysis.
constexpr double kDraft = 1e-2, kStandard = 1e-5;

/// A static case with the given friction and compliance (m/N per point); `tolerance` is relative to the mean
/// block weight.
Case statics(double mu, double compliance, double tolerance = 1e-9);

/// The case under Coulomb's law.
Case coulomb(Case input);

/// Gives the contact points of the joints with label k the compliance `normal[k]`, `tangential[k]` (m/N). The
/// label of a joint is the larger one of its two blocks; joints with supports have label 0.
void set_compliances(const std::vector<double>& normal, const std::vector<double>& tangential, Case* input);
void label_blocks(const std::function<int(int block)>& label, Assembly* assembly);

/// "associated law" or "Coulomb's law".
const char* name_of(FrictionLaw law);

/// A fixed floor with its upper face at z = 0, then cubes or boxes of the given sizes, one on the other.
Assembly pile(const std::vector<Vec3>& sizes);

}  // namespace cupola
