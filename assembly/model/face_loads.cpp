#include "assembly/model/face_loads.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/fill_pressure.hpp"
#include "assembly/model/joint_rule.hpp"
#include "assembly/model/loaded_faces.hpp"
#include "assembly/model/open_tops.hpp"

namespace cupola {
namespace {

constexpr std::array kOutside{FaceKind::bed, FaceKind::head, FaceKind::intrados, FaceKind::extrados,
                              FaceKind::top, FaceKind::free, FaceKind::wythe};

/// The kinds of face that free blocks of a member have, as the end of a sentence.
std::string kinds_of(const Assembly& assembly, const std::string& member) {
  std::string kinds;
  for (const FaceKind kind : {FaceKind::extrados, FaceKind::intrados, FaceKind::top, FaceKind::free}) {
    const std::vector<LoadedFace> faces = faces_of_kind(assembly, std::array{kind}, 0, kLastRing, member);
    if (faces.empty()) continue;
    const auto [low, high] = std::ranges::minmax(
        faces, {}, [&](const LoadedFace& face) { return assembly.blocks[face.block].ring; });
    kinds += fmt::format("{}{} (rings {} to {})", kinds.empty() ? "" : ", ", to_string(kind),
                         assembly.blocks[low.block].ring, assembly.blocks[high.block].ring);
  }
  return kinds.empty() ? "none that a load can act on" : kinds;
}

void check_faces_exist(bool exist, const FaceLoad& load, const Assembly& assembly, const std::string& key) {
  if (exist) return;
  throw InputError(fmt::format("{}: no free block{}{} has faces of kind {}; {} has: {}", key,
                               load.member.empty() ? "" : " of " + load.member,
                               load.from_ring == 0 && load.to_ring == kLastRing
                                   ? ""
                                   : fmt::format(" in rings {} to {}", load.from_ring, load.to_ring),
                               to_string(load.faces), load.member.empty() ? "the model" : "it",
                               kinds_of(assembly, load.member)));
}

/// Of the kind of a load; those of tops without what masonry below `level` covers.
std::vector<LoadedFace> faces_of(const FaceLoad& load, const Assembly& assembly, double level) {
  if (load.faces == FaceKind::top)
    return open_tops(assembly, load.from_ring, load.to_ring, load.member, false, level);
  return faces_of_kind(assembly, std::array{load.faces}, load.from_ring, load.to_ring, load.member);
}

void add_traction(const FaceLoad& load, const Assembly& assembly, const std::string& key, int time,
                  std::vector<PointForce>* forces) {
  const std::vector<LoadedFace> faces = faces_of(load, assembly, std::numeric_limits<double>::infinity());
  check_faces_exist(!faces.empty(), load, assembly, key);
  for (const LoadedFace& face : faces)
    forces->push_back(
        {face.block, face.centroid, face.area * (load.traction - load.pressure * face.normal), time});
}

/// The faces on which a fill lies. That on the extrados lies on the tops beside it, too.
std::vector<LoadedFace> faces_under(const FaceLoad& load, const Assembly& assembly, const std::string& key) {
  const double level = load.fill->level;
  const std::vector<LoadedFace> of_kind = faces_of(load, assembly, level);
  std::vector<LoadedFace> under = open_parts(assembly, of_kind, level);
  if (load.faces == FaceKind::extrados)
    std::ranges::move(open_tops(assembly, load.from_ring, load.to_ring, load.member, true, level),
                      std::back_inserter(under));
  check_faces_exist(!of_kind.empty() || !under.empty(), load, assembly, key);
  return under;
}

void add_fill(const FaceLoad& load, const Assembly& assembly, const std::string& key, const Loads& loads,
              int time, std::vector<PointForce>* forces) {
  const Fill& fill = *load.fill;
  std::vector<LoadedFace> faces = faces_under(load, assembly, key);
  if (std::ranges::none_of(faces, [&](const LoadedFace& face) {
        return std::ranges::any_of(face.polygon, [&](const Vec3& p) { return fill.stress(p.z()) > 0.0; });
      }))
    throw InputError(fmt::format(
        "{}: the fill up to z = {:g} m lies on none of the faces of kind {}: they are steep, covered or "
        "higher; earth against a vertical back is a `pressure` on its courses, by from_ring and to_ring",
        key, fill.level, to_string(load.faces)));
  if (fill.horizontal > 0.0)
    std::ranges::move(
        beside_fill(fill, faces_of_kind(assembly, kOutside, load.from_ring, load.to_ring, load.member), faces,
                    joint_rule(smallest_block_size(assembly), 0.0).margin),
        std::back_inserter(faces));
  // The pull acts in full, whatever part of the dead load.
  const bool splits = is_dead_load(load) && !std::holds_alternative<ConstantInTime>(loads.dead_load_time);
  for (const LoadedFace& face : faces) {
    const auto [point, force] = fill_force(fill, face, loads.gravity + loads.pull);
    if (force.norm() == 0.0) continue;
    const Vec3 pulled = splits ? Vec3(force - fill_force(fill, face, loads.gravity).force) : Vec3(0, 0, 0);
    forces->push_back({face.block, point, force - pulled, time});
    if (pulled.norm() > 0.0) forces->push_back({face.block, point, pulled, PointForce::kSteady});
  }
}

}  // namespace

bool is_dead_load(const FaceLoad& load) {
  return load.fill && std::holds_alternative<ConstantInTime>(load.time);
}

void add_face_load(const FaceLoad& load, const Assembly& assembly, const std::string& key, const Loads& loads,
                   int time, std::vector<PointForce>* forces) {
  check_member_exists(assembly, load.member, key);
  if (load.traction.norm() > 0.0 || load.pressure != 0.0 || !load.fill)
    add_traction(load, assembly, key, time, forces);
  if (load.fill) add_fill(load, assembly, key, loads, time, forces);
}

}  // namespace cupola
