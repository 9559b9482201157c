#pragma once

#include <functional>
#include <span>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/tables/result_columns.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

Table range_table(const std::vector<ForceRange>& ranges);
Table ring_table(const Evaluation& evaluation);
/// Requires a shell with wythes.
Table member_table(const Evaluation& evaluation);
/// Requires a shell with wythes.
Table wythe_table(const Evaluation& evaluation);
Table joint_table(const Evaluation& evaluation, std::span<const JointWrench> joints);
Table block_table(const Evaluation& evaluation, std::span<const BlockRow> blocks);
Table thrust_table(const ThrustLine& line);
Table hoop_table(const MeridianEvaluation& meridian);
Table crack_table(const Evaluation& evaluation);
Table chain_table(const Evaluation& evaluation);
Table tie_table(const Evaluation& evaluation);
Table section_table(const Evaluation& evaluation, const SectionEvaluation& section);
Table plane_table(const Evaluation& evaluation, const PlaneCut& cut);

/// Hands over the tables above that have rows to show, in the order of the report. Large ones come in pieces
/// of the same name, because a cell takes four times the memory of its number.
void visit_tables(const Evaluation& evaluation, const std::function<void(Table)>& take);

}  // namespace cupola
