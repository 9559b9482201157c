// Friction from 0 to 10 under both laws.

#include <cmath>

#include <fmt/format.h>

#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

constexpr FrictionLaw kBothLaws[] = {FrictionLaw::associated, FrictionLaw::coulomb};
constexpr double kPlate = 0.05;  // m, thickness of a plate of 1 x 1 m

/// The resultant force on the plate, and the normal forces of its lower and upper edge: by moments about the
/// middle of its base, W cos a (1/2 -+ thickness/2 tan a).
TrueError plate_on_incline(const Scene& scene, const Summary& summary, const Frame& frame) {
  const Vec3 weight = scene.assembly.blocks[1].mass * scene.input.loads.gravity;
  std::vector<KnownForce> known;
  for (const double side : {-1.0, 1.0}) {
    const double share = 0.5 - side * 0.5 * kPlate * weight.x() / weight.z();
    known.push_back(between(frame, 0, 1, Vec3(0, 0, -share * weight.z()),
                            [side](const Vec3& point) { return side * point.x() > 0; }));
    known.back().along = Vec3::UnitZ();
  }
  TrueError error = compare(scene, summary, frame, known);
  const TrueError total = carries_weight_above(scene, summary, frame);
  error.largest = std::max(error.largest, total.largest);
  error.wrench = total.wrench;
  error.refuted = total.refuted;
  return error;
}

void add_inclines(Rows* rows) {
  for (const auto law : kBothLaws)
    for (const auto& [mu, distance] : {std::pair(1e-3, 1e-3), {0.4, 1e-4}, {10.0, 1e-3}})
      for (const double side : {-1.0, 1.0}) {
        const double slope = mu * (1.0 + side * distance);
        rows->push_back({"friction",
                         fmt::format("plate on an incline of mu {} {:g} %, mu {:g}, {}", side < 0 ? '-' : '+',
                                     100 * distance, mu, name_of(law)),
                         side < 0 ? "stays: tan a < mu; forces of its edges" : "slides: tan a > mu",
                         {side < 0 ? Ending::stable : Ending::moving},
                         [=, mu = mu] {
                           Scene scene{statics(mu, 1e-9), testing::box_on_floor({1, 1, kPlate})};
                           scene.input.loads.gravity = testing::tilted_gravity(slope);
                           scene.input.analysis.friction_law = law;
                           return scene;
                         },
                         plate_on_incline});
      }
}

/// Least friction of the semicircular arch of 27 voussoirs with t/R = 0.15. In a symmetric state the thrust
/// and its height at the crown are the only unknowns; the conditions of all joints are linear in them, and
/// the limit is where their polygon vanishes. The associated law has this limit; Coulomb's law cannot stand
/// below it.
constexpr double kLeastFriction = 0.351136919;

void add_sliding_arches(Rows* rows) {
  const auto arch = [rows](double mu, FrictionLaw law, const char* name, const char* expected,
                           Ending ending) {
    rows->push_back({"friction",
                     fmt::format("arch of 27, t/R 0.15, {}, {}", name, name_of(law)),
                     expected,
                     {ending},
                     [=] {
                       Scene scene{statics(mu, 1e-9), testing::make_arch({})};
                       scene.input.analysis.friction_law = law;
                       return scene;
                     }});
    if (ending == Ending::stable) rows->back().truth = equals_exact_statics;
  };
  for (const auto law : kBothLaws) {
    arch(0.0, law, "mu 0", "slides: least mu 0.351137", Ending::moving);
    arch(0.999 * kLeastFriction, law, "0.1 % less friction than needed", "slides: least mu 0.351137",
         Ending::moving);
    arch(10.0, law, "mu 10", "forces in extended precision; no joint slides", Ending::stable);
  }
  arch(1.001 * kLeastFriction, FrictionLaw::associated, "0.1 % more friction than needed",
       "stands; forces in extended precision", Ending::stable);
}

void add_smooth_wall(Rows* rows) {
  for (const auto law : kBothLaws)
    rows->push_back({"friction",
                     fmt::format("wall of 36 blocks without friction, {}", name_of(law)),
                     "weight above each course",
                     {Ending::stable},
                     [law] {
                       Scene scene{statics(0.0, 1e-9), testing::running_bond_wall({1.0, 0.5, 0.5}, 4, 8)};
                       scene.input.analysis.friction_law = law;
                       return scene;
                     },
                     carries_weight_above});
}

void add_wedges(Rows* rows) {
  rows->push_back({"friction",
                   "wedge, walls leaning by 30 degrees, rigid joints",
                   "reaction equals weight; thrust not unique",
                   {Ending::stable},
                   [] {
                     return Scene{statics(0.4, 0.0), testing::wedge_between_walls(30.0)};
                   },
                   carries_weight_above,
                   [](const Summary& summary, const Frame&) {
                     return summary.forces_unique.value ? "the forces are called unique" : "";
                   }});
  for (const auto law : kBothLaws) {
    const bool jams = law == FrictionLaw::associated;
    rows->push_back({"friction",
                     fmt::format("block between upright walls, mu 0.8, {}", name_of(law)),
                     jams ? "jams: the law dilates" : "falls: nothing presses it to the walls",
                     {jams ? Ending::stable : Ending::moving},
                     [law] {
                       Scene scene{statics(0.8, 1e-9), testing::wedge_between_walls(0.0)};
                       scene.input.analysis.friction_law = law;
                       return scene;
                     },
                     carries_weight_above});
  }
}

}  // namespace

void add_friction_rows(Rows* rows) {
  add_inclines(rows);
  add_sliding_arches(rows);
  add_smooth_wall(rows);
  add_wedges(rows);
}

}  // namespace cupola
