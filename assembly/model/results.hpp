#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/model/accuracy.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/choices.hpp"
#include "assembly/model/status.hpp"

namespace cupola {

/// Kind of a joint: `base` touches a fixed support, `bed` lies between rings, `head` within a ring, `wythe`
/// between layers of the thickness.
enum class JointKind : std::uint8_t { bed, head, base, other, wythe };
constexpr auto enum_names(JointKind) {
  return std::array{"bed", "head", "base", "other", "wythe"};
}

/// All contact points between one pair of blocks on one face patch. block_a < block_b; the normal points
/// from a to b.
struct Joint {
  int block_a = 0;
  int block_b = 0;
  JointKind kind = JointKind::other;
  int ring = 0;  ///< course of the upper block
};

/// Forces up to this share of the largest joint force of a frame are negligible. Solved forces are at least a
/// hundred times more accurate (analysis.tolerance is 1e-8 of a block's weight), so what is larger is no
/// error.
inline constexpr double kNegligibleShare = 1e-6;

/// Contacts at one instant, one row per contact point, in a fixed order (contacts_*.vtp).
struct ContactTable {
  std::vector<int> joint;             ///< index into the joints
  std::vector<int> block_a, block_b;  ///< a < b
  std::vector<JointKind> kind;
  std::vector<int> ring;
  std::vector<Vec3> point;           ///< m, world
  std::vector<Vec3> normal;          ///< unit, from a to b
  std::vector<double> gap;           ///< m, positive when apart
  std::vector<Vec3> force;           ///< N, world axes, acting on b
  std::vector<double> normal_force;  ///< N, >= 0 in dry joints
  std::vector<double> friction_use;  ///< |tangential force| / (cohesion + mu normal force); 0 without force
  std::vector<double> area;          ///< m2, tributary area of the point; 0 on an edge or at a corner
  std::vector<double> slip;          ///< m, accumulated sliding
  /// Error of the force in the contact law, over the force of the joint; NaN where both blocks sleep.
  std::vector<double> law_violation;
  /// N, cohesion left x area + mu x normal force; empty if all joints are dry.
  std::vector<double> friction_limit;
  /// Pressure over the compressive strength, or pull over the tensile one; NaN if dry, empty if all are dry.
  std::vector<double> strength_use;
  /// Share of tension and cohesion that is lost, in [0, 1]; NaN without either, empty if all joints are dry.
  std::vector<double> damage;
  /// m, >= 0: distance of the faces beyond the elastic elongation of the joint; empty if all joints are dry.
  std::vector<double> crack_opening;

  int size() const { return static_cast<int>(joint.size()); }
  void reserve(std::size_t contacts) {
    for (std::vector<int>* v : {&joint, &block_a, &block_b, &ring}) v->reserve(contacts);
    for (std::vector<Vec3>* v : {&point, &normal, &force}) v->reserve(contacts);
    for (std::vector<double>* v : {&gap, &normal_force, &friction_use, &area, &slip, &law_violation})
      v->reserve(contacts);
    kind.reserve(contacts);
  }
};

/// Blocks at one instant, one row per block, at its centroid (blocks_*.vtp).
struct BlockTable {
  std::vector<Vec3> position;                    ///< m
  std::vector<Eigen::Vector4d> quaternion_wxyz;  ///< rotation from the orientation in the assembly
  std::vector<Vec3> velocity;                    ///< m/s
  std::vector<Vec3> angular_velocity;            ///< rad/s, world
  std::vector<Vec3> displacement;                ///< m, of the centroid
  /// Where the block stood when the contacts of the frame were found, in whose geometry the forces balance: on
  /// a path and in a motion, some way before the end of the step. Empty: as built.
  std::vector<Vec3> contact_position;                    ///< m
  std::vector<Eigen::Vector4d> contact_quaternion_wxyz;  ///< rotation

  int size() const { return static_cast<int>(position.size()); }
};

/// Ties at one instant, one row per tie (ties_*.vtp): those of the case, then those of the assembly. Empty
/// without ties.
struct TieTable {
  std::vector<int> chain;              ///< index into Assembly::chains; -1: none
  std::vector<int> block_a, block_b;   ///< a < b
  std::vector<Vec3> point_a, point_b;  ///< m, ends
  std::vector<double> force;           ///< N, >= 0, tension; of a strut thrust
  std::vector<double> yield_force;     ///< N; infinity: elastic without limit
  std::vector<double> yielded;         ///< m, >= 0, plastic elongation
  std::vector<std::uint8_t> strut;     ///< 1: resists shortening

