#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/case/analysis.hpp"
#include "assembly/case/ensemble.hpp"
#include "assembly/case/geometry.hpp"
#include "assembly/case/sweep.hpp"
#include "assembly/model/joint_laws.hpp"
#include "assembly/model/loads.hpp"
#include "assembly/model/section_planes.hpp"

namespace cupola {

struct CaseNode;

struct Material {
  double unit_weight = 18000.0;  ///< N/m3, > 0
  /// Mass density, kg/m3: the unit weight over standard gravity 9.81 m/s2.
  double density() const { return unit_weight / 9.81; }
};

/// Contact detection.
struct ContactDetection {
  enum class Method { face_clipping, perturbed_gjk, file };
  Method method = Method::face_clipping;
  /// m, >= 0: faces up to this far apart make contacts; for perturbed_gjk also the radius of the spheres with
  /// which the shrunk shapes are swept. 0: 1 % of the size (cube root of the volume) of the smallest free
  /// block.
  double margin = 0.0;
  enum class InitialGaps { keep, ignore };
  InitialGaps initial_gaps = InitialGaps::keep;  ///< ignore: joints are closed and free of stress as drawn
  int subdivide =
      1;  ///< >= 1: the contact points of compliance per area are those of subdivide^2 pieces of a joint

  /// Options of perturbed_gjk (paper, section 2.3).
  struct Perturbation {
    int perturbations = 16;  ///< GJK queries per pair of parts, >= 1
    double angle = 0.01;     ///< rad, largest rotation, in (0, 0.1]
    int seed = 1;            ///< seed of the random rotations, >= 0
    int keep = 4;            ///< contact points kept per pair of parts, >= 1
    bool operator==(const Perturbation&) const = default;
  } perturbation;

  std::string file;  ///< file of contact points, for method `file`
};
constexpr auto enum_names(ContactDetection::InitialGaps) {
  return std::array{"keep", "ignore"};
}
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
  std::string observed;  ///< file of meridional cracks seen on the building; empty: none
};

/// The content of a case file in SI units, with defaults filled in.
struct Case {
  std::string title;  ///< with the changes by `--set`
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
  std::vector<SweptKey> sweep;       ///< keys varied in a study of this case; without effect on its own run
  SampleFile sample_file;            ///< in place of `sweep`
  std::optional<Ensemble> ensemble;  ///< random members of a study of this case

  std::string file;                      ///< path as given on the command line
  std::shared_ptr<const CaseNode> keys;  ///< as given, with their places in the files
  std::vector<std::string> left_out;     ///< inherited keys that the new `type` of their map does not have
  std::vector<std::string> inputs;       ///< files read: the case, those it extends, and those it names
  std::string
      hash;  ///< of all sections except title, postproc, sweep and ensemble, which do not affect a run
  std::string geometry_hash;  ///< of the sections that the generator reads: geometry, material, imperfections
  std::string effective_yaml;         ///< every key with its value in force
  std::vector<std::string> warnings;  ///< implausible values (assembly/case/plausibility.hpp)

  bool ties_yield() const {
    const auto yields = [](const auto& tie) { return tie.yield_force.has_value(); };
    return std::ranges::any_of(ties.pairs, yields) || std::ranges::any_of(geometry.chains, yields);
  }
};

}  // namespace cupola
