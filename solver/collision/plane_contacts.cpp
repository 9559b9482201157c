#include "solver/collision/plane_contacts.hpp"

#include <cmath>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

bool mirror_images(const Contact& p, const ContactAnchor& a, const Contact& q, const ContactAnchor& b,
                   double tolerance) {
  const Vec3 apart = a.r_a - b.r_a;
  return p.patch == q.patch && std::hypot(apart.x(), apart.z()) <= tolerance;
}

}  // namespace

void merge_across_plane(double tolerance, AnchoredContacts* contacts) {
  std::vector<Contact>& all = contacts->set.points;
  std::vector<ContactAnchor>& anchors = contacts->anchors;
  CUPOLA_ASSERT(anchors.size() == all.size());
  size_t kept = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    size_t partner = kept;  // a patch has few points: search backwards through those kept
    while (partner > 0 && all[partner - 1].patch == all[i].patch &&
           !mirror_images(all[partner - 1], anchors[partner - 1], all[i], anchors[i], tolerance))
      --partner;
    if (partner > 0 && all[partner - 1].patch == all[i].patch) {
      Contact& first = all[partner - 1];
      ContactAnchor& anchor = anchors[partner - 1];
      // Mean of all merged points: divided patches have more than two on a line across the plane.
      const double before = first.multiplicity, after = before + all[i].multiplicity;
      anchor.r_a.y() = (before * anchor.r_a.y() + all[i].multiplicity * anchors[i].r_a.y()) / after;
      anchor.r_b.y() = (before * anchor.r_b.y() + all[i].multiplicity * anchors[i].r_b.y()) / after;
      first.area += all[i].area;
      first.multiplicity += all[i].multiplicity;
      continue;
    }
    all[kept] = all[i];
    anchors[kept++] = anchors[i];
  }
  all.resize(kept);
  anchors.resize(kept);
}

}  // namespace cupola
