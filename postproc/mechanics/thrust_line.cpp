#include "postproc/mechanics/thrust_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Least normal component of a resultant on its bed, as a share of its norm. Below it, the line of action
/// meets the plane of the bed too far away to have a position. Dry joints exceed it for any friction
/// coefficient up to 10.
constexpr double kLeastNormalShare = 0.1;

/// The facets of one block on one bed, their range of azimuths and their mean plane.
struct BlockBed {
  std::vector<const BedFacet*> facets;
  double from = 0.0, to = 0.0;  // rad, unwrapped
  Plane plane;
};

std::map<int, BlockBed> blocks_on(const std::vector<BedFacet>& bed) {
  std::map<int, BlockBed> blocks;
  for (const BedFacet& facet : bed) {
    const auto [entry, is_new] = blocks.try_emplace(facet.block);
    BlockBed& block = entry->second;
    const double a = azimuth(facet.intrados_a);
    if (is_new) block.from = block.to = a;
    for (const Vec3& corner : {facet.intrados_a, facet.intrados_b}) {
      const double angle = block.from + wrapped(azimuth(corner) - block.from);
      block.from = std::min(block.from, angle);
      block.to = std::max(block.to, angle);
    }
    block.facets.push_back(&facet);
  }
  for (auto& [id, block] : blocks) {
    Vec3 normal = Vec3::Zero(), mean = Vec3::Zero();
    for (const BedFacet* f : block.facets) {
      normal += (f->intrados_b - f->extrados_a).cross(f->extrados_b - f->intrados_a);
      mean += 0.25 * (f->intrados_a + f->intrados_b + f->extrados_a + f->extrados_b);
    }
    normal.normalize();
    block.plane = {normal, normal.dot(mean) / static_cast<double>(block.facets.size())};
  }
  return blocks;
}

/// Share of a block's width that lies in the strip.
double overlap(const BlockBed& block, double center, double width) {
  const double middle = 0.5 * (block.from + block.to);
  const double offset = wrapped(center - middle);
  const double half = 0.5 * (block.to - block.from);
  const double common = std::min(half, offset + width / 2) - std::max(-half, offset - width / 2);
  return half > 0.0 ? std::max(0.0, common) / (2.0 * half) : 0.0;
}

/// Position through the thickness of a point in the plane of the bed, from its distances to the intrados and
/// extrados edges of the nearest facet.
double position_in(const BlockBed& block, const Vec3& x) {
  const BedFacet* facet = block.facets.front();
  double nearest = std::numeric_limits<double>::infinity();
  for (const BedFacet* f : block.facets) {
    const double distance =
        (0.25 * (f->intrados_a + f->intrados_b + f->extrados_a + f->extrados_b) - x).squaredNorm();
    if (distance < nearest) {
      nearest = distance;
      facet = f;
    }
  }
  const auto from_edge = [&](const Vec3& a, const Vec3& b, const Vec3& inside) {
    const Vec3 along = (b - a).normalized();
    const auto rejection = [&](const Vec3& p) { return Vec3(p - a - along.dot(p - a) * along); };
    return rejection(x).dot(rejection(inside).normalized());
  };
  const double inner = from_edge(facet->intrados_a, facet->intrados_b, facet->extrados_a);
  const double outer = from_edge(facet->extrados_a, facet->extrados_b, facet->intrados_a);
  return inner / (inner + outer);
}

/// Wrench on the piece of a block above a bed inside the block: it balances the weight of the piece and its
/// contact forces.
Wrench wrench_through(const ThrustInput& in, int block, int bed) {
  Wrench w;
  w.point = in.assembly->blocks[block].centroid;
  for (const Part& part : in.assembly->parts) {
    if (part.block != block || part.ring < bed) continue;
    const SolidProperties solid = solid_properties(*in.assembly, part);
    w.add_force(solid.centroid, -in.assembly->blocks[block].density * solid.volume * in.gravity);
  }
  const ContactTable& c = *in.contacts;
  for (const JointWrench& joint : in.joints->wrenches) {
    if (joint.block_a != block && joint.block_b != block) continue;
    const double sign = joint.block_b == block ? -1.0 : 1.0;
    for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
      const int row = in.joints->contacts[i];
      const int ring = joint.lower == block ? c.ring[row] - 1 : c.ring[row];
      if (ring >= bed) w.add_force(c.point[row], sign * c.force[row]);
    }
  }
  return w;
}

