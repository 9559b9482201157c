#include "generators/stereotomy/cut_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/convex_clip.hpp"
#include "generators/stereotomy/internal_faces.hpp"
#include "generators/stereotomy/piece_courses.hpp"
#include "generators/stereotomy/support.hpp"

namespace cupola {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();  // m

/// A convex piece of a block, with the part from which it was cut.
struct Cell {
  Part part;
  ConvexPiece piece;
  int block = 0;
  int side = 0;  ///< of the joints that part its block: pieces on different sides are different blocks
  bool is_changed = false;
  bool is_rest = false;                   ///< of a block too small to stay one
  int first_course = 0, last_course = 0;  ///< that it occupies
};

/// The work on one member.
class Carving {
 public:
  Carving(const MemberStart& start, BedUnder bed_under, double gap, Assembly* assembly)
      : start_(start), bed_under_(std::move(bed_under)), assembly_(assembly), gap_(gap) {
    Eigen::AlignedBox3d box;
    for (size_t p = start.part; p < assembly->parts.size(); ++p) {
      const Part& part = assembly->parts[p];
      cells_.push_back({part, piece_of(*assembly, part), part.block, 0, false, false});
      for (const ConvexPiece::Face& face : cells_.back().piece.faces)
        for (const int v : face.vertices) box.extend(assembly->vertices[v]);
    }
    rounding_ = 1e-12 * box.diagonal().norm();
    volumes_.assign(assembly->blocks.size() - start.block, 0.0);
    slices_.assign(volumes_.size(), -1);
    for (const Cell& cell : cells_) {
      const size_t block = cell.block - start.block;
      volumes_[block] += volume_of(*assembly, cell.piece);
      if (slices_[block] < 0) slices_[block] = cell.part.slice;
    }
  }

  /// Takes the bodies of a cut from all pieces; the faces of stones that lie on them.
  std::vector<std::vector<Vec3>> take(const CutBody& of) {
    std::vector<std::vector<Vec3>> faces;
    bool any = false;
    for (const std::vector<Plane>& body : of.bodies) any = take_one(body, of.from_supports, &faces) || any;
    if (!any && !of.from_supports)
      throw InputError(of.key + ": the cut takes nothing; " +
                       (of.cut.kind == Cut::Kind::under || of.cut.kind == Cut::Kind::over
                            ? "the member or a copy of it lies beside " + of.cut.member
                            : "its coordinates, in m, are those of the member before `at`"));
    if (std::ranges::none_of(cells_, [&](const Cell& c) { return !assembly_->blocks[c.block].fixed; }))
      throw InputError(of.key + ": the cut takes all blocks");
    return faces;
  }

  /// Parts the blocks that a plane meets in two, which share a joint there.
  void part(const std::vector<Plane>& half_space, const std::string& key) {
    ConvexClip clip(half_space, rounding_, assembly_);
    std::vector<Cell> parted;
    std::map<int, std::array<bool, 2>> sides;  // of blocks: outside and inside of the half-space
    for (Cell& cell : cells_) {
      const std::vector<ConvexPiece> outside = clip.outside(cell.piece);
      const ConvexPiece inside = clip.inside(cell.piece);
      const bool is_fixed = assembly_->blocks[cell.block].fixed;
      if (is_fixed || inside.faces.empty() || outside.empty()) {
        if (!is_fixed) {
          cell.side = 2 * cell.side + (outside.empty() ? 1 : 0);
          sides[cell.block][outside.empty() ? 1 : 0] = true;
          for (ConvexPiece::Face& face : cell.piece.faces)  // between slices
            if (face.kind == FaceKind::internal && lies_in(half_space.front(), face, -near(face)))
              face.kind = FaceKind::head;
        }
        parted.push_back(std::move(cell));
        continue;
      }
      sides[cell.block] = {true, true};
      for (const auto& [piece, side] : {std::pair(outside.front(), 0), {inside, 1}}) {
        parted.push_back({cell.part, piece, cell.block, 2 * cell.side + side, true, false});
        for (ConvexPiece::Face& face : parted.back().piece.faces) {
          if (face.plane >= 0) face.kind = FaceKind::head;
          face.plane = -1;
        }
      }
    }
    cells_ = std::move(parted);
    std::map<int, int> rank;  // of sides, which doubling would soon make too large
    for (const Cell& cell : cells_) rank[cell.side] = 0;
    for (int next = 0; auto& [side, own] : rank) own = next++;
    for (Cell& cell : cells_) cell.side = rank.at(cell.side);
    const size_t before = touched_.size();
    for (const auto& [block, on] : sides)
      if (on[0] && on[1]) touched_.push_back(block);
    if (touched_.size() == before)
      throw InputError(
          key + ": the plane parts no block; its coordinates, in m, are those of the member before `at`");
  }

