#include "generators/stereotomy/groin_vault.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/polygon_parts.hpp"
#include "generators/stereotomy/convex_clip.hpp"
#include "generators/stereotomy/cut_planes.hpp"
#include "generators/stereotomy/internal_faces.hpp"

namespace cupola {
namespace {

using std::numbers::pi;
using Groins = Plan::Groins;
constexpr std::array kSides{0, 1};  // right and left, seen from the axis

/// A convex piece of a stone of the web.
struct Piece {
  Part part;
  ConvexPiece shape;
  int stone = 0;  ///< of the web
  int side = 0;   ///< of kSides, on which its corner lies
};

class Crossing {
 public:
  Crossing(const Storey& shell, const MemberStart& start, const CutOptions& options, Assembly* assembly)
      : shell_(shell), options_(options), assembly_(assembly), turned_(static_cast<size_t>(webs())) {
    for (size_t p = start.part; p < assembly->parts.size(); ++p) {
      const Part& part = assembly->parts[p];
      const int row = part.ring - shell.surface.rings_below;
      pieces_.push_back({part, piece_of(*assembly, part), part.block - static_cast<int>(start.block),
                         2 * row < shell.surface.num_rings() ? 0 : 1});
      pieces_.back().part.ring = level_of(part.ring);
    }
    stones_.assign(assembly->blocks.begin() + static_cast<std::ptrdiff_t>(start.block),
                   assembly->blocks.end());
    const int first_face = assembly->parts[start.part].face_start;
    assembly->blocks.resize(start.block);
    assembly->parts.resize(start.part);
    assembly->face_kinds.resize(first_face);
    assembly->face_vertices.resize(assembly->face_vertex_start[first_face]);
    assembly->face_vertex_start.resize(first_face + 1);
    group_.resize(stones_.size() * webs());
    std::iota(group_.begin(), group_.end(), 0);
    for (const Piece& piece : pieces_)
      for (const ConvexPiece::Face& face : piece.shape.faces)
        for (const int v : face.vertices) size_ = std::max(size_, assembly->vertices[v].norm());
  }

  /// Joins in each course the two stones that share the largest area of a groin, and gives the faces there
  /// their kinds.
  void join() {
    using Patch = std::pair<int, PlanePolygon>;                                // stone of the web, face
    std::map<std::pair<int, int>, std::array<std::vector<Patch>, 2>> patches;  // by course and wythe
    for (Piece& piece : pieces_)
      for (ConvexPiece::Face& face : piece.shape.faces)
        for (const int side : kSides)
          if (lies_in(face, groin_cut(webs(), side).normal, 0.0)) {
            std::vector<Vec3> points = points_of(face);
            for (Vec3& p : points) p = turn(-side) * p;  // the left side of the neighbour meets the right one
            patches[{piece.part.ring, piece.part.wythe}][side].emplace_back(piece.stone, std::move(points));
            face.kind = FaceKind::head;
          }
    std::array<std::set<int>, 2> used;
    for (const auto& [place, of_sides] : patches) {
      if (!is_bonded(place.first)) continue;
      std::map<std::pair<int, int>, double> shared;  // m2, by the stones on both sides
      for (const auto& [right, face] : of_sides[0])
        for (const auto& [left, other] : of_sides[1])
          if (!used[0].contains(right) && !used[1].contains(left))
            if (const auto patch = divide(face.corners, other, rounding()).inside; !patch.empty())
              shared[{right, left}] += polygon_area(patch);
      if (shared.empty()) continue;
      const auto [right, left] =
          std::ranges::max_element(shared, {}, [](const auto& pair) { return pair.second; })->first;
      used[0].insert(right);
      used[1].insert(left);
      for (int web = 0; web < webs(); ++web) unite(node(web, right), node((web + webs() - 1) % webs(), left));
    }
  }

  double rounding() const { return 1e-9 * size_; }  // m

