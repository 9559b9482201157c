#include "postproc/mechanics/plane_contacts.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "assembly/records/frame_record.hpp"

namespace cupola {
namespace {

/// Visitor of a record whose members are columns: writes each row twice.
struct RowsTwice {
  template <class T>
  void operator()(const char*, const char*, const char*, std::vector<T>& column) const {
    std::vector<T> twice;
    twice.reserve(2 * column.size());
    for (const T& value : column) twice.insert(twice.end(), 2, value);
    column = std::move(twice);
  }
};

/// m, per joint; 0 for a joint of a single point.
std::vector<double> widths_of(const ContactTable& c) {
  struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low, area = 0.0;
    Vec3 along = Vec3::Zero();
  };
  std::vector<Extent> extents;
  for (int i = 0; i < c.size(); ++i) {
    extents.resize(std::max(extents.size(), static_cast<size_t>(c.joint[i]) + 1));
    Extent& joint = extents[c.joint[i]];
    if (joint.along.isZero(0.0)) joint.along = c.normal[i].cross(Vec3::UnitY()).stableNormalized();
    joint.low = std::min(joint.low, joint.along.dot(c.point[i]));
    joint.high = std::max(joint.high, joint.along.dot(c.point[i]));
    joint.area += c.area[i];
  }
  std::vector<double> widths;
  for (const Extent& joint : extents)
    widths.push_back(joint.high > joint.low ? joint.area / (joint.high - joint.low) : 0.0);
  return widths;
}

}  // namespace

void spread_across_plane(ContactTable* contacts) {
  ContactTable& c = *contacts;
  const std::vector<double> widths = widths_of(c);
  fields(RowsTwice{}, c);
  RowsTwice{}("", "", "", c.point);
  strength_fields(RowsTwice{}, c);  // empty if all joints are dry
  for (int i = 0; i < c.size(); ++i) {
    c.point[i].y() += (i % 2 == 0 ? -0.5 : 0.5) * widths[c.joint[i]];
    c.force[i] *= 0.5;
    c.normal_force[i] *= 0.5;
    c.area[i] *= 0.5;
    if (!c.friction_limit.empty()) c.friction_limit[i] *= 0.5;
  }
}

}  // namespace cupola
