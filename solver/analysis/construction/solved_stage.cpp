#include "solver/analysis/construction/solved_stage.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/disjoint_sets.hpp"
#include "assembly/files/csv_columns.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/joint_motion.hpp"
#include "solver/analysis/construction/stage_measures.hpp"

namespace cupola {
namespace {

/// m, largest distance of a vertex from the centroid.
std::vector<double> block_radii(const Assembly& assembly) {
  std::vector<double> radius(assembly.blocks.size(), 0.0);
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int vertex : assembly.face(f)) {
        double& r = radius[part.block];
        r = std::max(r, (assembly.vertices[vertex] - assembly.blocks[part.block].centroid).norm());
      }
  return radius;
}

/// Speeds at the joints of blocks, over that of the fastest block.
struct JointMotions {
  double hinging = 0.0, sliding = 0.0;  ///< of the fastest joint
};

/// By block: how it moves against others, together with those that move with it as one.
std::vector<JointMotions> motions_of_bodies(const StageProblem& problem, const VecX& v, double fastest) {
  const Model& model = problem.model;
  const auto velocity = [&](int block, const Vec3& point) -> Vec3 {
    const int i = model.free_index[block];
    if (i == ContactProblem::kFixed) return Vec3::Zero();
    const Vec3 turn = v.segment<3>(6 * i + 3);
    return v.segment<3>(6 * i) + turn.cross(point - model.assembly->blocks[block].centroid);
  };
  const std::vector<Patch>& patches = problem.contacts.patches;
  std::vector<JointSpeeds> joints(patches.size());
  for (const Contact& contact : problem.contacts.points) {
    const Vec3 u =
        (velocity(contact.block_b, contact.point_b) - velocity(contact.block_a, contact.point_a)) / fastest;
    const double opening = u.dot(contact.normal);
    joints[contact.patch].add(opening, (u - opening * contact.normal).norm());
  }
  const size_t count = model.assembly->blocks.size();
  DisjointSets bodies(count);
  for (size_t i = 0; i < joints.size(); ++i)
    if (joints[i].stays_closed && joints[i].motion() == JointMotion::closed)
      bodies.join(patches[i].block_a, patches[i].block_b);
  std::vector<JointMotions> motions(count);
  for (size_t i = 0; i < joints.size(); ++i)
    for (const int block : {patches[i].block_a, patches[i].block_b}) {
      JointMotions& body = motions[bodies.root(block)];
      if (joints[i].motion() == JointMotion::hinging)
        body.hinging = std::max(body.hinging, joints[i].turning());
      body.sliding = std::max(body.sliding, joints[i].sliding);
    }
  for (size_t block = 0; block < count; ++block)
    motions[block] = motions[bodies.root(static_cast<int>(block))];
  return motions;
}

using Least = StagedConstruction::Least;

LeastSearch::Result find_least(Construction* building, LeastSearch* search, SolvedStage* stage) {
  double nearest = -1.0;
  return search->find([&](double value) -> std::optional<LimitTrial> {
    const StaticSolution solution = building->solve(value);
    stage->iterations += solution.iterations;
    if (solution.outcome == StaticOutcome::moving && value > nearest) {
      nearest = value;
      stage->falling = falling_blocks(building->problem(), solution.step_solution.v);
    }
    return LimitTrial{value, solution.outcome, solution.speed_ratio};
  });
}

/// A row of construction.csv.
struct StageRow {
  int number;
  const LaidBlocks& laid;
  const Construction& building;
  const SolvedStage& stage;
  bool stands() const { return stage.solution.outcome == StaticOutcome::equilibrium; }
};

constexpr CsvColumn<StageRow> kConstructionColumns[] = {
    {"stage", [](const StageRow& r) { return std::to_string(r.number); }},
    {"ring", [](const StageRow& r) { return std::to_string(r.laid.ring); }},
    {"laid", [](const StageRow& r) { return std::to_string(r.laid.blocks.size()); }},
    {"blocks", [](const StageRow& r) { return std::to_string(r.building.problem().num_blocks); }},
    {"weight_N", [](const StageRow& r) { return fmt::format("{:.9g}", r.building.problem().weight); }},
    {"verdict", [](const StageRow& r) { return to_string(r.stage.solution.outcome); }},
    {"speed_ratio", [](const StageRow& r) { return fmt::format("{:.6e}", r.stage.solution.speed_ratio); }},
    {"least_stands",
     [](const StageRow& r) -> std::string {
       const LimitTrial& stable = r.stage.least.bracket.stable;
       if (stable.outcome == StaticOutcome::equilibrium) return fmt::format("{:.9g}", stable.value);
       return r.stage.least.needs_none ? "0" : "";
     }},
    {"least_moves",
     [](const StageRow& r) {
       const Bracket& bracket = r.stage.least.bracket;
       return bracket.found ? fmt::format("{:.9g}", bracket.moving.value) : "";
     }},
    {"head_squeeze_m",
     [](const StageRow& r) {
       return r.stands() ? fmt::format("{:.6e}", head_squeeze(r.building, r.stage.solution)) : "";
     }},
    {"displacement_m",
     [](const StageRow& r) {
       return r.stands() ? fmt::format("{:.6e}", largest_displacement(r.building, r.stage.solution)) : "";
     }},
    {"note",
     [](const StageRow& r) { return least_note(r.stage, r.building.site().scene.analysis.staged.least); }},
};

/// A block that leaves its place in a stage: a row of failures.csv.
struct FailureRow {
  int stage, ring;
  const Assembly& assembly;
  const FallingBlock& falling;
};

constexpr CsvColumn<FailureRow> kFailureColumns[] = {
    {"stage", [](const FailureRow& r) { return std::to_string(r.stage); }},
    {"ring", [](const FailureRow& r) { return std::to_string(r.ring); }},
    {"block", [](const FailureRow& r) { return block_label(r.assembly, r.falling.block); }},
    {"course", [](const FailureRow& r) { return std::to_string(r.assembly.blocks[r.falling.block].ring); }},
    {"how", [](const FailureRow& r) { return to_string(r.falling.mode); }},
    {"relative_speed", [](const FailureRow& r) { return fmt::format("{:.4f}", r.falling.speed); }},
};

/// Its tension ends at cohesion over friction, so that more friction can bear less.
bool fresh_mortar_pulls(const StagedConstruction& staged, const Joints& joints) {
  if (staged.curing.empty()) return staged.fresh.tension > 0.0;
  return std::ranges::any_of(staged.curing, [&](const CuringMortar& row) {
    return row.law.tension.value_or(joints.strength.tension) > 0.0;
  });
}

}  // namespace