  /// Gives the pieces of cut blocks to blocks, and writes all.
  void write() {
    std::ranges::sort(touched_);
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (size_t i = 0; i < cells_.size(); ++i) {
      Cell& cell = cells_[i];
      const Block& laid = assembly_->blocks[cell.block];
      std::tie(cell.first_course, cell.last_course) =
          courses_of(*assembly_, cell.piece, cell.part, laid, bed_under_, 10.0 * rounding_ + gap_);
      of_block_[cell.block].push_back(i);
      of_ring_[laid.ring].push_back(i);
      most_courses_ = std::max(most_courses_, laid.num_rings);
    }
    for (const int block : touched_) separate(block);
    join_rests();
    drop_idle_supports();
    const std::map<int, Extent> extents = extents_of_blocks();
    std::vector<Block> blocks(assembly_->blocks.begin(),
                              assembly_->blocks.begin() + static_cast<std::ptrdiff_t>(start_.block));
    std::ranges::stable_sort(cells_, {}, [&](const Cell& c) {
      const Extent& extent = extents.at(c.block);
      return std::tuple(extent.place, extent.is_moved, c.block);
    });
    assembly_->parts.resize(start_.part);
    const int first_face = start_face_;
    assembly_->face_kinds.resize(first_face);
    assembly_->face_vertices.resize(assembly_->face_vertex_start[first_face]);
    assembly_->face_vertex_start.resize(first_face + 1);
    int before = -1;
    for (const Cell& cell : cells_) {
      if (cell.block != before) {
        Block block = assembly_->blocks[origin(cell.block)];
        block.truncated = block.truncated || (cell.is_changed && !block.fixed);
        block.ring = extents.at(cell.block).first;
        block.num_rings = extents.at(cell.block).last - block.ring + 1;
        const bool follows = !blocks.empty() && blocks.back().ring == block.ring && !blocks.back().fixed;
        block.slot = block.fixed ? block.slot : follows ? blocks.back().slot + 1 : 0;
        blocks.push_back(block);
        before = cell.block;
      }
      Part part = cell.part;
      part.block = static_cast<int>(blocks.size()) - 1;
      part.ring = cell.first_course;
      part.face_start = assembly_->num_faces();
      part.num_faces = 0;
      assembly_->parts.push_back(part);
      for (const ConvexPiece::Face& face : cell.piece.faces) assembly_->add_face(face.vertices, face.kind);
    }
    assembly_->blocks = std::move(blocks);
  }

  double rounding() const { return rounding_; }

 private:
  /// m, up to which a face lies in a plane: stones end off the plane of a head joint.
  double near(const ConvexPiece::Face& face) const {
    return 10.0 * rounding_ + (face.kind == FaceKind::internal ? 0.0 : gap_);
  }
  /// True if a face does not rise above a plane, nor lie lower than `least` (m).
  bool lies_in(const Plane& plane, const ConvexPiece::Face& face, double least) const {
    return std::ranges::all_of(face.vertices, [&](int v) {
      const double height = plane.normal.dot(assembly_->vertices[v]) - plane.offset;
      return height >= least && height <= near(face);
    });
  }
  /// True for a face of the cut, and for one that lay there before.
  bool lies_on(const std::vector<Plane>& body, const ConvexPiece::Face& face) const {
    const Vec3 normal = polygon_plane(points_of(*assembly_, face)).normal;
    return std::ranges::all_of(body, [&](const Plane& p) { return lies_in(p, face, -kFar); }) &&
           std::ranges::any_of(body, [&](const Plane& p) {
             return normal.dot(p.normal) < 0.0 && lies_in(p, face, -near(face));
           });
  }

