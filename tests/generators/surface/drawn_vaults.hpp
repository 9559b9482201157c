#pragma once

#include <utility>
#include <vector>

#include "assembly/case/case.hpp"

namespace cupola::test {

inline Profile profile_of(Profile::Kind kind, double span = 10.0, double rise = 4.0) {
  Profile p;
  p.kind = kind;
  p.span = span;
  p.rise = rise;
  return p;
}

inline Profile chain_of(std::vector<double> r, std::vector<double> z, std::vector<double> radius = {}) {
  Profile p = profile_of(Profile::Kind::chain);
  p.points.r = std::move(r);
  p.points.z = std::move(z);
  p.points.radius = std::move(radius);
  return p;
}

inline VaultSurface vault_on(Plan::Kind plan, const Profile& profile, double thickness = 0.5) {
  VaultSurface v;
  v.plan.kind = plan;
  v.profile = profile;
  v.thickness = thickness;
  if (plan != Plan::Kind::line && profile.kind != Profile::Kind::straight) v.eye = 1.0;
  if (plan == Plan::Kind::corners) {
    v.plan.x = {6, -6, -6, 6};
    v.plan.y = {5, 4, -5, -5};
  }
  return v;
}

inline Case case_of(const VaultSurface& surface, int rings = 8, int blocks = 16) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = RunningBond{rings, blocks, 2};
  return c;
}

}  // namespace cupola::test
