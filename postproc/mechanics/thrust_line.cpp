#include "postproc/mechanics/thrust_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "postproc/mechanics/bed_blocks.hpp"
#include "postproc/mechanics/block_pieces.hpp"
#include "postproc/mechanics/strip.hpp"

namespace cupola {
namespace {

/// Least normal component of a resultant on its bed, as a share of its norm. Below it, the line of action
/// meets the plane of the bed too far away to have a position. Dry joints exceed it for any friction
/// coefficient up to 10.
constexpr double kLeastNormalShare = 0.1;

/// Share of the thickness by which a point on a face may lie beyond it: a hinge turns on the edges of two
/// blocks, which its joint lets approach.
constexpr double kOnFace = 1e-4;

/// Adds what balances the loads on the piece of a block above a bed inside the block.
void balance_loads(const ThrustInput& in, int block, int bed, Wrench* w) {
  for (auto on = std::ranges::lower_bound(in.loads, block, {}, &PointForce::block);
       on != in.loads.end() && on->block == block; ++on) {
    const PointForce& load = *on;
    const Vec3& at = load.of_moment ? in.assembly->blocks[block].centroid : load.point;
    if (ring_of_piece(*in.assembly, block, at) >= bed)
      w->add_force(in.poses.placed(block, load.point), -load.force);
  }
}

/// Wrench on the piece of a block above a bed inside the block, see ThrustLine.
Wrench wrench_through(const ThrustInput& in, int block, int bed) {
  Wrench w;
  w.point = in.assembly->blocks[block].centroid;
  const std::vector<Part>& parts = in.assembly->parts;
  for (auto part = std::ranges::lower_bound(parts, block, {}, &Part::block);
       part != parts.end() && part->block == block; ++part) {
    if (part->ring < bed) continue;
    const SolidProperties solid = solid_properties(*in.assembly, *part);
    w.add_force(in.poses.placed(block, solid.centroid),
                -in.assembly->blocks[block].density * solid.volume * in.gravity);
  }
  const ContactTable& c = *in.contacts;
  for (const int j : in.joints->of_block[block]) {
    const JointWrench& joint = in.joints->wrenches[j];
    const double sign = joint.block_b == block ? -1.0 : 1.0;
    for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
      const int row = in.joints->contacts[i];
      const Vec3 at = in.poses.as_built(block, c.point[row]);
      if (ring_of_piece(*in.assembly, block, at, c.ring[row]) >= bed)
        w.add_force(c.point[row], sign * c.force[row]);
    }
  }
  balance_loads(in, block, bed, &w);
  return w;
}

/// Wrench of a block on what lies above the bed that closes its stack; zero under a free edge.
Wrench wrench_onwards(const ThrustInput& in, int block, int bed) {
  Wrench w;
  w.point = in.assembly->blocks[block].centroid;
  for (const JointWrench* joint : joints_on(in, block, bed)) w.add(wrench_on(*joint, joint->upper));
  return w;
}

/// The wrench on a block turned about the axis, which moves with the block.
Wrench turned(const ThrustInput& in, int block, const Wrench& w, double angle, const Sheet& axis) {
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  const Vec3& centroid = in.assembly->blocks[block].centroid;
  const Vec3 foot =
      Vec3(axis.origin.x(), axis.origin.y(), 0.0) + (in.poses.placed(block, centroid) - centroid);
  return {foot + R * (w.point - foot), R * w.force, R * w.moment};
}

/// Where the edges of a facet meet the meridian plane as built, or its middle in an arch, placed with its
/// block. None if it does not cross the meridian.
struct FacetEdges {
  Vec3 inner, outer;
};
std::optional<FacetEdges> edges_on(const BedFacet& f, const Route& route, const Poses& poses) {
  const auto edges = [&](const Vec3& inner, const Vec3& outer) {
    return FacetEdges{poses.placed(f.block, inner), poses.placed(f.block, outer)};
  };
  if (!route.meridian) return edges(0.5 * (f.intrados_a + f.intrados_b), 0.5 * (f.extrados_a + f.extrados_b));
  const Vec3 outwards = route.axis.towards(*route.meridian), across(-outwards.y(), outwards.x(), 0.0);
  const Vec3 foot(route.axis.origin.x(), route.axis.origin.y(), 0.0);
  const double a = across.dot(f.intrados_a - foot), b = across.dot(f.intrados_b - foot);
  // Of two facets whose joint is on the meridian, both may end just beside it.
  const double rounding = kCornerRounding * std::abs(a - b);
  if (std::min(a, b) > rounding || std::max(a, b) < -rounding || a == b) return std::nullopt;
  if (outwards.dot(f.intrados_a - foot) <= 0.0) return std::nullopt;
  const auto meet = [&](const Vec3& p, const Vec3& q) {
    const double s = across.dot(p - foot), t = across.dot(q - foot);
    return s == t ? p : Vec3(p + s / (s - t) * (q - p));
  };
  return edges(meet(f.intrados_a, f.intrados_b), meet(f.extrados_a, f.extrados_b));
}

/// The place of a layer on the meridian, in an arch the mean over its width. If no facet ends at the layer
/// there, it lies on the line through the edges of another one. None if the bed does not cross the meridian.
std::optional<Vec3> place_of(const ThrustInput& in, int bed, double layer, const Route& route) {
  std::optional<Vec3> elsewhere;
  std::vector<Vec3> places;
  for (const BedFacet& f : in.shell->beds[bed]) {
    const std::optional<FacetEdges> edges = edges_on(f, route, in.poses);
    if (!edges) continue;
    if (f.from == layer || f.to == layer) {
      places.push_back(f.from == layer ? edges->inner : edges->outer);
      if (route.meridian) break;
    }
    if (!elsewhere)
      elsewhere = edges->inner + (layer - f.from) / (f.to - f.from) * (edges->outer - edges->inner);
  }
  if (places.empty()) return elsewhere;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& place : places) mean += place / static_cast<double>(places.size());
  return mean;
}

