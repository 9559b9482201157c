// Contact tables (CSV) for the small model, as text. Promise: accepted contacts refer to two of
// its blocks and have a unit normal and a positive area.

#include <cmath>

#include "solver/collision/contact_file.hpp"
#include "tests/fuzz/reader_under_test.hpp"
#include "tests/fuzz/small_model.hpp"

namespace cupola {

bool reader_accepts(std::string_view bytes) {
  static const ScratchPath scratch("_contacts.csv");
  static const Assembly assembly = small_assembly();
  write_bytes(scratch.path, bytes);
  AnchoredContacts contacts;
  if (!accepts([&] { contacts = read_contacts(scratch.path, assembly); })) return false;
  demand(!contacts.set.points.empty(), "a table has contacts");
  for (const Contact& contact : contacts.set.points)
    demand(contact.block_a == 0 && contact.block_b == 1 && contact.area > 0.0, "contacts name blocks");
  for (const auto& anchor : contacts.anchors)
    demand(std::abs(anchor.normal_a.norm() - 1.0) < 1e-9,
           "normals have length one");  // rounding of a division
  return true;
}

}  // namespace cupola
