#pragma once

#include <string>
#include <vector>

#include "assembly/model/applied_loads.hpp"

namespace cupola {

/// True of a fill without a time of its own, which varies with the dead load.
bool is_dead_load(const FaceLoad& load);

/// Adds a traction, a pressure and a fill on faces. `key`: of the load, for messages; `time`: see PointForce.
void add_face_load(const FaceLoad& load, const Assembly& assembly, const std::string& key, const Loads& loads,
                   int time, std::vector<PointForce>* forces);

}  // namespace cupola