  /// Joins the stones of the lowest courses at each corner, and adds what lies between them and a level bed
  /// through the lowest edge of the first beds.
  void join_springers() {
    if (shell_.surface.springers == 0) return;
    std::vector<int> first(webs(), -1);  // stone of all webs, per corner
    for (const Piece& piece : pieces_) {
      if (piece.part.ring >= shell_.surface.rings_below + shell_.surface.springers) continue;
      stones_[piece.stone].kind = BlockKind::standard;
      for (int web = 0; web < webs(); ++web) {
        int& of_corner = first[(web + piece.side) % webs()];
        if (of_corner < 0) of_corner = node(web, piece.stone);
        unite(of_corner, node(web, piece.stone));
      }
    }
    std::vector<Piece> wedges;
    for (const int side : kSides) {
      for (const auto& [piece, face] : first_beds(side))
        for (const ConvexPiece& wedge : wedges_under(face, side)) {
          wedges.push_back({piece.part, wedge, piece.stone, side});
          for (const ConvexPiece::Face& bed : wedge.faces)
            if (bed.kind == FaceKind::bed && bed.plane >= 0) level_beds_[side].push_back(bed);
        }
    }
    pieces_.insert(pieces_.end(), wedges.begin(), wedges.end());
  }

  void add_supports() {
    const std::array feet{foot(0), foot(1)};
    for (int corner = 0; corner < webs(); ++corner) {
      Block block;
      block.kind = BlockKind::support;
      block.fixed = true;
      block.ring = -1;
      block.density = options_.density;
      assembly_->blocks.push_back(block);
      for (const int side : kSides)
        for (const ConvexPiece& prism : feet[side]) {
          Part part;
          part.ring = -1;
          part.slice = corner;
          add_part(part, prism, (corner + webs() - side) % webs());
        }
    }
  }

  void add_stones() {
    std::map<int, std::vector<std::pair<int, const Piece*>>> groups;  // web and piece
    for (int web = 0; web < webs(); ++web)
      for (const Piece& piece : pieces_) groups[group_of(node(web, piece.stone))].emplace_back(web, &piece);
    struct Stone {
      int level;
      double azimuth;
      Block block;
      std::vector<std::pair<int, const Piece*>> pieces;
    };
    std::vector<Stone> stones;
    for (const auto& [group, pieces] : groups) {
      Stone stone{std::numeric_limits<int>::max(), 0.0, stones_[pieces.front().second->stone], pieces};
      int last = 0;
      Vec3 middle = Vec3::Zero();
      for (const auto& [web, piece] : pieces) {
        const Block& own = stones_[piece->stone];
        stone.block.truncated = stone.block.truncated || own.truncated;
        stone.block.rib = stone.block.rib || web != pieces.front().first;
        stone.level = std::min(stone.level, piece->part.ring);
        last = std::max(last, piece->part.ring);
        for (const ConvexPiece::Face& face : piece->shape.faces)
          for (const int v : face.vertices) middle += turn(web) * assembly_->vertices[v];
      }
      stone.block.ring = stone.level;
      stone.block.num_rings = last - stone.level + 1;
      stone.block.sail = pieces.front().first;
      const bool closes = middle.head<2>().norm() < 1e-9 * size_;
      stone.azimuth = closes ? -pi : std::atan2(middle.y(), middle.x());
      stones.push_back(std::move(stone));
    }
    std::ranges::stable_sort(stones, {}, [](const Stone& s) { return std::pair(s.level, s.azimuth); });
    for (Stone& stone : stones) {
      const bool follows = !assembly_->blocks.empty() && assembly_->blocks.back().ring == stone.level;
      stone.block.slot = follows ? assembly_->blocks.back().slot + 1 : 0;
      assembly_->blocks.push_back(stone.block);
      for (const auto& [web, piece] : stone.pieces) {
        Part part = piece->part;
        part.slice += web * shell_.bond.num_slices();
        add_part(part, piece->shape, web);
      }
    }
  }