  /// Takes a body, and adds the faces of stones that lie on it; true if it met a block.
  bool take_one(const std::vector<Plane>& body, bool from_supports, std::vector<std::vector<Vec3>>* faces) {
    ConvexClip clip(body, rounding_, assembly_);
    std::vector<Cell> left;
    bool any = false;
    for (Cell& cell : cells_) {
      if (from_supports && !assembly_->blocks[cell.block].fixed) {
        left.push_back(std::move(cell));
        continue;
      }
      std::vector<ConvexPiece> pieces = clip.outside(cell.piece);
      const bool whole =
          pieces.size() == 1 && pieces.front().faces.size() == cell.piece.faces.size() &&
          std::ranges::none_of(pieces.front().faces, [](const auto& f) { return f.plane >= 0; });
      any = any || !whole;
      for (ConvexPiece& piece : pieces) {
        if (volume_of(*assembly_, piece) <= std::pow(1e3 * rounding_, 3)) continue;
        for (ConvexPiece::Face& face : piece.faces) {
          face.plane = -1;
          if (!lies_on(body, face)) continue;
          if (face.kind == FaceKind::internal) face.kind = FaceKind::free;  // of a slice
          if (!assembly_->blocks[cell.block].fixed) faces->push_back(points_of(*assembly_, face));
        }
        left.push_back(
            {cell.part, std::move(piece), cell.block, cell.side, cell.is_changed || !whole, false});
      }
      if (!whole) touched_.push_back(cell.block);
    }
    cells_ = std::move(left);
    return any;
  }

  /// The block as laid from which a block was separated.
  int origin(int block) const {
    const int laid = static_cast<int>(assembly_->blocks.size());
    return block < laid ? block : separated_[block - laid];
  }
  const std::vector<size_t>& cells_of(int block) const {
    static const std::vector<size_t> kNone;
    const auto found = of_block_.find(block);
    return found == of_block_.end() ? kNone : found->second;
  }
  double volume(int block) const {
    double sum = 0.0;
    for (const size_t i : cells_of(block)) sum += volume_of(*assembly_, cells_[i].piece);
    return sum;
  }

  /// Courses of the pieces of a block, and its place in their order.
  struct Extent {
    int first = std::numeric_limits<int>::max(), last = -1;
    int slice = 0;          ///< in the first course
    int place = 0;          ///< the block as laid from which it was separated, or behind which it stands
    bool is_moved = false;  ///< it begins in another course than the block from which it was separated
  };

  std::map<int, Extent> extents_of_blocks() const {
    std::map<int, Extent> extents;
    for (const Cell& cell : cells_) {
      Extent& extent = extents[cell.block];
      if (cell.first_course < extent.first) extent.slice = cell.part.slice;
      extent.first = std::min(extent.first, cell.first_course);
      extent.last = std::max(extent.last, cell.last_course);
    }
    for (auto& [block, extent] : extents) {
      extent.place = origin(block);
      extent.is_moved = assembly_->blocks[extent.place].ring != extent.first;
      if (extent.is_moved) extent.place = block_before(extent.first, extent.slice);
    }
    return extents;
  }
  /// The last block as laid that does not stand behind a slice of a course.
  int block_before(int course, int slice) const {
    int before = static_cast<int>(start_.block);
    for (size_t i = 0; i < slices_.size(); ++i) {
      const int number = static_cast<int>(start_.block + i);
      const Block& block = assembly_->blocks[number];
      const bool is_before = block.ring < course || block.slot == 0 || slices_[i] <= slice;
      if (!block.fixed && block.ring <= course && is_before) before = number;
    }
    return before;
  }

