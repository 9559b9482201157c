#include "assembly/case/declare.hpp"

namespace cupola {

void declare_contact(Section& s, ContactDetection& contact) {
  using enum ContactDetection::Method;
  s.choice("method", contact.method,
           "overlap polygons of facing faces; the paper's GJK queries under small rotations; or contact "
           "points from a file");
  s.number("margin", contact.margin, {.unit = "m", .min = 0},
           "faces up to this far apart make contacts; perturbed_gjk also rounds edges by this radius; 0: 1 % "
           "of the smallest block's size");
  s.choice(
      "initial_gaps", contact.initial_gaps,
      "`ignore`: gaps and overlaps up to the margin are errors of the drawing; joints are closed and free "
      "of stress as drawn");
  s.integer(
      "subdivide", contact.subdivide, {.min = 1, .max = 64},
      "compliance per area: cut each joint into this number squared of pieces with contact points each; "
      "joints with compressive strength need 2 or more, doubled until the answer stays (docs/strength.md)");
  ContactDetection::Perturbation& gjk = contact.perturbation;
  s.integer("perturbations", gjk.perturbations, {.min = 1, .max = 10000},
            "perturbed_gjk: queries per pair of parts");
  s.number("angle", gjk.angle, {.unit = "rad", .above = 0, .max = 0.1},
           "perturbed_gjk: largest rotation of a query");
  s.integer("seed", gjk.seed, {.min = 0}, "perturbed_gjk: seed of the random rotations");
  s.integer("keep", gjk.keep, {.min = 1, .max = 100}, "perturbed_gjk: contact points kept per pair of parts");
  s.file("file", contact.file,
         "method file: CSV file of contact points (assembly/FORMAT.md); static analysis only");

  s.rule(contact.method == perturbed_gjk || gjk == ContactDetection::Perturbation{}, "method",
         "the keys perturbations, angle, seed and keep require method: perturbed_gjk");
  s.rule((contact.method == file) == !contact.file.empty(), "method",
         "method: file requires the key file; remove the key for any other method");
}

}  // namespace cupola