/// Finds the skins of the bed at two layers in the meridian plane. False if the bed does not cross the
/// meridian.
bool find_skins(const ThrustInput& in, int bed, const Layers& layers, const Route& route,
                ThrustPoint* point) {
  const auto inner = place_of(in, bed, layers.inner, route), outer = place_of(in, bed, layers.outer, route);
  if (!inner || !outer) return false;
  point->intrados = *inner;
  point->extrados = *outer;
  return true;
}

/// True if the bed force of a block cannot be shared among its wythes: it rests on, or is, a block through
/// several.
bool is_undivided(const ThrustInput& in, int block, int bed) {
  if (in.shell->wythes[block].count() == 1) return false;
  if (!stands_on(in, block, bed)) return true;
  return std::ranges::any_of(joints_on(in, block, bed), [&](const JointWrench* joint) {
    return !joint->negligible && wythes_of(*in.assembly, *in.shell, *joint).count() > 1;
  });
}

/// Wrench across a bed on a strand. In a wythe, the block must not be undivided.
Wrench wrench_of(const ThrustInput& in, const Route& route, int bed, const Strand& strand) {
  const int block = strand.block.block;
  const bool whole = !route.wythe || in.shell->wythes[block] == WytheRange{*route.wythe, *route.wythe + 1};
  if (whole && !strand.of_joint) return wrench_at_bed(in, block, bed);
  Wrench w;
  w.point = in.assembly->blocks[block].centroid;
  for (const JointWrench* joint : strand.joints) w.add(wrench_on(*joint, joint->upper));
  return w;
}

/// Normal force of a block on a bed, N, and the share of the thickness at which it acts.
struct Push {
  double normal_force = 0.0, share = 0.0;
};

/// From the block's wrench: where its line of action meets the mean plane of the bed.
Push push_of(const ThrustInput& in, const Wrench& placed, int bed, const BlockBed& block) {
  const Wrench w = in.poses.as_built(block.block, placed);
  const Vec3 x = axis_in_plane(central_axis(w), w.force, block.plane);
  const Vec3& normal = block.plane.normal;
  return {std::copysign(1.0, normal.dot(in.shell->direction(bed))) * normal.dot(w.force),
          share_at(in.shell->beds[bed], block, x)};
}

/// From the contact points of its joints on the bed.
Push push_at_points(const ThrustInput& in, int bed, const Strand& strand) {
  Bearing bearing;
  for (const JointWrench* joint : strand.joints)
    add_bearing(*joint, *in.joints, *in.contacts, in.shell->beds[bed], strand.block, in.poses, &bearing);
  return {bearing.normal_force, bearing.share()};
}