/// Wrench of a block on the support above the last bed of an arch; zero under a free edge.
Wrench wrench_onwards(const ThrustInput& in, int block) {
  Wrench w;
  w.point = in.assembly->blocks[block].centroid;
  for (const JointWrench& joint : in.joints->wrenches)
    if (joint.lower == block) w.add(wrench_on(joint, joint.upper));
  return w;
}

/// The wrench turned about the z axis.
Wrench turned(const Wrench& w, double angle) {
  const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  return {R * w.point, R * w.force, R * w.moment};
}

/// Finds intrados and extrados of the bed in the meridian plane, or in the middle of the width of an arch.
/// False if the bed does not cross the meridian.
bool find_skins(const std::vector<BedFacet>& bed, std::optional<double> meridian, ThrustPoint* point) {
  if (!meridian) {
    point->intrados = point->extrados = Vec3::Zero();
    const double n = static_cast<double>(bed.size());
    for (const BedFacet& f : bed) {
      point->intrados += (f.intrados_a + f.intrados_b) / (2.0 * n);
      point->extrados += (f.extrados_a + f.extrados_b) / (2.0 * n);
    }
    return !bed.empty();
  }
  const Vec3 across(-std::sin(*meridian), std::cos(*meridian), 0.0);
  const Vec3 outwards(std::cos(*meridian), std::sin(*meridian), 0.0);
  for (const BedFacet& f : bed) {
    const double a = across.dot(f.intrados_a), b = across.dot(f.intrados_b);
    if (a * b > 0.0 || a == b || outwards.dot(f.intrados_a) <= 0.0) continue;
    const auto meet = [&](const Vec3& p, const Vec3& q) {
      const double s = across.dot(p), t = across.dot(q);
      return s == t ? p : Vec3(p + s / (s - t) * (q - p));
    };
    point->intrados = meet(f.intrados_a, f.intrados_b);
    point->extrados = meet(f.extrados_a, f.extrados_b);
    return true;
  }
  return false;
}

/// Sums the blocks of the strip on one bed. False if none of them carries a force.
///
/// The position of the strip is the mean of the blocks' positions weighted by their normal forces on the bed.
/// The moments of the normal forces thus add up, and a force along the bed, whose position is ill-defined,
/// has no weight.
bool sum_strip(const ThrustInput& in, int bed, std::optional<double> meridian, ThrustPoint* point) {
  Wrench sum;
  sum.point = 0.5 * (point->intrados + point->extrados);
  double weighted_position = 0.0, pressing = 0.0;
  const Vec3& onwards = in.shell->direction(bed);
  for (const auto& [id, block] : blocks_on(in.shell->beds[bed])) {
    const double share = meridian ? overlap(block, *meridian, in.shell->block_width_rad) : 1.0;
    if (share <= 0.0) continue;
    const Wrench w = wrench_at_bed(in, id, bed);
    if (w.force.norm() == 0.0) continue;
    const Vec3 x = axis_in_plane(central_axis(w), w.force, block.plane);
    const double turn = meridian ? *meridian - 0.5 * (block.from + block.to) : 0.0;
    sum.add(share * turned(w, turn));
    const double normal =
        std::copysign(1.0, block.plane.normal.dot(onwards)) * block.plane.normal.dot(w.force);
    weighted_position += share * normal * position_in(block, x);
    pressing += share * normal;
    ++point->blocks;
  }
  if (point->blocks == 0) return false;
  if (pressing > kLeastNormalShare * sum.force.norm()) point->position = weighted_position / pressing;
  point->force = sum.force;
  point->r = sum.force.norm();
  point->v = sum.force.z();
  point->couple_length = couple_length(sum, in.joints->floor);
  return true;
}