  int size() const { return static_cast<int>(force.size()); }
};

/// What a frame shows. `mechanism` and `failed_stage` hold directions of motion without an amplitude:
/// displacements are zero, the fastest block has the speed 1 m/s.
enum class FrameRole : std::uint8_t {
  equilibrium,   ///< forces that balance the loads; what follows in a run belongs to it
  step,          ///< an instant of a motion
  stage,         ///< a stage of a construction that stands, or whose solve did not converge
  failed_stage,  ///< a stage that does not stand
  path,          ///< an equilibrium on a path
  mechanism,     ///< how a structure without equilibrium begins to move
  range_end,     ///< admissible forces at an end of a range
  self_stress,   ///< forces without loads that show why an end of a range is unbounded
  unconverged    ///< what an unfinished solve had reached
};
constexpr auto enum_names(FrameRole) {
  return std::array{"equilibrium", "step",      "stage",       "failed_stage", "path",
                    "mechanism",   "range_end", "self_stress", "unconverged"};
}
constexpr bool is_mechanism(FrameRole role) {
  return role == FrameRole::mechanism || role == FrameRole::failed_stage;
}
constexpr bool is_stage(FrameRole role) {
  return role == FrameRole::stage || role == FrameRole::failed_stage;
}

/// Contacts, blocks and ties at one instant. Joint numbers are valid only within the frame.
struct Frame {
  double time = 0.0;  ///< s; of a stage the number of the last course laid, less the share that is missing
  FrameRole role = FrameRole::equilibrium;
  std::string owner;  ///< stage, parameter of a limit or end of a range to which it belongs; empty: the run
  std::string label;  ///< in words, for legends
  ContactTable contacts;
  BlockTable blocks;
  TieTable ties;
};

/// Sets the role and the owner of a frame, and the label that follows from them and its time.
void set_role(FrameRole role, const std::string& owner, Frame* frame);

/// The joints of a frame, indexed by ContactTable::joint.
std::vector<Joint> joints_of(const ContactTable& contacts);

/// What an interrupted run had reached: interrupted.json.
struct Interruption {
  std::string program_version, case_hash, assembly_hash;
  bool resumable = false;  ///< there is a checkpoint
  int frames = 0;          ///< written so far
  std::string last_line;   ///< of the log: the last step, trial or iteration
  double wall_time_seconds = 0.0;
};

/// The parameter value at which a structure ceases to stand, and its final bracket.
struct CriticalValue {
  std::string parameter;
  double value = 0.0;   ///< middle of the bracket
  double stable = 0.0;  ///< end of the bracket at which the structure stands
  double moving = 0.0;  ///< end at which it moves
};

/// How the search for one end of a range ended. `unbounded`: a self-stress without load (a jammed wedge)
/// changes the quantity without limit. `undefined`: of a ratio whose denominator is zero in every state.
enum class RangeOutcome { bounded, unbounded, undefined, unconverged };
constexpr auto enum_names(RangeOutcome) {
  return std::array{"bounded", "unbounded", "undefined", "unconverged"};
}

/// One end of the range of a quantity over all admissible states.
struct RangeEnd {
  RangeOutcome outcome = RangeOutcome::unconverged;
  std::optional<double> value;  ///< attained by the state found; absent if unbounded
  /// No admissible state lies beyond, among those with forces of up to 1000 times the largest of the state
  /// found.
  std::optional<double> bound;
  std::optional<int> frame;  ///< that shows the state, or the self-stress alone if unbounded
};

/// Smallest and largest value of a quantity over all forces that balance the loads within the joint laws.
struct ForceRange {
  std::string quantity;  ///< "thrust", "normal force of joint 12-13"
  std::string unit;      ///< "N", "m", "" for ratios
  RangeEnd min, max;
  std::optional<double>
      chosen;  ///< in the state that the compliances choose (static analysis); absent without one
  /// Blocks of the joint whose normal force it is, the smaller first.
  std::optional<std::pair<int, int>> joint = std::nullopt;
};

/// The smallest horizontal acceleration, over equally spaced directions, that makes a structure move under
/// the associated law. Under Coulomb's law a smaller one may.
struct Robustness {
  int directions = 0;           ///< those that were decided
  double acceleration_g = 0.0;  ///< an admissible state exists at this value
  double moving_g = 0.0;        ///< a mechanism proves motion at this value
  double azimuth_deg = 0.0;     ///< direction of the acceleration of the blocks, from x towards y
};

/// What a search for a value found, in words: of a limit analysis, `analysis.robustness` or
/// `analysis.staged.least`. All but the first two are clauses of the message.
struct Sought {
  std::string quantity = {};  ///< "critical friction"
  /// Where there is no value: "no limit above 0.15", "none", "not found", "unknown", "0". Empty: there is one.
  std::string found = {};
  std::string reason = {};  ///< what shows that
  std::string advice = {};  ///< what to try; may be empty
  std::string also = {};    ///< what else is known, as a second limit; may be empty
};

/// Appends a clause after "; ".
void add_clause(const std::string& clause, std::string* text);

/// "the structure stands at both ends of the bracket, 0 and 0.1; widen the bracket": reason, advice and what
/// else is known.
std::string clauses(const Sought& sought);

/// "joint extent": the name of a key.
std::string in_words(std::string name);

/// Unit of the parameter of a limit analysis: "degrees", "g", "Pa", "times the weight", "factor", or "" for
/// friction.
std::string limit_unit(const std::string& parameter);

/// "critical friction: 0.08465", "critical tilt: 6.9873 degrees".
std::string critical_text(const CriticalValue& critical);

/// A value of the parameter with its name and unit: "a tilt of 6.9873 degrees".
std::string phrase(const std::string& parameter, double value);

/// A part of the structure that no contact connects with the rest.
struct PartVerdict {
  int first_block = 0, blocks = 0;  ///< its block of the lowest number, the number of its free blocks
  Status status = Status::unconverged;
};

/// results/summary.json: what was solved, how it ended and how accurate it is. Defined in assembly/FORMAT.md.
struct Summary {
  Status status = Status::unconverged;
  std::string message;  ///< the reason for the status, with the numbers
  AnalysisType analysis = AnalysisType::static_;
  ContactMethod method = ContactMethod::newton;
  FrictionLaw friction_law = FrictionLaw::associated;
  std::optional<double> dilatancy;  ///< if the case gives it
  TangentialSpring tangential = TangentialSpring::memory;
  std::string program_version, case_hash, geometry_hash, assembly_hash;
  int blocks = 0, free_blocks = 0, joints = 0, contacts = 0, unknowns = 0;
  double weight_N = 0.0;
  Vec3 applied_load_N = Vec3::Zero();      ///< all loads on the free blocks, weight included
  Vec3 support_reaction_N = Vec3::Zero();  ///< force of the fixed blocks on the free ones
  double time_step_s = 0.0;
  Accuracy accuracy;  ///< decides whether the accuracy asked for was reached
  /// Of a dynamic or staged run: the worst over its steps. Absent if no state was found that they describe.
  std::optional<double> momentum_residual, contact_law_residual, friction_cone_violation;
  std::optional<LawViolation> largest_law_violation;
  std::optional<WorstSteps> worst_steps;  ///< motions
  std::optional<double>
      equilibrium_residual;             ///< of the last frame, or of the stable end of a limit analysis
  std::optional<double> inertia_share;  ///< 1 - reaction / load along gravity
  /// Motions: largest error of the account of energy, over what was dissipated or the largest kinetic energy.
  std::optional<double> energy_error;
  ForceCertificate certified_force_error;
  ForcesUnique forces_unique;
  double max_penetration_m = 0.0;
  std::optional<double> max_displacement_m;  ///< absent without an equilibrium and in limit analyses
  /// Dynamic runs only: when that was, displacement and speed at the end, and whether it is at rest there.
  std::optional<double> max_displacement_time_s, final_displacement_m, max_speed_m_per_s;
  std::optional<bool> rest_at_end;
  int slipping_contacts = 0;
  int steps = 0, iterations = 0;
  double solve_time_seconds = 0.0;  ///< contact solves only, without input and output
  double wall_time_seconds = 0.0;
  double cpu_time_seconds = 0.0;  ///< of the whole process; unaffected by the load of the machine
  std::int64_t peak_memory_bytes = 0;
  int threads = 1;
  std::optional<CriticalValue> critical;  ///< limit analysis only
  /// Of a path that ends before the loads of its case are reached: s, the latest time at which it bore them.
  std::optional<double> bears_loads_until_s;
  /// Limit analysis without a critical value: whether the structure stands, or moves, at both ends.
  std::optional<bool> stands_at_both_ends;
  std::optional<Sought> sought;          ///< analyses that search for a value
  std::vector<ForceRange> ranges;        ///< range analysis only
  std::optional<Robustness> robustness;  ///< static analysis, on request
  std::vector<PartVerdict> parts;  ///< static analysis without an equilibrium of the whole: the largest first
  std::vector<std::string> warnings;              ///< about the case and the blocks, one sentence each
  std::map<std::string, std::string> text_files;  ///< text files of the results folder: name to hash
};

}  // namespace cupola
