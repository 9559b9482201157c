#include "solver/dynamics/stages.hpp"

#include <algorithm>

namespace cupola {
namespace {

constexpr int kNotBuilt = -1;

/// Block of the complete assembly -> block of the stage, or kNotBuilt.
std::vector<int> stage_block(const ConstructionStage& stage, size_t num_complete) {
  std::vector<int> index(num_complete, kNotBuilt);
  for (size_t block = 0; block < stage.complete_block.size(); ++block)
    index[static_cast<size_t>(stage.complete_block[block])] = static_cast<int>(block);
  return index;
}

std::optional<double> between(const std::optional<double>& a, const std::optional<double>& b, double share) {
  if (!a || !b) return std::nullopt;
  return *a + share * (*b - *a);
}

/// The law of mortar of an age; none if it has hardened.
std::optional<JointLawChange> law_at_age(const StagedConstruction& staged, int courses) {
  if (staged.curing.empty())
    return courses < staged.fresh.courses ? std::optional(staged.fresh.law()) : std::nullopt;
  const double age = courses * staged.days_per_course.value_or(1.0);
  const auto after =
      std::ranges::find_if(staged.curing, [&](const CuringMortar& row) { return row.age >= age; });
  if (after == staged.curing.end()) return std::nullopt;
  if (after == staged.curing.begin()) return after->law;
  const CuringMortar &a = *(after - 1), &b = *after;
  const double share = (age - a.age) / (b.age - a.age);
  return JointLawChange{between(a.law.friction, b.law.friction, share),
                        between(a.law.normal, b.law.normal, share),
                        between(a.law.tangential, b.law.tangential, share),
                        between(a.law.tension, b.law.tension, share),
                        between(a.law.cohesion, b.law.cohesion, share),
                        {},
                        {}};
}

}  // namespace

void add_fresh_joints(const StagedConstruction& staged, int ring, int top, Joints* joints) {
  for (int age = ring; age >= 0; --age) {  // the youngest last
    const std::optional<JointLawChange> law = law_at_age(staged, age);
    if (!law) continue;
    const int from = ring - age, to = age == 0 ? std::max(ring, top) : from;
    joints->rings.push_back({from, to, RingJoints::Sort::laid_bed, *law});
    if (staged.fresh.heads) joints->rings.push_back({from, to, RingJoints::Sort::laid_head, *law});
  }
}

ConstructionStage build_stage(const Assembly& complete, int ring) {
  ConstructionStage stage;
  stage.ring = ring;
  Assembly& built = stage.assembly;
  built.vertices = complete.vertices;
  built.face_vertex_start = {0};
  built.title = complete.title;
  built.geometry_hash = complete.geometry_hash;
  built.num_rings = complete.num_rings;
  built.sheets = complete.sheets;
  built.members = complete.members;
  for (size_t block = 0; block < complete.blocks.size(); ++block) {
    if (!complete.blocks[block].fixed && complete.blocks[block].ring > ring) continue;
    stage.complete_block.push_back(static_cast<int>(block));
    built.blocks.push_back(complete.blocks[block]);
  }
  const std::vector<int> index = stage_block(stage, complete.blocks.size());
  for (const Part& part : complete.parts) {
    if (index[static_cast<size_t>(part.block)] == kNotBuilt) continue;
    Part copy = part;
    copy.block = index[static_cast<size_t>(part.block)];
    copy.face_start = built.num_faces();
    copy.num_faces = 0;  // add_face counts them
    built.parts.push_back(copy);
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      built.add_face(complete.face(f), complete.face_kinds[f]);
  }
  built.chains = complete.chains;
  for (BuiltTie tie : complete.ties) {
    tie.block_a = index[static_cast<size_t>(tie.block_a)];
    tie.block_b = index[static_cast<size_t>(tie.block_b)];
    if (tie.block_a != kNotBuilt && tie.block_b != kNotBuilt) built.ties.push_back(tie);
  }
  return stage;
}

Case case_of_stage(const Case& scene, const ConstructionStage& stage, double fresh_friction, bool complete) {
  Case at = scene;
  StagedConstruction staged = scene.analysis.staged;
  staged.fresh.friction = fresh_friction;
  add_fresh_joints(staged, stage.ring, stage.ring, &at.joints);
  if (complete) return at;
  const Vec3 gravity = scene.loads.gravity;
  at.loads = Loads{};
  at.loads.gravity = gravity;
  at.loads.dead_load_time = scene.loads.dead_load_time;
  at.supports = Supports{};

  int num_complete = 0;
  for (int block : stage.complete_block) num_complete = std::max(num_complete, block + 1);
  const std::vector<int> index = stage_block(stage, static_cast<size_t>(num_complete));
  const auto built = [&](int block) {
    return block < num_complete && index[static_cast<size_t>(block)] >= 0;
  };
  at.ties.pairs.clear();
  for (PairTie tie : scene.ties.pairs) {
    if (!built(tie.block_a) || !built(tie.block_b)) continue;
    tie.block_a = index[static_cast<size_t>(tie.block_a)];
    tie.block_b = index[static_cast<size_t>(tie.block_b)];
    at.ties.pairs.push_back(tie);
  }
  return at;
}

}  // namespace cupola
