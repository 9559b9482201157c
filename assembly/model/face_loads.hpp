#pragma once

#include <string>
#include <vector>

#include "assembly/model/applied_loads.hpp"

namespace cupola {

/// Adds a traction, a pressure and a fill on faces. `key`: of the load, for messages; `time`: see PointForce.
void add_face_load(const FaceLoad& load, const Assembly& assembly, const std::string& key,
                   const Vec3& gravity, int time, std::vector<PointForce>* forces);

}  // namespace cupola
