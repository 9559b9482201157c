// Ranges of forces over all admissible states.

#include <limits>
#include <stdexcept>

#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

BaseBlocks group(BaseBlocks::Group name) {
  return {name, {}};
}

/// The lowest free block that rests on the supports.
int base_block(const Assembly& model) {
  for (size_t b = 0; b < model.blocks.size(); ++b)
    if (!model.blocks[b].fixed && model.blocks[b].ring == 0) return static_cast<int>(b);
  throw std::runtime_error("no base block");
}

ForceQuantity quantity_of(const ReferenceRow& row, const Assembly& model) {
  using enum BlockReaction::Component;
  using enum BaseBlocks::Group;
  const std::string name = row.text("force");
  if (name == "thrust") return BaseThrust{};
  if (name == "block, vertical") return BlockReaction{base_block(model), vertical, {}};
  if (name == "block, outward") return BlockReaction{base_block(model), outward, {}};
  if (name == "share of ribs") return BaseShare{group(ribs)};
  if (name == "ribs over mid-sails") return BaseRatio{group(ribs), group(mid_sails)};
  throw std::runtime_error("no force " + name);
}

/// The unit of the expected value: the weight, 1/32 of it, or none.
double unit_of(const ReferenceRow& row, const Summary& summary) {
  const std::string name = row.text("force");
  if (name == "thrust") return summary.weight_N;
  return name.starts_with("block") ? summary.weight_N / 32.0 : 1.0;
}

double end_of_range(const ReferenceRow& row) {
  Case scene = repository_case(row.text("case"), {"joints.friction=" + row.text("mu")});
  scene.loads.lantern.reset();
  if (const double share = row.number("lantern"); share > 0.0) scene.loads.lantern = TopLoad{share};
  const Assembly model = generate(scene);
  scene.analysis.type = AnalysisType::range;
  scene.analysis.range.quantities = {quantity_of(row, model)};
  const Summary summary = run_range(scene, model, {}).value();
  if (summary.ranges.empty()) throw std::runtime_error(summary.message);
  const RangeEnd& end = row.text("end") == "min" ? summary.ranges[0].min : summary.ranges[0].max;
  if (end.outcome == RangeOutcome::unbounded) return std::numeric_limits<double>::infinity();
  if (!end.value) throw std::runtime_error(summary.message);
  return *end.value / unit_of(row, summary);
}

/// Least or largest horizontal force at a springing over the weight, of the semicircular arch of 27
/// voussoirs.
double end_of_arch_thrust(const ReferenceRow& row) {
  ArchSurface arch;
  arch.span = 2.0 - 0.15;
  arch.thickness = 0.15;
  Case scene;
  scene.geometry.surface = arch;
  scene.geometry.bond = StackBond{27, 1, 1, {}};
  scene.joints.friction = row.number("mu");
  scene.analysis.type = AnalysisType::range;
  scene.analysis.range.quantities = {BaseThrust{}};
  const Summary summary = run_range(scene, generate(scene), {}).value();
  if (summary.ranges.empty()) throw std::runtime_error(summary.message);
  const RangeEnd& end = row.text("end") == "min" ? summary.ranges[0].min : summary.ranges[0].max;
  return end.value.value() / summary.weight_N;
}

}  // namespace

void add_range_rows(Computations* all) {
  Computations& rows = *all;
  rows["dome_range"] = end_of_range;
  rows["arch_range"] = end_of_arch_thrust;
}

}  // namespace cupola::verification
