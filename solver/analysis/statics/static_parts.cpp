#include "solver/analysis/statics/static_parts.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "solver/analysis/statics/static_record.hpp"

namespace cupola {
namespace {

constexpr size_t kMostParts = 100;

/// One part, marked in the blocks of the model.
struct OnePart {
  std::vector<char> chosen;  // (num_free)
  PartVerdict verdict;
  bool stands = false;
};

std::vector<OnePart> parts_of(const Model& model, const std::vector<int>& islands) {
  std::map<int, OnePart> found;
  for (int i = 0; i < model.num_free(); ++i) {
    OnePart& part = found[islands[i]];
    part.chosen.resize(static_cast<size_t>(model.num_free()));
    part.chosen[i] = 1;
    if (part.verdict.blocks++ == 0) part.verdict.first_block = model.free_blocks[i];
  }
  std::vector<OnePart> parts;
  for (auto& [first, part] : found) parts.push_back(std::move(part));
  std::ranges::stable_sort(parts, std::ranges::greater(),
                           [](const OnePart& part) { return part.verdict.blocks; });
  return parts;
}

/// The blocks chosen as a scene with a weight of its own.
ScenePart scene_of(const Model& model, const State& start, const ContactSet& contacts,
                   const ContactMemories& memories, const std::vector<char>& chosen) {
  ScenePart part = part_of(model, start, contacts, memories, chosen, 1);
  Model& own = part.model;
  const auto mass_of = [](const Model& of) {
    return std::accumulate(of.free_blocks.begin(), of.free_blocks.end(), 0.0,
                           [&](double mass, int b) { return mass + of.assembly->blocks[b].mass; });
  };
  own.free_weight *= mass_of(own) / mass_of(model);
  own.block_weight = own.free_weight / own.num_free();
  return part;
}

StaticSolution solve_part(const ScenePart& part, const StaticOptions& options) {
  return solve_static(part.model, part.state, part.contacts, part.memories, options);
}

Status status_of(const ScenePart& part, const StaticSolution& solution, const StaticOptions& options) {
  Summary summary;
  const Frame frame = static_frame(part.model, part.state, part.contacts, part.memories, solution, options);
  summarize_static(solution, frame, part.model, options.tolerance, &summary);
  return summary.status;
}

/// The larger, the more a verdict says that something falls.
int falls(Status status) {
  return status == Status::moving ? 2 : status == Status::moving_unproven ? 1 : 0;
}

void stop_what_stands(const StaticParts& parts, const Model& model, Frame* frame) {
  for (int i = 0; i < model.num_free(); ++i) {
    if (!parts.stands[i]) continue;
    frame->blocks.velocity[model.free_blocks[i]].setZero();
    frame->blocks.angular_velocity[model.free_blocks[i]].setZero();
  }
}

}  // namespace

std::optional<StaticParts> solve_by_parts(const Model& model, const State& start, const ContactSet& contacts,
                                          const ContactMemories& memories, const StaticOptions& options) {
  std::vector<OnePart> parts = parts_of(model, islands_of(model, contacts));
  if (parts.size() < 2 || parts.size() > kMostParts) return std::nullopt;
  StaticParts out;
  out.stands.resize(static_cast<size_t>(model.num_free()));
  Status worst = Status::stable;
  for (OnePart& part : parts) {
    ScenePart scene = scene_of(model, start, contacts, memories, part.chosen);
    StaticSolution solution = solve_part(scene, options);
    part.verdict.status = status_of(scene, solution, options);
    part.stands = solution.outcome == StaticOutcome::equilibrium;
    for (size_t i = 0; i < out.stands.size() && part.stands; ++i) out.stands[i] |= part.chosen[i];
    out.verdicts.push_back(part.verdict);
    if (falls(part.verdict.status) <= falls(worst)) continue;
    worst = part.verdict.status;
    out.falling = std::move(scene);
    out.motion = std::move(solution);
  }
  if (!parts.front().stands) return out;
  out.standing = scene_of(model, start, contacts, memories, out.stands);
  out.solution = solve_part(*out.standing, options);
  if (out.solution.outcome != StaticOutcome::equilibrium) out.standing.reset();
  return out;
}

void add_parts(const StaticParts& parts, const Model& model, const StaticOptions& options, Summary* summary,
               Frame* frame, const AnalysisSinks& sinks) {
  summary->parts = parts.verdicts;
  if (parts.falling && falls(status_of(parts.motion.outcome, parts.motion.proven)) > falls(summary->status)) {
    const ScenePart& part = *parts.falling;
    *frame = static_frame(part.model, part.state, part.contacts, part.memories, parts.motion, options);
    summarize_accuracy(parts.motion, options.tolerance, summary);
    summary->status = status_of(parts.motion.outcome, parts.motion.proven);
    summary->message = parts.motion.message;
  }
  stop_what_stands(parts, model, frame);
  if (!parts.standing) return;
  const Status whole = summary->status;
  const std::string message = summary->message;
  const ScenePart& standing = *parts.standing;
  const Frame of_standing = static_frame(standing.model, standing.state, standing.contacts, standing.memories,
                                         parts.solution, options);
  summarize_static(parts.solution, of_standing, standing.model, options.tolerance, summary);
  const int blocks = standing.model.num_free();
  const std::string stands =
      fmt::format("of {} those with {} stand: {}", counted(parts.verdicts.size(), "unconnected part"),
                  counted(blocks, "block"), summary->message);
  summary->status = whole;
  summary->message = fmt::format("{}; the rest: {}", stands, message);
  sinks.frame(of_standing);
}

}  // namespace cupola
