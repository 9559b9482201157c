#pragma once

#include <string>
#include <vector>

#include "assembly/case/analysis.hpp"
#include "assembly/case/geometry.hpp"
#include "assembly/case/sweep.hpp"
#include "assembly/model/joint_laws.hpp"
#include "assembly/model/loads.hpp"
#include "assembly/model/section_planes.hpp"

namespace cupola {

struct Material {
  double unit_weight = 18000.0;  ///< N/m3, > 0
  /// Mass density, kg/m3: the unit weight over standard gravity 9.81 m/s2.
  double density() const { return unit_weight / 9.81; }
};

/// How contacts are found.
struct ContactDetection {
  enum class Method { face_clipping, perturbed_gjk, file };
  Method method = Method::face_clipping;
  /// m, >= 0: faces up to this far apart make contacts; for perturbed_gjk also the radius of the spheres that
  /// the shrunk shapes are swept with. 0: 1 % of the smallest free block (cube root of its volume).
  double margin = 0.0;

  /// Of perturbed_gjk alone (paper section 2.3).
  struct Perturbation {
    int perturbations = 16;  ///< GJK queries per pair of parts, >= 1
    double angle = 0.01;     ///< rad, largest rotation, in (0, 0.1]
    int seed = 1;            ///< of the rotations, >= 0
    int keep = 4;            ///< points kept per pair of parts, >= 1
    bool operator==(const Perturbation&) const = default;
  } perturbation;

  std::string file;  ///< contact points from elsewhere, for method `file`
};
constexpr auto enum_names(ContactDetection::Method) {
  return std::array{"face_clipping", "perturbed_gjk", "file"};
}

struct Output {
  double frames_every = 0.1;  ///< s between frames of a dynamic analysis, > 0
};

struct Postproc {
  std::vector<Meridian> meridians;
  std::vector<double> sections;  ///< m, heights of horizontal sections
  std::vector<CutPlane> planes;
};

/// Everything a case file says, in SI units, defaults filled in.
struct Case {
  std::string title;
  Geometry geometry;
  Material material;
  Joints joints;
  ContactDetection contact;
  Loads loads;
  Ties ties;
  Supports supports;
  Analysis analysis;
  Output output;
  Postproc postproc;
  std::vector<SweptKey> sweep;  ///< what a study of this case varies; its own run does not

  std::string file;  ///< path as given on the command line
  std::string hash;  ///< of everything but title, postproc and sweep, which change no number of a run
  std::string geometry_hash;   ///< of the sections the generator reads: geometry, material
  std::string effective_yaml;  ///< every key with the value in force
};

}  // namespace cupola
