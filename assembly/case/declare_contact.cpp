#include "assembly/case/declare.hpp"

namespace cupola {

void declare_contact(Section& s, ContactDetection& contact) {
  using enum ContactDetection::Method;
  s.choice("method", contact.method,
           "overlap polygons of opposed faces; the paper's GJK under small rotations; or points from a file");
  s.number("margin", contact.margin, {.unit = "m", .min = 0},
           "faces up to this far apart make contacts, and perturbed_gjk rounds edges by it; 0: 1 % of the "
           "smallest block");
  ContactDetection::Perturbation& gjk = contact.perturbation;
  s.integer("perturbations", gjk.perturbations, {.min = 1, .max = 10000}, "perturbed_gjk: queries per pair");
  s.number("angle", gjk.angle, {.unit = "rad", .above = 0, .max = 0.1}, "perturbed_gjk: largest rotation");
  s.integer("seed", gjk.seed, {.min = 0}, "perturbed_gjk: seed of the rotations");
  s.integer("keep", gjk.keep, {.min = 1, .max = 100}, "perturbed_gjk: points kept per pair of parts");
  s.file("file", contact.file, "method file: CSV of contact points (solver/README.md), static analysis only");

  s.rule(contact.method == perturbed_gjk || gjk == ContactDetection::Perturbation{}, "method",
         "perturbations, angle, seed and keep need method perturbed_gjk");
  s.rule((contact.method == file) == !contact.file.empty(), "method",
         "method file needs the key file, and no other method has it");
}

}  // namespace cupola
