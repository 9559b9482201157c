#pragma once

#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

Table range_table(const std::vector<ForceRange>& ranges);
Table ring_table(const Evaluation& evaluation);
/// Requires a shell with wythes.
Table member_table(const Evaluation& evaluation);
/// Requires a shell with wythes.
Table wythe_table(const Evaluation& evaluation);
Table joint_table(const Evaluation& evaluation);
Table block_table(const Evaluation& evaluation);
Table thrust_table(const ThrustLine& line);
Table hoop_table(const MeridianEvaluation& meridian);
Table crack_table(const Evaluation& evaluation);
Table chain_table(const Evaluation& evaluation);
Table tie_table(const Evaluation& evaluation);
Table section_table(const Evaluation& evaluation, const SectionEvaluation& section);
Table plane_table(const Evaluation& evaluation, const PlaneCut& cut);

/// The tables above that have rows to show, in the order of the report.
std::vector<Table> result_tables(const Evaluation& evaluation);

}  // namespace cupola