 private:
  int webs() const { return shell_.surface.webs; }
  int node(int web, int stone) const { return web * static_cast<int>(stones_.size()) + stone; }
  int group_of(int n) const {
    while (group_[n] != n) n = group_[n];
    return n;
  }
  void unite(int a, int b) {
    const int of_a = group_of(a), of_b = group_of(b);
    group_[std::max(of_a, of_b)] = std::min(of_a, of_b);
  }
  /// Course of a course of the web, counted from both ends.
  int level_of(int ring) const {
    const int row = ring - shell_.surface.rings_below;
    return shell_.surface.rings_below + std::min(row, shell_.surface.num_rings() - 1 - row);
  }
  bool is_bonded(int level) const {
    const int course = level - shell_.surface.rings_below;
    const bool is_key = 2 * course + 1 == shell_.surface.num_rings();
    return shell_.surface.groins == Groins::bonded ||
           (shell_.surface.groins == Groins::alternate && (course % 2 == 0 || is_key));
  }
  std::vector<Vec3> points_of(const ConvexPiece::Face& face) const {
    std::vector<Vec3> points;
    for (const int v : face.vertices) points.push_back(assembly_->vertices[v]);
    return points;
  }
  bool lies_in(const ConvexPiece::Face& face, const Vec3& normal, double offset) const {
    const Plane plane = polygon_plane(points_of(face));
    return plane.normal.dot(normal) > 1.0 - 1e-9 && std::abs(plane.offset - offset) < 1e-9 * size_;
  }
  Eigen::AngleAxisd turn(int web) const { return {2.0 * pi * web / webs(), Vec3::UnitZ()}; }

  int add_vertex(const Vec3& point, int layer, double depth) {
    if (!assembly_->vertex_layers.empty()) {
      assembly_->vertex_layers.push_back(layer);
      assembly_->vertex_depths.push_back(depth);
    }
    assembly_->vertices.push_back(point);
    return static_cast<int>(assembly_->vertices.size()) - 1;
  }
  /// The vertex of a web that corresponds to one of the first.
  int turned(int web, int vertex) {
    if (web == 0) return vertex;
    const auto [found, is_new] = turned_[web].try_emplace(vertex, 0);
    if (is_new) {
      const bool layers = !assembly_->vertex_layers.empty();
      found->second =
          add_vertex(turn(web) * assembly_->vertices[vertex], layers ? assembly_->vertex_layers[vertex] : -1,
                     layers ? assembly_->vertex_depths[vertex] : 0.0);
    }
    return found->second;
  }
  void add_part(Part part, const ConvexPiece& shape, int web) {
    part.block = static_cast<int>(assembly_->blocks.size()) - 1;
    part.face_start = assembly_->num_faces();
    part.num_faces = 0;
    assembly_->parts.push_back(part);
    for (const ConvexPiece::Face& face : shape.faces) {
      std::vector<int> vertices;
      for (const int v : face.vertices) vertices.push_back(turned(web, v));
      assembly_->add_face(vertices, face.kind);
    }
  }

