#include "assembly/case/declare.hpp"

namespace cupola {

void declare_contact(Section& s, ContactDetection& contact) {
  s.choice("method", contact.method, {{"face_clipping", ContactDetection::Method::face_clipping}},
           "overlap polygons of opposed faces", {.later = {"perturbed_gjk"}});
  s.later({"margin", "perturbations", "angle", "seed", "keep"});
}

}  // namespace cupola