  /// Gives the pieces that do not touch the first ones numbers of new blocks.
  void separate(int block) {
    const std::vector<size_t> cells = cells_of(block);  // a copy: they move
    of_block_.erase(block);
    std::vector<int> group(cells.size());
    std::iota(group.begin(), group.end(), 0);
    for (size_t i = 0; i < cells.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        const int of_i = group[i], of_j = group[j];
        if (of_i != of_j && cells_[cells[i]].side == cells_[cells[j]].side &&
            shared_width(*assembly_, cells_[cells[i]].piece, cells_[cells[j]].piece, rounding_) > 0.0)
          std::ranges::replace(group, of_i, of_j);
      }
    std::vector<std::pair<int, int>> numbers;  // group, block
    for (size_t i = 0; i < cells.size(); ++i) {
      const auto known = std::ranges::find(numbers, group[i], &std::pair<int, int>::first);
      if (known == numbers.end()) {
        int number = block;
        if (!numbers.empty()) {
          number = static_cast<int>(assembly_->blocks.size() + separated_.size());
          separated_.push_back(block);
          added_.push_back(number);
        }
        numbers.emplace_back(group[i], number);
        cells_[cells[i]].block = number;
      } else {
        cells_[cells[i]].block = known->second;
      }
      of_block_[cells_[cells[i]].block].push_back(cells[i]);
    }
  }

  /// Drops what is left of supports on which no stone of the first or the last course stands any more.
  void drop_idle_supports() {
    std::vector<size_t> resting;
    const auto first = of_ring_.upper_bound(-1);
    if (first == of_ring_.end()) return;
    for (const int ring : {first->first, of_ring_.rbegin()->first})
      resting.insert(resting.end(), of_ring_[ring].begin(), of_ring_[ring].end());
    std::set<int> idle;
    for (const auto& [block, cells] : of_block_) {
      if (!assembly_->blocks[origin(block)].fixed || !std::ranges::binary_search(touched_, origin(block)))
        continue;
      const bool carries = std::ranges::any_of(cells, [&](size_t i) {
        return std::ranges::any_of(resting, [&](size_t j) {
          return shared_width(*assembly_, cells_[i].piece, cells_[j].piece, rounding_, gap_) > 0.0;
        });
      });
      if (!carries) idle.insert(block);
    }
    std::erase_if(cells_, [&](const Cell& cell) { return idle.contains(cell.block); });
  }

  void join_rests() {
    constexpr double kLeast = 0.1 * (1.0 - 1e-6);  // of the block as laid; not less by rounding alone
    std::vector<int> rests;
    for (const auto& [block, cells] : of_block_) {
      const int laid = origin(block);
      if (assembly_->blocks[laid].fixed || !std::ranges::binary_search(touched_, laid) ||
          volume(block) >= kLeast * volumes_[laid - start_.block])
        continue;
      rests.push_back(block);
      for (const size_t i : cells) cells_[i].is_rest = true;
    }
    // Those that touch no whole stone join what others have become part of.
    for (bool any = true; any;) {
      std::vector<size_t> joined;
      std::erase_if(rests, [&](int rest) {
        const std::vector<size_t> own = cells_of(rest);
        const bool is_joined = join(rest);
        if (is_joined) joined.insert(joined.end(), own.begin(), own.end());
        return is_joined;
      });
      for (const size_t i : joined) cells_[i].is_rest = false;
      any = !joined.empty();
    }
  }

