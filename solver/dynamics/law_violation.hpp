#pragma once

#include <vector>

#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Violation of the contact law at each contact (nc): its error over the force of its joint, the sum of
/// |gamma| over the contacts of its patch. Joints with less than 1 % of the mean joint force are scaled by
/// that 1 %.
/// `gamma`, `errors` = contact_law_errors(): N s; rows of ties may follow those of the contacts.
std::vector<double> law_violations(const ContactSet& contacts, const VecX& gamma, const VecX& errors);

}  // namespace cupola