SolvedStage solve_stage(Construction* building, LeastSearch* search, Construction::Need need) {
  SolvedStage stage;
  if (building->site().scene.analysis.staged.least != Least::none)
    stage.least = find_least(building, search, &stage);
  stage.solution = building->solve(need);
  stage.iterations += stage.solution.iterations;
  if (stage.solution.outcome == StaticOutcome::moving)
    stage.falling = falling_blocks(building->problem(), stage.solution.step_solution.v);
  return stage;
}

LeastSearch first_search(const Case& scene) {
  constexpr double kFirstCohesion = 1000.0, kMostCohesion = 1e6, kNarrowestCohesion = 0.1;  // Pa
  constexpr double kFirstFriction = 0.5, kMostFriction = 10.0, kNarrowestFriction = 1e-4;
  const StagedConstruction& staged = scene.analysis.staged;
  if (staged.least == Least::cohesion)
    return {kFirstCohesion, kMostCohesion, {staged.relative_width, kNarrowestCohesion}};
  const Joints& joints = scene.joints;
  const double hardened = joints.bed ? joints.bed->friction.value_or(joints.friction) : joints.friction;
  const BracketWidth width{staged.relative_width, kNarrowestFriction};
  const double first = hardened > 0.0 ? hardened : kFirstFriction;
  if (!fresh_mortar_pulls(staged, joints)) return {first, kMostFriction, width};
  const double own =
      staged.curing.empty() ? staged.fresh.friction : staged.curing.front().law.friction.value_or(first);
  return {own > 0.0 ? own : first, kMostFriction, width, LeastSearch::MoreBears::less_at_times};
}

std::string construction_header() {
  return csv_header(kConstructionColumns) + "\n";
}

std::string failures_header() {
  return csv_header(kFailureColumns) + "\n";
}

std::string construction_row(int number, const LaidBlocks& laid, const Construction& building,
                             const SolvedStage& stage) {
  return csv_row(kConstructionColumns, StageRow{number, laid, building, stage}) + "\n";
}

std::string failure_rows(int number, const LaidBlocks& laid, const Assembly& assembly,
                         const SolvedStage& stage) {
  std::string rows;
  for (const FallingBlock& block : stage.falling)
    rows += csv_row(kFailureColumns, FailureRow{number, laid.ring, assembly, block}) + "\n";
  return rows;
}

std::string least_note(const SolvedStage& stage, Least property) {
  if (property == Least::none) return "";
  return stage.least.needs_none ? fmt::format("stands without {}", to_string(property))
                                : stage.least.bracket.sought.reason;
}

std::vector<FallingBlock> falling_blocks(const StageProblem& problem, const VecX& v) {
  constexpr double kSlow = 0.1;  // of the fastest: carried along, or settling
  const Model& model = problem.model;
  const double fastest = largest_speed(v);
  std::vector<FallingBlock> falling;
  if (fastest == 0.0) return falling;
  const std::vector<double> radius = block_radii(*model.assembly);
  const std::vector<JointMotions> motions = motions_of_bodies(problem, v, fastest);
  for (int i = 0; i < model.num_free(); ++i) {
    const double speed = v.segment<3>(6 * i).norm(), turn = v.segment<3>(6 * i + 3).norm();
    if (speed < kSlow * fastest) continue;
    const int block = model.free_blocks[i];
    const bool tips = turn * radius[block] >= speed || motions[block].hinging > motions[block].sliding;
    falling.push_back({block, tips ? FallingMode::tips : FallingMode::slides, speed / fastest});
  }
  return falling;
}

}  // namespace cupola
