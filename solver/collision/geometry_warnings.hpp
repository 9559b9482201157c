#pragma once

#include <string>
#include <vector>

#include "solver/collision/contact_detector.hpp"

namespace cupola {

/// Warnings, one sentence each, about geometry that degrades contact detection:
///
/// - two blocks overlap by more than 1e-6 of the smallest block (cube root of its volume): their contacts
///   start compressed, and a block inside another one has no contacts;
/// - the faces of a joint are drawn more than 1e-3 of the smallest block apart, without ignore_initial_gaps:
///   what has not closed counts as a crack, and rigid joints push across it;
/// - a joint is narrower than 1e-3 of the smallest block: it is ignored;
/// - a part is thinner than the margin: contacts can act through it from the wrong side.
///
/// Throws InputError when two blocks overlap by more than the margin, because the forces that push them apart
/// would have no physical meaning.
std::vector<std::string> geometry_warnings(const Assembly& assembly, const DetectionOptions& options);

}  // namespace cupola