/// Finds the part of the bed that pushes. A point that carries less than kLeastShare of the mean of its joint's does not.
void find_compressed_zone(const ThrustInput& in, int bed, std::optional<double> meridian,
                          ThrustPoint* point) {
  constexpr double kLeastShare = 1e-6;
  const bool last = bed == in.shell->num_rings();
  const ContactTable& c = *in.contacts;
  double force = 0.0, area = 0.0;
  for (const auto& [id, block] : blocks_on(in.shell->beds[bed])) {
    if (meridian && overlap(block, *meridian, in.shell->block_width_rad) <= 0.0) continue;
    if (!last && in.assembly->blocks[id].ring != bed) continue;
    for (const JointWrench& joint : in.joints->wrenches) {
      if ((last ? joint.lower : joint.upper) != id || joint.negligible) continue;
      const double least = kLeastShare * std::max(0.0, joint.normal_force) / joint.num_contacts;
      for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
        const int row = in.joints->contacts[i];
        if (c.normal_force[row] <= least) continue;
        const double position = std::clamp(position_in(block, c.point[row]), 0.0, 1.0);  // rounding
        point->compressed_from = std::fmin(point->compressed_from, position);            // skips NaN
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

}  // namespace

double ThrustLine::largest_couple_length() const {
  double largest = 0.0;
  for (const ThrustPoint& p : points) largest = std::fmax(largest, p.couple_length);  // skips NaN
  return largest;
}

Wrench wrench_at_bed(const ThrustInput& in, int block, int bed) {
  CUPOLA_ASSERT(bed >= 0 && bed <= in.shell->num_rings());
  if (bed == in.shell->num_rings()) return wrench_onwards(in, block);
  return in.assembly->blocks[block].ring == bed ? in.from_below[block] : wrench_through(in, block, bed);
}

ThrustLine thrust_line(const ThrustInput& input, const std::string& name, std::optional<double> azimuth_deg) {
  CUPOLA_ASSERT(input.from_below.size() == input.assembly->blocks.size());
  CUPOLA_ASSERT(input.shell->num_rings() == 0 ||
                static_cast<int>(input.shell->beds.size()) == input.shell->num_rings() + 1);
  ThrustLine line;
  line.name = name;
  line.azimuth_deg = azimuth_deg.value_or(0.0);
  std::optional<double> meridian;
  if (azimuth_deg) meridian = *azimuth_deg * std::numbers::pi / 180.0;
  for (int bed = 0; bed <= input.shell->num_rings(); ++bed) {
    ThrustPoint point;
    point.bed = bed;
    if (!find_skins(input.shell->beds[bed], meridian, &point)) continue;
    if (!sum_strip(input, bed, meridian, &point)) continue;
    find_compressed_zone(input, bed, meridian, &point);
    line.points.push_back(point);
  }
  for (ThrustPoint& point : line.points) measure(input.joints->floor, &point);
  line.undefined = static_cast<int>(std::count_if(line.points.begin(), line.points.end(),
                                                  [](const ThrustPoint& p) { return !p.is_placed(); }));
  line.inside = line.undefined < static_cast<int>(line.points.size());
  line.least_face_distance = line.least_geometric_safety = std::numeric_limits<double>::infinity();
  for (const ThrustPoint& point : line.points) {
    if (!point.is_placed()) continue;
    line.inside = line.inside && point.face_distance >= 0.0;
    line.least_face_distance = std::min(line.least_face_distance, point.face_distance);
    line.least_geometric_safety = std::min(line.least_geometric_safety, point.geometric_safety);
  }
  const Vec3 outwards = meridian ? Vec3(std::cos(*meridian), std::sin(*meridian), 0.0) : Vec3::UnitX();
  for (size_t i = 1; i < line.points.size(); ++i) {
    if (!line.points[i - 1].is_placed() || !line.points[i].is_placed()) continue;
    if (const auto meet = meeting(line.points[i - 1], line.points[i], outwards))
      line.envelope.push_back(*meet);
  }
  return line;
}

}  // namespace cupola
