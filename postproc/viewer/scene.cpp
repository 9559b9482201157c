#include "postproc/viewer/scene.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/with_capital.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/tables/range_values.hpp"
#include "postproc/tables/result_columns.hpp"
#include "postproc/viewer/scene_shapes.hpp"

namespace cupola {
namespace {

using Json = nlohmann::json;

/// Above it only the outer faces are drawn, and numbers of blocks are rounded to seven digits: 20,000 blocks
/// take some 5 MB of the report.
constexpr size_t kMostWholeBlocks = 20'000;
/// Above it joints have no outlines and fewer columns, rounded to seven digits: 30,000 joints take some 5 MB.
constexpr size_t kMostWholeJoints = 30'000;

/// Columns in the order in which a click shows them. The shell forces exist in vaults only.
constexpr std::array kShellKeys{"meridional_force_N_per_m", "hoop_force_N_per_m"};
constexpr std::array kBlockKeys{"weight_N", "resultant_N", "couple_length_m", "friction_use", "kern_use"};
constexpr std::array kMovedKeys{"opening_m", "slip_m", "displacement_m", "m"};
constexpr std::array kForceKeys{"normal_force_N", "friction_use", "kern_use", "force_N", "m"};
constexpr std::array kJointKeysAlso{"eccentricity_m", "edge_distance_m", "couple_length_m", "area_m2",
                                    "opening_m",      "open_share",      "slip_m"};

constexpr const char* kCertainty = "relative_range";
constexpr std::array kStrengthKeys{"largest_pressure_Pa", "strength_use", "damage"};

using KeyList = std::vector<const char*>;

void append_keys(Keys more, KeyList* keys) {
  keys->insert(keys->end(), more.begin(), more.end());
}

KeyList block_keys(const Evaluation& e) {
  KeyList keys;
  if (at_rest(e)) {
    append_keys(kBlockKeys, &keys);
    if (is_vault(e)) append_keys(kShellKeys, &keys);
  } else {
    keys.push_back("weight_N");
  }
  append_keys(kMovedKeys, &keys);
  return keys;
}

/// "Normal force" for normal_force_N; the meaning where the key is a unit only.
std::string label_of(const ColumnInfo& column) {
  std::string suffix = column.unit == "N/m" ? "N_per_m" : column.unit;
  std::erase(suffix, ' ');
  std::string text = column.array_name();
  if (text == suffix)
    text = column.meaning;
  else if (!suffix.empty() && text.ends_with("_" + suffix))
    text.resize(text.size() - suffix.size() - 1);
  std::replace(text.begin(), text.end(), '_', ' ');
  return with_capital(text);
}

/// True for a share that the view shows in percent, as the cards do.
bool is_share(const std::string& key) {
  return key == "friction_use" || key == "strength_use" || key == "open_share" || key == "damage";
}

/// Entries of the header for one column: one, or three for a vector.
template <class Row>
Json column_entries(const Columns<Row>& columns, const KeyList& keys) {
  Json entries = Json::array();
  for (const char* key : keys) {
    const Column<Row>& column = column_named(columns, key);
    for (const std::string& table_key : column.table_keys())
      entries.push_back({{"key", table_key},
                         {"unit", is_share(table_key) ? "share" : column.unit},
                         {"label", label_of(column)},
                         {"meaning", column.meaning},
                         {"colour", !column.is_vector}});
  }
  return entries;
}

/// The values of columns as arrays named `prefix` and the key of the table.
template <class Row, class Rows>
void add_columns(const std::string& prefix, const Columns<Row>& columns, const KeyList& keys,
                 const Rows& rows, bool rounded, PackedArrays* arrays) {
  for (const char* key : keys) {
    const Column<Row>& column = column_named(columns, key);
    std::vector<double> numbers;
    for (const Row& row : rows) append_reals(column.value(row), &numbers);
    const std::vector<std::string> table_keys = column.table_keys();
    for (size_t k = 0; k < table_keys.size(); ++k) {
      std::vector<double> component;
      component.reserve(rows.size());
      for (size_t i = k; i < numbers.size(); i += table_keys.size()) component.push_back(numbers[i]);
      if (rounded)
        arrays->add_rounded(prefix + table_keys[k], component);
      else
        arrays->add(prefix + table_keys[k], component);
    }
  }
}

/// What a block is in its bond.
enum class BondRole : std::uint8_t { flat, corner, upright, support, other };
constexpr std::array kBondRoles{"Laid flat", "Laid flat, across a corner", "Upright (herringbone)", "Support",
                                "Block"};

BondRole role_of(const Block& block) {
  if (block.fixed || block.kind == BlockKind::support) return BondRole::support;
  if (block.kind == BlockKind::herringbone) return BondRole::upright;
  if (block.kind == BlockKind::imported) return BondRole::other;
  return block.rib ? BondRole::corner : BondRole::flat;
}

/// Names of the wythes and groups of bonders, and of the supports behind them; none for a shell of one wythe.
std::vector<std::string> members_of(const Assembly& assembly) {
  std::vector<std::string> names = assembly.members;
  if (!names.empty()) names.emplace_back("Support");
  return names;
}

void add_blocks(const Evaluation& e, const Film& film, bool rounded, PackedArrays* arrays) {
  std::vector<std::uint8_t> role, fixed;
  std::vector<int> ring, member, body = film.bodies();
  std::vector<double> centroid;
  for (const Block& block : e.assembly.blocks) {
    role.push_back(static_cast<std::uint8_t>(role_of(block)));
    fixed.push_back(block.fixed);
    ring.push_back(block.ring);
    member.push_back(block.fixed ? static_cast<int>(e.assembly.members.size()) : block.member);
    centroid.insert(centroid.end(), block.centroid.begin(), block.centroid.end());
  }
  body.resize(e.assembly.blocks.size(), 0);
  arrays->add("block.role", role);
  arrays->add("block.fixed", fixed);
  arrays->add("block.ring", ring, 1);
  if (!e.assembly.members.empty()) {
    std::vector<double> apart;
    for (const Vec3& shift : shifts_by_wythe(e.assembly, e.shell))
      apart.insert(apart.end(), shift.begin(), shift.end());
    arrays->add("block.member", member, 1);
    arrays->add_rounded("block.apart", apart);
  }
  arrays->add("block.body", body, 1);
  arrays->add("block.centroid", centroid);
  add_columns("block.", block_columns(), block_keys(e), block_rows(e, e.last), rounded, arrays);
}

/// The joints of one state: their blocks, outlines and columns.
void add_joints(int state, const JointWrenches& joints, const std::vector<ForceRange>& ranges,
                const KeyList& keys, bool rounded, const Lattice& lattice, PackedArrays* arrays) {
  const std::string prefix = fmt::format("state{}.", state);
  std::vector<int> block_a, block_b, ring;
  std::vector<std::uint8_t> kind, on_first, corners;
  std::vector<Vec3> outlines;
  for (const JointWrench& joint : joints.wrenches) {
    block_a.push_back(joint.block_a);
    block_b.push_back(joint.block_b);
    ring.push_back(joint.ring);
    kind.push_back(static_cast<std::uint8_t>(joint.kind));
    on_first.push_back(joint.upper == joint.block_a);
    const size_t count = rounded ? 0 : std::min<size_t>(joint.patch.outline.size(), 255);
    corners.push_back(static_cast<std::uint8_t>(count));
    for (size_t i = 0; i < count; ++i) outlines.push_back(joint.patch.position(joint.patch.outline[i]));
  }
  arrays->add(prefix + "block_a", block_a, 1);
  arrays->add(prefix + "block_b", block_b, 1);
  arrays->add(prefix + "ring", ring, 1);
  arrays->add(prefix + "kind", kind);
  arrays->add(prefix + "on_first", on_first);
  arrays->add(prefix + "corners", corners);
  arrays->add_points(prefix + "outlines", outlines, lattice);
  add_columns(prefix, joint_columns(), keys, joints.wrenches, rounded, arrays);
  if (const std::vector<double> certainty = relative_ranges(ranges, joints.wrenches); !certainty.empty())
    arrays->add_rounded(prefix + kCertainty, certainty);
}

/// Entries of the header for the columns of the joints, with the certainty of their forces if the run has
/// ranges of joints.
Json joint_entries(const Evaluation& e, const KeyList& keys) {
  Json entries = column_entries(joint_columns(), keys);
  if (!relative_ranges(e.summary.ranges, e.last.joints.wrenches).empty())
    entries.push_back({{"key", kCertainty},
                       {"unit", ""},
                       {"label", "Uncertainty of the normal force"},
                       {"meaning", "width of the range over its mean, 0: certain, 2: from zero"},
                       {"colour", true}});
  return entries;
}

double largest_norm_in(const std::vector<double>& vectors) {
  double largest = 0.0;
  for (size_t i = 0; i + 2 < vectors.size(); i += 3)
    largest = std::max(largest, Vec3(vectors[i], vectors[i + 1], vectors[i + 2]).norm());
  return largest;
}

/// Step of numbers up to `largest`: at most `step`, and fine enough to be magnified.
double fine_step(double step, double largest) {
  constexpr double kLevels = 1e5;
  return largest > 0.0 ? std::min(step, largest / kLevels) : step;
}

Json add_film(const Evaluation& e, const Film& film, const Lattice& lattice, PackedArrays* arrays) {
  constexpr std::array kNames{"displacement", "motion", "mechanism", "stages"};
  std::vector<double> shifts = film.shifts(), turns = film.turns();
  if (film.num_frames() == 0) {  // no frame could be read: the blocks as built
    shifts.assign(3 * e.assembly.blocks.size(), 0.0);
    turns = shifts;
  }
  const double farthest = largest_norm_in(shifts), widest = largest_norm_in(turns);
  const int back = 3 * static_cast<int>(e.assembly.blocks.size());
  arrays->add_multiples("film.shift", shifts, fine_step(lattice.step, farthest), back);
  // A point of a block moves by less than half a step of the lattice where the block turns by a step.
  const Box box = box_of(e.assembly);
  const double size = (box.high - box.low).norm();
  arrays->add_multiples("film.turn", turns, fine_step(lattice.step / size, widest), back);
  return {{"kind", kNames[static_cast<size_t>(film.kind())]},
          {"frames", std::max(1, film.num_frames())},
          {"evaluated", film.evaluated()},
          {"largest_shift_m", farthest},
          {"labels", film.labels()},
          {"born", film.born()}};
}

std::vector<std::string> notes_of(const Evaluation& e, const Film& film, bool inner_faces,
                                  bool whole_joints) {
  std::vector<std::string> notes;
  if (!inner_faces)
    notes.push_back(
        fmt::format("Faces inside the joints are left out and the numbers of the blocks are rounded to seven "
                    "digits, because the model has more than {}.",
                    counted(kMostWholeBlocks, "block")));
  if (!whole_joints)
    notes.push_back(
        fmt::format("The outlines of the joints and some of their numbers are left out and the others are "
                    "rounded to seven digits, because there are more than {}; joints.csv holds all of them.",
                    counted(kMostWholeJoints, "joint")));
  if (film.skipped() > 0)
    notes.push_back(fmt::format("The film shows {} of {}.", film.num_frames(),
                                counted(film.num_frames() + film.skipped(), "frame")));
  if (film.skipped_states() > 0)
    notes.push_back(fmt::format("{} of the ranges were left out to limit the size; ParaView shows them.",
                                counted(film.skipped_states(), "state")));
  if (!at_rest(e))
    notes.push_back(std::string("Forces are not drawn: ") +
                    (e.last.frame.role == FrameRole::unconverged
                         ? "no equilibrium was found."
                         : "those of a moving structure last an instant; joints.csv has them."));
  return notes;
}

/// What the displacements that are drawn have to do with real ones; "" if a slider says it.
std::string scale_text(const Evaluation& e, const Film& film) {
  if (film.kind() == Film::Kind::motion)
    return fmt::format("Displacements{} to scale",
                       e.scene.supports.base_motion ? " relative to the ground," : "");
  if (film.kind() != Film::Kind::mechanism) return "";
  const char* what = !at_rest(e)          ? "How it begins to move"
                     : e.summary.critical ? "How it would begin to move beyond its limit"
                                          : "How the part that falls begins to move";
  return fmt::format("{}. Drawn large, up to {}: only the directions are known.", what,
                     length_text(largest_norm_in(film.shifts())));
}

/// The largest number of a body; 0 if nothing moves.
int largest_body(const Film& film) {
  return film.bodies().empty() ? 0 : *std::max_element(film.bodies().begin(), film.bodies().end());
}

/// The first colours: of the motion if there is one; of its bodies if they are few enough to differ in
/// colour.
std::string first_colour(const Evaluation& e, const Film& film) {
  constexpr int kMostBodies = 7;
  if (film.kind() == Film::Kind::mechanism && largest_body(film) > 0)
    return largest_body(film) <= kMostBodies ? "body" : "displacement";
  return film.kind() == Film::Kind::motion && !at_rest(e) ? "displacement" : "bond";
}

Json block_names_of(const Assembly& assembly) {
  if (assembly.blocks.empty() || assembly.blocks.front().name.empty()) return nullptr;
  Json names = Json::array();
  for (const Block& block : assembly.blocks) names.push_back(block.name);
  return names;
}

Json point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

double largest_rounding_mm(const Evaluation& e) {
  return 1e3 * 0.5 * std::sqrt(3.0) * lattice_of(e.assembly).step;
}

std::string scene_bytes(const Evaluation& e, const Film& film) {
  const Lattice lattice = lattice_of(e.assembly);
  const bool inner_faces = e.assembly.blocks.size() <= kMostWholeBlocks;
  const bool whole_joints = e.last.joints.wrenches.size() <= kMostWholeJoints;
  PackedArrays arrays;
  add_faces(e.assembly, inner_faces, lattice, &arrays);
  add_blocks(e, film, !inner_faces, &arrays);
  KeyList joint_keys;
  append_keys(kForceKeys, &joint_keys);
  if (whole_joints) append_keys(kJointKeysAlso, &joint_keys);
  if (whole_joints && std::any_of(e.last.joints.wrenches.begin(), e.last.joints.wrenches.end(),
                                  [](const JointWrench& j) { return std::isfinite(j.strength_use); }))
    append_keys(kStrengthKeys, &joint_keys);
  Json states = Json::array();
  const auto add_state = [&](const std::string& name, const JointWrenches& joints) {
    add_joints(static_cast<int>(states.size()), joints, e.summary.ranges, joint_keys, !whole_joints, lattice,
               &arrays);
    states.push_back({{"name", name}});
  };
  if (at_rest(e)) {
    add_state("State of the report", e.last.joints);
    for (const Film::State& state : film.range_states()) add_state(state.name, state.joints);
  }
  const Json lines = add_lines(e, lattice, &arrays), ties = add_ties(e, lattice, &arrays);
  const Json frames = add_film(e, film, lattice, &arrays);
  const Box box = box_of(e.assembly);
  return arrays.bytes({{"title", e.scene.title},
                       {"up", point(e.up)},
                       {"box", {point(box.low), point(box.high)}},
                       {"rounding_mm", largest_rounding_mm(e)},
                       {"courses", e.assembly.num_rings},
                       {"roles", kBondRoles},
                       {"members", members_of(e.assembly)},
                       {"kinds", names_of<JointKind>()},
                       {"names", block_names_of(e.assembly)},
                       {"bodies", largest_body(film)},
                       {"colour", first_colour(e, film)},
                       {"scale", scale_text(e, film)},
                       {"floor_N", e.last.joints.floor.force},
                       {"block_columns", column_entries(block_columns(), block_keys(e))},
                       {"joint_columns", joint_entries(e, joint_keys)},
                       {"states", states},
                       {"joint_outlines", whole_joints},
                       {"lines", lines},
                       {"ties", ties},
                       {"wythes", e.shell.most_wythes()},
                       {"film", frames},
                       {"notes", notes_of(e, film, inner_faces, whole_joints)}});
}

}  // namespace cupola
