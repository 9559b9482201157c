#include "assembly/model/choices.hpp"

namespace cupola {

std::string to_string(ContactMethod method) {
  switch (method) {
    case ContactMethod::newton:
      return "newton";
    case ContactMethod::interior_point:
      return "interior_point";
    case ContactMethod::spg:
      return "spg";
    case ContactMethod::apgd:
      return "apgd";
    case ContactMethod::nsgs:
      return "nsgs";
    case ContactMethod::admm:
      return "admm";
  }
  return "unknown";
}

std::string to_string(FrictionLaw law) {
  switch (law) {
    case FrictionLaw::associated:
      return "associated";
    case FrictionLaw::coulomb:
      return "coulomb";
  }
  return "unknown";
}

}  // namespace cupola
