#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/case/geometry.hpp"

namespace cupola {

struct Material {
  double unit_weight = 18000.0;  ///< N/m3, > 0
  /// Mass density, kg/m3: the unit weight over standard gravity 9.81 m/s2.
  double density() const { return unit_weight / 9.81; }
};

/// What one contact (or one square metre of joint) yields per newton.
struct Compliance {
  enum class Per { point, area };
  double normal = 1e-8;      ///< m/N per contact point, or m3/N per area, >= 0
  double tangential = 1e-8;  ///< same unit, >= 0
  Per per = Per::point;      ///< the case must say which
};

struct Joints {
  double friction = 0.4;  ///< mu, >= 0
  Compliance compliance;
};

struct FaceClipping {};

struct ContactDetection {
  enum class Method { face_clipping };
  Method method = Method::face_clipping;
};

/// Weight spread over the top faces by their area, as vertical forces at the face centroids. The lantern of
/// a dome and the load on a wall are the same thing under two names.
struct TopLoad {
  double weight_fraction = 0.0;  ///< of the weight of the free blocks, >= 0
};

struct Loads {
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};  ///< m/s2
  std::optional<TopLoad> lantern;
  std::optional<TopLoad> top_load;
};

enum class AnalysisType { static_, dynamic };
enum class ContactMethod { newton };
enum class FrictionLaw { associated };
enum class TangentialSpring { memory, literal };

struct Analysis {
  AnalysisType type = AnalysisType::static_;
  ContactMethod method = ContactMethod::newton;
  FrictionLaw friction_law = FrictionLaw::associated;
  /// Static: largest equilibrium residual accepted, inertia share included; h follows from it. Dynamic: the
  /// relative momentum residual of each step.
  double tolerance = 1e-9;
  double time_step = 0.01;      ///< h, s, dynamic only
  double duration = 4.0;        ///< s, dynamic only
  double damping = 0.0;         ///< alpha, s: contact damping proportional to stiffness, >= 0
  double recovery_speed = 0.6;  ///< eps_u, m/s: fastest recovery of unexplained penetration, > 0
  TangentialSpring tangential = TangentialSpring::memory;
  struct Thresholds {
    double speed = 1e-3;        ///< m/s: faster is `moving`
    double displacement = 0.5;  ///< m: further is `collapsed`
  } thresholds;
};

struct Output {
  double frames_every = 0.1;  ///< s between frames of a dynamic analysis, > 0
};

/// A meridian is the half-plane at an azimuth; walls have none.
struct Meridian {
  std::string name;
  double azimuth_deg = 0.0;
};

struct Postproc {
  std::vector<Meridian> meridians;
  std::vector<double> sections;  ///< m, heights of horizontal sections
};

/// Everything a case file says, in SI units, defaults filled in.
struct Case {
  std::string title;
  Geometry geometry;
  Material material;
  Joints joints;
  ContactDetection contact;
  Loads loads;
  Analysis analysis;
  Output output;
  Postproc postproc;

  std::string file;            ///< path as given on the command line
  std::string hash;            ///< of the whole effective case
  std::string geometry_hash;   ///< of the sections the generator reads: geometry, material
  std::string effective_yaml;  ///< every key with the value in force
};

}  // namespace cupola
