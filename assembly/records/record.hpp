#pragma once

#include <concepts>
#include <type_traits>

namespace cupola {

// A record is described once, by a function that shows each of its members to a visitor, with the key, the
// unit and the meaning that files and docs give it:
//
//     template <class Visitor>
//     void fields(Visitor&& visit, Is<RunStep> auto& step) {
//       visit("step", "", "its number, from 1", step.step);
//       visit("time_s", "s", "at its end", step.time);
//     }
//
// Files are made of it: keys of JSON, arrays of meshes, bytes of checkpoints, hashes, the tables of
// FORMAT.md.

/// T or const T: one description serves writing and reading.
template <class R, class T>
concept Is = std::same_as<std::remove_const_t<R>, T>;

struct NoVisitor {
  void operator()(const char*, const char*, const char*, auto&&) const {}
};

/// A type with such a description.
template <class R>
concept Record = requires(R& record) {
  fields(NoVisitor{}, record);
};

}  // namespace cupola
