#include "assembly/model/accuracy.hpp"

#include <cmath>

#include <fmt/format.h>

namespace cupola {

std::string to_sentence(const Accuracy& a) {
  std::string text =
      std::isnan(a.reached)
          ? fmt::format("Error of the {}: unknown, {:.2e} requested", a.quantity, a.asked)
          : fmt::format("Error of the {}: {:.2e} reached, {:.2e} requested", a.quantity, a.reached, a.asked);
  if (a.worst_over_run > a.reached) text += fmt::format(", {:.2e} at worst over the run", a.worst_over_run);
  return text + fmt::format(" ({}).", a.norm);
}

std::string to_sentence(const ForceCertificate& certificate) {
  if (!certificate.value) return fmt::format("No error bound is certified: {}.", certificate.bounds);
  return fmt::format("Certified to be at most {:.1e}: {}.", *certificate.value, certificate.bounds);
}

std::string to_sentence(const ForcesUnique& unique) {
  return fmt::format("The forces {} unique: {}.", unique.value ? "are" : "may not be", unique.reason);
}

}  // namespace cupola
