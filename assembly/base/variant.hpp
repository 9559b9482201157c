#pragma once

namespace cupola {

/// One function object out of several lambdas, for std::visit.
template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>  // clang-tidy's compiler needs it said
Overloaded(Ts...)->Overloaded<Ts...>;

}  // namespace cupola