/// Sums the blocks of the strip on one bed. False if none of them carries a force, or if one is undivided.
///
/// The position of the strip is the mean of the blocks' positions weighted by their normal forces on the bed.
/// The moments of the normal forces thus add up, and a force along the bed, whose position is ill-defined,
/// has no weight.
bool sum_strip(const ThrustInput& in, int bed, const Layers& layers, const Route& route, ThrustPoint* point) {
  const std::optional<double>& meridian = route.meridian;
  const std::optional<int>& wythe = route.wythe;
  Wrench sum;
  sum.point = 0.5 * (point->intrados + point->extrados);
  double weighted_position = 0.0, pressing = 0.0;
  int last = -1;
  for (const Strand& strand : strands_on(in, bed, route)) {
    const BlockBed& block = strand.block;
    const int id = block.block;
    if (wythe && is_undivided(in, id, bed)) return false;
    if (wythe && !in.shell->wythes[id].contains(*wythe)) continue;
    const Wrench w = wrench_of(in, route, bed, strand);
    if (w.force.norm() == 0.0) continue;
    const double turn = meridian ? *meridian - 0.5 * (block.from + block.to) : 0.0;
    sum.add(strand.share * turned(in, id, w, turn, route.axis));
    // Forces that hold each other along the bed, as across a wide arch, shift the line of action of the
    // block's wrench; that of a bent stone runs inside its bend.
    const bool at_points =
        stands_on(in, id, bed) && (in.shell->num_wythes > 1 || !meridian || block.facets.size() > 1);
    const auto [normal, at] = at_points ? push_at_points(in, bed, strand) : push_of(in, w, bed, block);
    weighted_position += strand.share * normal * layers.position(at);
    pressing += strand.share * normal;
    if (id != last) ++point->blocks;
    last = id;
  }
  if (point->blocks == 0) return false;
  if (pressing > kLeastNormalShare * sum.force.norm()) point->position = weighted_position / pressing;
  point->force = sum.force;
  point->r = sum.force.norm();
  point->v = sum.force.z();
  point->couple_length = couple_length(sum, in.joints->floor);
  return true;
}

/// Finds the part of the bed that pushes. A point that carries less than kLeastShare of the mean of its
/// joint's does not.
void find_compressed_zone(const ThrustInput& in, int bed, const Layers& layers, const Route& route,
                          ThrustPoint* point) {
  constexpr double kLeastShare = 1e-6;
  const ContactTable& c = *in.contacts;
  double force = 0.0, area = 0.0;
  for (const Strand& strand : strands_on(in, bed, route)) {
    const BlockBed& block = strand.block;
    if (!stands_on(in, block.block, bed)) continue;
    for (const JointWrench* of_block : strand.joints) {
      const JointWrench& joint = *of_block;
      if (joint.negligible) continue;
      const double least = kLeastShare * std::max(0.0, joint.normal_force) / joint.num_contacts;
      for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
        const int row = in.joints->contacts[i];
        if (c.normal_force[row] <= least) continue;
        const Vec3 at = in.poses.as_built(block.block, c.point[row]);
        const double share = share_at(in.shell->beds[bed], block, at);
        const double position = std::clamp(layers.position(share), 0.0, 1.0);  // rounding
        point->compressed_from = std::fmin(point->compressed_from, position);  // skips NaN
        point->compressed_to = std::fmax(point->compressed_to, position);
        force += c.normal_force[row];
        area += c.area[row];
      }
    }
  }
  if (area > 0.0) point->pressure = force / area;
}

/// Fills in point, distance and safety from the position; all become NaN if the position is undefined.
void measure(const Floor& floor, ThrustPoint* point) {
  if (floor.hides(point->force)) point->position = std::numeric_limits<double>::quiet_NaN();
  const Vec3 through = point->extrados - point->intrados;
  point->point = point->intrados + point->position * through;
  point->face_distance = through.norm() * (0.5 - std::abs(point->position - 0.5));
  point->geometric_safety = 0.5 / std::abs(above(point->position - 0.5, floor.share));
}

/// Intersection of two lines of action in the plane spanned by `outwards` and z. None if they are nearly
/// parallel, so that it lies further from the middle of the two points than twice the distance between them.
std::optional<Vec3> meeting(const ThrustPoint& p, const ThrustPoint& q, const Vec3& outwards) {
  const auto flat = [&outwards](const Vec3& x) { return Eigen::Vector2d(outwards.dot(x), x.z()); };
  const Eigen::Vector2d d = flat(p.force), e = flat(q.force), offset = flat(q.point - p.point);
  const double denominator = d.x() * e.y() - d.y() * e.x();
  if (denominator == 0.0) return std::nullopt;
  const double s = (offset.x() * e.y() - offset.y() * e.x()) / denominator;
  const Vec3 meet = p.point + s * (d.x() * outwards + d.y() * Vec3::UnitZ());
  if ((meet - 0.5 * (p.point + q.point)).norm() > 2.0 * (p.point - q.point).norm()) return std::nullopt;
  return meet;
}