  /// Joins a rest to the stone that it touches most widely, in its own course if it can; true if it touches
  /// one. Rests join no rests: those that a level cut leaves of a course would make one slab.
  bool join(int block) {
    const Block& laid = assembly_->blocks[origin(block)];
    const std::vector<size_t> own = cells_of(block);
    std::vector<int> courses{laid.ring, laid.ring - 1};  // in which its neighbours begin
    for (int above = 1; above <= laid.num_rings; ++above) courses.push_back(laid.ring + above);
    for (int below = 2; below <= most_courses_; ++below) courses.push_back(laid.ring - below);
    std::optional<int> widest;
    double width = 0.0;
    for (const int ring : courses) {
      const auto course = of_ring_.find(ring);
      if (course == of_ring_.end()) continue;
      for (const size_t k : course->second) {
        const Cell& other = cells_[k];
        if (other.is_rest || assembly_->blocks[origin(other.block)].fixed) continue;
        for (const size_t i : own)
          if (const double w = cells_[i].side == other.side
                                   ? shared_width(*assembly_, cells_[i].piece, other.piece, rounding_, gap_)
                                   : 0.0;
              w > width) {
            width = w;
            widest = other.block;
          }
      }
      if (widest) break;
    }
    if (!widest) return false;
    for (const size_t i : own) {
      cells_[i].block = *widest;
      cells_[i].is_changed = true;
      of_block_[*widest].push_back(i);
    }
    of_block_.erase(block);
    return true;
  }

  MemberStart start_;
  BedUnder bed_under_;
  Assembly* assembly_;
  double gap_ = 0.0;                                       // m, of the joints between blocks
  double rounding_ = 0.0;                                  // m
  std::vector<Cell> cells_;                                // by block
  std::map<int, std::vector<size_t>> of_block_, of_ring_;  // cells
  std::vector<double> volumes_;                            // m3, of the blocks as laid
  int most_courses_ = 1;                                   // of a block as laid
  std::vector<int> slices_;                                // first ones of the blocks as laid
  std::vector<int> touched_;                               // blocks as laid
  std::vector<int> separated_;                             // origins of the blocks numbered behind those laid
  std::vector<int> added_;                                 // these numbers
  int start_face_ = start_.part < assembly_->parts.size() ? assembly_->parts[start_.part].face_start : 0;
};

/// A box behind a plane, over the rectangle around the faces that lie in it.
void add_support(const Cut& cut, const std::vector<std::vector<Vec3>>& faces, double width, double density,
                 Assembly* assembly) {
  const Vec3 lost = cut.normal.normalized();
  const bool is_level = lost.head<2>().norm() < 1e-9;
  const Vec3 across = is_level ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitZ().cross(lost).normalized());
  const Vec3 up = lost.cross(across);
  Eigen::AlignedBox2d box;
  for (const std::vector<Vec3>& face : faces)
    for (const Vec3& p : face) box.extend(Eigen::Vector2d(across.dot(p - cut.point), up.dot(p - cut.point)));
  const auto corner = [&](double u, double v) -> Vec3 { return cut.point + u * across + v * up; };
  add_box_support({corner(box.min().x(), box.min().y()), corner(box.min().x(), box.max().y()),
                   corner(box.max().x(), box.max().y()), corner(box.max().x(), box.min().y())},
                  width * lost, density, assembly);
}

}  // namespace

void cut_bodies(const std::vector<CutBody>& bodies, const MemberStart& start, double support_width,
                double density, double gap, BedUnder bed_under, Assembly* assembly) {
  if (bodies.empty()) return;
  if (!assembly->vertex_layers.empty()) {
    assembly->vertex_layers.resize(assembly->vertices.size(), -1);  // corners of supports
    assembly->vertex_depths.resize(assembly->vertices.size(), 0.0);
  }
  Carving carving(start, std::move(bed_under), gap, assembly);
  std::vector<std::vector<std::vector<Vec3>>> faces(bodies.size());
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].cut.as == Cut::As::joint)
      carving.part(bodies[i].bodies.front(), bodies[i].key);
    else
      faces[i] = carving.take(bodies[i]);
  }
  carving.write();
  mark_internal_faces(start.part, 1e3 * carving.rounding() + 2.0 * gap, assembly);  // of rests, beyond a gap
  for (size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].cut.as != Cut::As::held) continue;
    if (faces[i].empty())
      throw InputError(bodies[i].key + ".as = held: the plane meets a support only, and no stone to be held");
    add_support(bodies[i].cut, faces[i], support_width, density, assembly);
  }
}

}  // namespace cupola