  /// Down, normal to the first bed of the web (right) or the last.
  Vec3 down_from(int side) const {
    const SurfaceMap& surface = shell_.surface;
    const int bed = side == 0 ? 0 : surface.num_rows, inside = side == 0 ? 1 : bed - 1;
    const Vec3 corner = surface.intrados(bed, 0.0);
    const Vec3 along = (surface.extrados(bed, 0.0) - corner).cross(Vec3::UnitY()).normalized();
    return along.dot(surface.intrados(inside, 0.0) - corner) > 0.0 ? Vec3(-along) : along;
  }
  /// The faces of the first bed (right) or the last, with their pieces.
  std::vector<std::pair<Piece, ConvexPiece::Face>> first_beds(int side) const {
    const Vec3 corner = shell_.surface.intrados(side == 0 ? 0 : shell_.surface.num_rows, 0.0);
    const Vec3 down = down_from(side);
    std::vector<std::pair<Piece, ConvexPiece::Face>> beds;
    for (const Piece& piece : pieces_)
      for (const ConvexPiece::Face& face : piece.shape.faces)
        if (face.kind == FaceKind::bed && lies_in(face, down, down.dot(corner)) &&
            polygon_centroid(points_of(face)).x() * corner.x() > 0.0)  // level beds lie in one plane
          beds.emplace_back(piece, face);
    return beds;
  }
  /// The prisms on which the web stands on one side.
  std::vector<ConvexPiece> foot(int side) {
    ConvexClip clip(body_of(groin_cut(webs(), side)), 1e-12 * size_, assembly_);
    std::vector<ConvexPiece> prisms;
    const auto add = [&](const ConvexPiece::Face& face, const Vec3& down) {
      for (const ConvexPiece& prism : clip.outside(prism_behind(face, options_.support_width * down)))
        prisms.push_back(prism);
    };
    for (const ConvexPiece::Face& bed : level_beds_[side]) add(bed, -Vec3::UnitZ());
    if (level_beds_[side].empty())
      for (const auto& [piece, face] : first_beds(side)) add(face, down_from(side));
    return prisms;
  }
  /// What lies between a face of the first bed and a level bed, whose faces have a plane.
  std::vector<ConvexPiece> wedges_under(const ConvexPiece::Face& face, int side) {
    const int bed = side == 0 ? 0 : shell_.surface.num_rows;
    const auto [low, high] =
        std::minmax({shell_.surface.intrados(bed, 0.0).z(), shell_.surface.extrados(bed, 0.0).z()});
    if (high - low <= rounding()) return {};  // level as it is
    const Vec3 down = down_from(side);
    ConvexClip under({Plane{Vec3::UnitZ(), low}}, 1e-12 * size_, assembly_);
    ConvexClip beyond_groin(body_of(groin_cut(webs(), side)), 1e-12 * size_, assembly_);
    std::vector<ConvexPiece> wedges;
    for (const ConvexPiece& above :
         under.outside(prism_behind(face, 2.0 * (high - low) / std::abs(down.z()) * down)))
      for (ConvexPiece wedge : beyond_groin.outside(above)) {
        for (ConvexPiece::Face& f : wedge.faces) {
          const bool is_level = f.plane >= 0 && lies_in(f, -Vec3::UnitZ(), -low);
          if (is_level) f.kind = FaceKind::bed;
          if (!is_level) f.plane = -1;
        }
        wedges.push_back(std::move(wedge));
      }
    return wedges;
  }
  ConvexPiece prism_behind(const ConvexPiece::Face& face, const Vec3& depth) {
    const std::vector<int>& top = face.vertices;
    std::vector<int> bottom;
    for (const int v : top) bottom.push_back(add_vertex(assembly_->vertices[v] + depth, -1, 0.0));
    ConvexPiece prism;
    prism.faces.push_back({{top.rbegin(), top.rend()}, FaceKind::bed, -1});
    prism.faces.push_back({bottom, FaceKind::free, -1});
    for (size_t i = 0; i < top.size(); ++i) {
      const size_t j = (i + 1) % top.size();
      prism.faces.push_back({{top[i], top[j], bottom[j], bottom[i]}, FaceKind::free, -1});
    }
    return prism;
  }

  const Storey& shell_;
  const CutOptions& options_;
  Assembly* assembly_;
  double size_ = 0.0;                                         // m
  std::vector<Piece> pieces_;                                 // of the web
  std::array<std::vector<ConvexPiece::Face>, 2> level_beds_;  // of springers, per side
  std::vector<Block> stones_;                                 // of the web
  std::vector<int> group_;                                    // of the stones of all webs
  std::vector<std::map<int, int>> turned_;                    // per web, vertices of the first
};

}  // namespace

void cross_webs(const Storey& shell, const MemberStart& start, const CutOptions& options,
                Assembly* assembly) {
  std::vector<CutBody> bodies;
  for (const int side : kSides) {
    const Cut cut = groin_cut(shell.surface.webs, side);
    bodies.push_back({cut, {body_of(cut)}, shell.key});
  }
  cut_bodies(bodies, start, options.support_width, options.density, 0.0, {}, assembly);
  if (2 * shell.surface.springers >= shell.surface.num_rings())
    throw InputError(fmt::format(
        "{}.surface.plan.springers = {}: must be below {}, the courses from the supports to the crown",
        shell.key, shell.surface.springers, (shell.surface.num_rings() + 1) / 2));
  Crossing crossing(shell, start, options, assembly);
  crossing.join_springers();
  crossing.join();
  if (shell.surface.first_bed_held) crossing.add_supports();
  crossing.add_stones();
  mark_internal_faces(start.part, crossing.rounding(), assembly);
}

}  // namespace cupola
