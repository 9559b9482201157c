#pragma once

namespace cupola {

/// Combines several lambdas into one function object, for std::visit.
template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>  // required by the compiler of clang-tidy
Overloaded(Ts...)->Overloaded<Ts...>;

}  // namespace cupola
