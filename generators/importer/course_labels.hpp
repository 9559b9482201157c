#pragma once

#include "generators/importer/course_finder.hpp"

namespace cupola {

/// Labels blocks, parts and faces as those of a generated model with these courses and this sheet.
void label_courses(const Courses& courses, const CourseFinder& finder, const JointGraph& graph,
                   const Sheet& sheet, Assembly* assembly);

}  // namespace cupola
