#include "assembly/case/keys_without_effect.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

class Refusal {
 public:
  explicit Refusal(const Assembly& assembly) : assembly_(assembly) {}

  void unless(bool holds, const std::string& message) const {
    if (!holds) throw InputError(message);
  }
  /// For a key that selects courses from `ring` upwards. Imported blocks without courses have one, 0.
  void course(const std::string& key, int ring) const {
    const int last = std::max(0, assembly_.num_rings - 1);
    unless(ring <= last,
           fmt::format("{} = {}: has no effect: the model has the rings 0 to {}", key, ring, last));
  }

 private:
  const Assembly& assembly_;
};

/// Kinds of joints that not every model has.
void check_kinds(const Case& scene, const Assembly& assembly, const Refusal& refuse) {
  using Sort = RingJoints::Sort;
  const Joints& joints = scene.joints;
  const auto have = [&](FaceKind kind) {
    return std::ranges::find(assembly.face_kinds, kind) != assembly.face_kinds.end();
  };
  const auto have_block = [&](const auto& is_it) { return std::ranges::any_of(assembly.blocks, is_it); };
  const auto is_herringbone = [](const Block& block) { return block.kind == BlockKind::herringbone; };
  const auto is_piece = [](const Block& block) { return block.name.find('#') != std::string::npos; };
  const struct {
    Sort sort;
    bool has_law, exists;
    const char* what;
  } kinds[] = {
      {Sort::bed, joints.bed.has_value(), have(FaceKind::bed), "joint between courses"},
      {Sort::head, joints.head.has_value(), have(FaceKind::head), "joint within a course"},
      {Sort::herringbone, joints.herringbone.has_value(), have_block(is_herringbone), "herringbone block"},
      {Sort::wythe, joints.wythe.has_value(), have(FaceKind::wythe), "joint between layers of the thickness"},
      {Sort::pieces, joints.pieces.has_value(), have_block(is_piece),
       "imported block in pieces, named NAME#1, NAME#2, ..."}};
  for (const auto& kind : kinds) {
    const auto check = [&](bool given, const std::string& key) {
      refuse.unless(!given || kind.exists,
                    fmt::format("{}: has no effect: the model has no {}; remove it", key, kind.what));
    };
    const std::string name = to_string(kind.sort);
    check(kind.has_law, fmt::format("joints.{}", name));
    for (size_t i = 0; i < joints.rings.size(); ++i)
      check(joints.rings[i].sort == kind.sort, fmt::format("joints.rings[{}].kind = {}", i, name));
  }
}

void check_sequence(const std::vector<BlockRef>& sequence, const Assembly& assembly, const Refusal& refuse) {
  const char* key = "analysis.staged.sequence";
  std::set<int> laid;
  for (BlockRef block : sequence) {
    resolve_block_name(assembly, key, &block);
    const std::string label = block_label(assembly, block);
    refuse.unless(!assembly.blocks[static_cast<size_t>(block)].fixed,
                  fmt::format("{}: block {} is a support, which is not laid", key, label));
    // A case may give one block by its number and again by its name.
    refuse.unless(laid.insert(block).second,
                  fmt::format("{}: names block {} twice, by its name or its number {}; remove one", key,
                              label, block.number));
  }
}

}  // namespace

void refuse_keys_without_effect(const Case& scene, const Assembly& assembly) {
  const Refusal refuse(assembly);
  check_kinds(scene, assembly, refuse);
  for (size_t i = 0; i < scene.joints.rings.size(); ++i)
    refuse.course(fmt::format("joints.rings[{}].from", i), scene.joints.rings[i].from);
  for (size_t i = 0; i < scene.loads.faces.size(); ++i)
    refuse.course(fmt::format("loads.faces[{}].from_ring", i), scene.loads.faces[i].from_ring);
  for (size_t i = 0; i < scene.loads.forces.size(); ++i) {
    const std::optional<SharingBlocks>& over = scene.loads.forces[i].over;
    refuse.unless(!over || over->course < 0 || assembly.num_rings > 0,
                  fmt::format("loads.forces[{}].over.course: the model has no courses; remove it", i));
  }
  const Analysis& analysis = scene.analysis;
  if (analysis.type == AnalysisType::limit && analysis.limit.joints)
    refuse.course("analysis.limit.joints.from", analysis.limit.joints->from);
  if (analysis.type != AnalysisType::staged) return;
  refuse.unless(
      assembly.num_rings > 0,
      "analysis.type: staged requires blocks in courses, and the import found none; use type: static");
  check_sequence(analysis.staged.sequence, assembly, refuse);
}

}  // namespace cupola
