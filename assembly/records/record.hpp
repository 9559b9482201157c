#pragma once

#include <concepts>
#include <type_traits>

namespace cupola {

// A record is described once, by a function that shows each of its members to a visitor:
//
//     template <class Visitor>
//     void fields(Visitor&& visit, Is<RunStep> auto& step) {
//       visit("step", "", "number of the step, from 1", step.step);
//       visit("time_s", "s", "time at its end", step.time);
//     }
//
// Key, unit and meaning are those of the files. What is done with a record follows from it: JSON, arrays of mesh files, bytes of
// checkpoints, the tables of FORMAT.md.

/// T or const T: one description serves writing and reading.
template <class R, class T>
concept Is = std::same_as<std::remove_const_t<R>, T>;

/// A column that only some tables have; empty where it is left out.
template <class Column>
struct Optional {
  Column& column;
};
template <class Column>
Optional(Column&) -> Optional<Column>;

/// A visitor that does nothing.
struct NoVisitor {
  void operator()(const char*, const char*, const char*, auto&&) const {}
};

/// A type with such a description.
template <class R>
concept Record = requires(R& record) {
  fields(NoVisitor{}, record);
};

}  // namespace cupola
