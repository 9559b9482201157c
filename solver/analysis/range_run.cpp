#include "solver/analysis/range_run.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "solver/analysis/record/record.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// The contact that tells a joint from others: the first one in its normal force. None for other objectives.
std::optional<int> contact_of(const RangeObjective& objective) {
  if (!objective.joint || objective.over || objective.mean_of_images) return std::nullopt;
  return objective.value.contacts.begin()->first;
}

std::string text_of(const RangeEnd& end) {
  return end.value ? fmt::format("{:.10g}", *end.value) : to_string(end.outcome);
}

}  // namespace

RangeRun::RangeRun(const RigidScene& scene, const std::vector<RangeObjective>& objectives,
                   const Case& of_case, const AnalysisSinks& sinks)
    : scene_(scene),
      objectives_(objectives),
      states_(of_case.analysis.range.states),
      sinks_(sinks),
      images_(scene, objectives),
      vanishes_(objectives.size(), 0) {
  if (const int sectors = of_case.analysis.cyclic_sectors; sectors > 1) sector_.emplace(scene, sectors);
  for (const RangeObjective& objective : objectives)
    never_less_.push_back(coefficients_in_dual_cone(scene, objective));
}

/// `end`: "least thrust".
void RangeRun::write_frame(const std::string& end, RangeSolution* solution) {
  if (!states_ || solution->gamma.size() == 0) return;
  solution->end.frame = frames_;
  Frame frame = admissible_frame(scene_, solution->gamma, frames_++);
  const bool unbounded = solution->end.outcome == RangeOutcome::unbounded;
  set_role(unbounded ? FrameRole::self_stress : FrameRole::range_end, end, &frame);
  sinks_.frame(frame);
}

void RangeRun::find_vanishing(const RangeSolution& state) {
  constexpr double kNothing = 1e-9;  // of one block's weight; ConicOptions::tolerance
  if (!state.admissible) return;
  for (size_t i = 0; i < objectives_.size(); ++i) {
    if (vanishes_[i] || never_less_[i].nonZeros() == 0) continue;
    if (objectives_[i].mean_of_images && !state.of_sector) continue;
    vanishes_[i] = never_less_[i].dot(state.gamma) <= kNothing * scene_.model.block_weight;
  }
}

/// Those that no state found so far attains, or all where each shall have its own state.
std::vector<int> RangeRun::least_to_solve(std::vector<ForceRange>* ranges) const {
  std::vector<int> ends;
  for (size_t i = 0; i < objectives_.size(); ++i) {
    const double least = objectives_[i].value.constant;
    if (vanishes_[i] && !states_)
      (*ranges)[i].min = {RangeOutcome::bounded, least, least, {}};
    else
      ends.push_back(static_cast<int>(i));
  }
  return ends;
}

RangeSolution RangeRun::solve(int objective, double towards) const {
  if (const auto original = originals_.find(images_.original(objective)); original != originals_.end())
    if (auto image = images_.end(objective, towards, original->second)) return *std::move(image);
  return range_end(scene_, objectives_[objective], towards, sector_ ? &*sector_ : nullptr);
}

void RangeRun::record(int objective, double towards, RangeSolution* found, ForceRange* range) {
  of_sector_ += found->of_sector && towards < 0.0 ? 1 : 0;
  write_frame(fmt::format("{} {}", towards > 0.0 ? "least" : "greatest", range->quantity), found);
  find_vanishing(*found);
  ++(found->iterations > 0 ? solves_ : images_found_);
  iterations_ += found->iterations;
  (towards > 0.0 ? range->min : range->max) = found->end;
  if (images_.has_images(objective) && found->end.outcome == RangeOutcome::bounded && !found->of_sector)
    originals_.emplace(objective, std::move(*found));
}

bool RangeRun::run(double towards, std::vector<int> ends, std::vector<ForceRange>* ranges) {
  constexpr double kWork = 1e12;       // of one batch: always worth all threads
  constexpr int kSolvesPerThread = 8;  // of a batch, which ends when the last of them does
  const int batch = num_threads() == 1 ? 1 : num_threads() * kSolvesPerThread;
  originals_.clear();
  const auto images =
      std::stable_partition(ends.begin(), ends.end(), [this](int i) { return images_.original(i) == i; });
  const int count = static_cast<int>(ends.size()), num_originals = static_cast<int>(images - ends.begin());
  for (int first = 0, last = 0; first < count; first = last) {
    if (sinks_.interrupted()) return false;
    last = std::min(first + batch, first < num_originals ? num_originals : count);
    std::vector<RangeSolution> found(static_cast<size_t>(last - first));
    share_loop(kWork, last - first, [&](int i) { found[i] = solve(ends[first + i], towards); });
    for (int i = first; i < last; ++i) {
      ForceRange& range = (*ranges)[ends[i]];
      record(ends[i], towards, &found[i - first], &range);
      const RangeEnd& end = towards > 0.0 ? range.min : range.max;
      sinks_.log(fmt::format("{:<8} end {:4d} of {}  {:<36} {:>18} {}", towards > 0.0 ? "least" : "greatest",
                             i + 1, count, range.quantity, text_of(end), range.unit));
      sinks_.progress(0.5 * (static_cast<double>(i + 1) / count + (towards > 0.0 ? 1.0 : 0.0)),
                      range.quantity);
    }
  }
  return true;
}

bool RangeRun::run(std::vector<ForceRange>* ranges) {
  std::vector<int> all(objectives_.size());
  std::iota(all.begin(), all.end(), 0);
  for (const RangeObjective& objective : objectives_)
    ranges->push_back({objective.quantity, objective.unit, {}, {}, {}, objective.joint});
  return run(-1.0, all, ranges) && run(1.0, least_to_solve(ranges), ranges);
}

RangeImages::RangeImages(const RigidScene& scene, const std::vector<RangeObjective>& objectives)
    : scene_(scene), objectives_(objectives) {
  std::map<std::pair<int, int>, int> of_joint;
  for (int i = 0; i < static_cast<int>(objectives.size()); ++i) {
    images_.push_back({i});
    if (contact_of(objectives[i])) of_joint.emplace(*objectives[i].joint, i);
  }
  if (of_joint.size() < 2) return;
  symmetries_ = find_symmetries(scene.model, scene.start, scene.contacts);
  for (int i = 0; i < static_cast<int>(objectives.size()); ++i) {
    const std::optional<int> contact = contact_of(objectives[i]);
    if (!contact || images_[i].symmetry >= 0) continue;
    for (int k = 0; k < static_cast<int>(symmetries_.size()); ++k) {
      const Contact& image = scene.contacts.points[symmetries_[k].contacts[*contact]];
      const auto found = of_joint.find(std::minmax(image.block_a, image.block_b));
      if (found == of_joint.end() || found->second <= i || images_[found->second].symmetry >= 0) continue;
      images_[found->second] = {i, k};
      images_[i].of_others = true;
    }
  }
}

std::optional<RangeSolution> RangeImages::end(int objective, double towards,
                                              const RangeSolution& of_original) const {
  const ModelSymmetry& symmetry = symmetries_[images_[objective].symmetry];
  return range_end_of(scene_, objectives_[objective], towards,
                      symmetry.forces(scene_.problem.contacts, of_original.gamma),
                      symmetry.velocities(of_original.v));
}

}  // namespace cupola
