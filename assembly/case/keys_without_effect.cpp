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
  void law(const char* kind, bool given, bool present, const char* what) const {
    unless(!given || present,
           fmt::format("joints.{}: has no effect: the model has no {}; remove it", kind, what));
  }

 private:
  const Assembly& assembly_;
};

bool have_herringbone(const Assembly& assembly) {
  return std::ranges::any_of(assembly.blocks,
                             [](const Block& b) { return b.kind == BlockKind::herringbone; });
}

void check_joints(const Joints& joints, const Assembly& assembly, const Refusal& refuse) {
  refuse.law("herringbone", joints.herringbone.has_value(), have_herringbone(assembly), "herringbone block");
  refuse.law("wythe", joints.wythe.has_value(),
             std::ranges::find(assembly.face_kinds, FaceKind::wythe) != assembly.face_kinds.end(),
             "joint between layers of the thickness");
  const auto is_piece = [](const Block& block) { return block.name.find('#') != std::string::npos; };
  refuse.law("pieces", joints.pieces.has_value(), std::ranges::any_of(assembly.blocks, is_piece),
             "imported block in pieces, named NAME#1, NAME#2, ...");
  for (size_t i = 0; i < joints.rings.size(); ++i)
    refuse.course(fmt::format("joints.rings[{}].from", i), joints.rings[i].from);
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
  check_joints(scene.joints, assembly, refuse);
  for (size_t i = 0; i < scene.loads.faces.size(); ++i)
    refuse.course(fmt::format("loads.faces[{}].from_ring", i), scene.loads.faces[i].from_ring);
  const Analysis& analysis = scene.analysis;
  if (analysis.type == AnalysisType::limit && analysis.limit.joints)
    refuse.course("analysis.limit.joints.from", analysis.limit.joints->from);
  if (analysis.type != AnalysisType::staged) return;
  refuse.unless(
      assembly.num_rings > 0,
      "analysis.type: staged requires blocks in courses, and the import found none; use type: static");
  check_sequence(analysis.staged.sequence, assembly, refuse);
  const auto is_arch = [](const Sheet& sheet) { return sheet.thrust_lines == Sheet::ThrustLines::one; };
  refuse.unless(scene.joints.rings.empty() || std::ranges::none_of(assembly.sheets, is_arch),
                "joints.rings: analysis.type: staged lays the rings of both haunches of an arch or barrel at "
                "once, under one law; remove joints.rings");
}

}  // namespace cupola
