#pragma once

#include "assembly/base/error.hpp"
#include "assembly/case/case.hpp"

namespace cupola {

/// The error with the place that the case gives the key at which the message begins, if it names no place.
InputError with_place_of_key(const InputError& error, const Case& scene);

/// Runs `body`, which checks the case against its blocks: its errors name a key, `loads.forces[2]: block 99
/// does not exist`, and get the place of that key in the case.
template <class Body>
auto with_places_of_keys(const Case& scene, const Body& body) {
  try {
    return body();
  } catch (const InputError& error) {
    throw with_place_of_key(error, scene);
  }
}

}  // namespace cupola