/// True if blocks on a bed are in the strip; also if none of the blocks that stand on it has a facet.
bool is_in_strip(const ThrustInput& in, int bed, const Route& route) {
  if (!in.shell->beds[bed].empty()) return !strands_on(in, bed, route).empty();
  return !route.wythe && std::ranges::any_of(in.assembly->blocks, [&](const Block& block) {
    return !block.fixed && block.ring == bed;
  });
}

}  // namespace

double ThrustLine::largest_couple_length() const {
  double largest = 0.0;
  for (const ThrustPoint& p : points) largest = std::fmax(largest, p.couple_length);  // skips NaN
  return largest;
}

std::vector<std::vector<Vec3>> ThrustLine::runs() const {
  std::vector<std::vector<Vec3>> runs(1);
  int last = -1;
  for (const ThrustPoint& p : points) {
    if (!p.is_placed() || (wythe && p.bed != last + 1)) runs.emplace_back();
    if (p.is_placed()) runs.back().push_back(p.point);
    last = p.bed;
  }
  std::erase_if(runs, [](const std::vector<Vec3>& run) { return run.size() < 2; });
  return runs;
}

Wrench wrench_at_bed(const ThrustInput& in, int block, int bed) {
  CUPOLA_ASSERT(bed >= 0 && bed < static_cast<int>(in.shell->beds.size()));
  if (in.shell->closes(bed)) return wrench_onwards(in, block, bed);
  return in.assembly->blocks[block].ring == bed ? in.from_below[block] : wrench_through(in, block, bed);
}

ThrustLine thrust_line(const ThrustInput& input, const std::string& name, std::optional<double> azimuth_deg,
                       std::optional<int> wythe, int ring) {
  CUPOLA_ASSERT(input.from_below.size() == input.assembly->blocks.size());
  ThrustLine line;
  line.name = name;
  line.azimuth_deg = azimuth_deg.value_or(0.0);
  line.arch = !azimuth_deg;
  line.wythe = wythe;
  std::optional<double> meridian;
  if (azimuth_deg) meridian = *azimuth_deg * std::numbers::pi / 180.0;
  const auto [first, end] = input.assembly->stack_of(ring);
  line.axis = input.assembly->axis_of(first);
  const std::vector<double>& widths = input.shell->block_width_rad;
  const double width = first < static_cast<int>(widths.size()) ? widths[first] : 0.0;
  const Route route{line.axis, width, meridian, wythe};
  std::optional<WytheRange> wythes;
  if (wythe) wythes = WytheRange{*wythe, *wythe + 1};
  const int last = std::min(end, input.shell->num_rings());
  for (int number = first; number <= last; ++number) {
    const int bed = number < last ? number : input.shell->bed_above(last - 1);
    ThrustPoint point;
    point.bed = number;
    const std::optional<Layers> layers = layers_of(*input.shell, bed, wythes);
    if (!layers || !find_skins(input, bed, *layers, route, &point)) {
      line.without_skins += is_in_strip(input, bed, route) ? 1 : 0;
      continue;
    }
    if (!sum_strip(input, bed, *layers, route, &point)) continue;
    find_compressed_zone(input, bed, *layers, route, &point);
    line.points.push_back(point);
  }
  for (ThrustPoint& point : line.points) measure(input.joints->floor, &point);
  line.undefined = static_cast<int>(std::count_if(line.points.begin(), line.points.end(),
                                                  [](const ThrustPoint& p) { return !p.is_placed(); }));
  line.inside = line.undefined < static_cast<int>(line.points.size());
  line.least_face_distance = line.least_geometric_safety = std::numeric_limits<double>::infinity();
  for (const ThrustPoint& point : line.points) {
    if (!point.is_placed()) continue;
    line.inside = line.inside && std::abs(point.position - 0.5) <= 0.5 + kOnFace;
    line.least_face_distance = std::min(line.least_face_distance, point.face_distance);
    line.least_geometric_safety = std::min(line.least_geometric_safety, point.geometric_safety);
  }
  const Vec3 outwards = line.axis.towards(meridian.value_or(0.0));
  for (size_t i = 1; i < line.points.size(); ++i) {
    if (!line.points[i - 1].is_placed() || !line.points[i].is_placed()) continue;
    if (const auto meet = meeting(line.points[i - 1], line.points[i], outwards))
      line.envelope.push_back(*meet);
  }
  return line;
}

}  // namespace cupola
