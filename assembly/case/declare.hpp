#pragma once

#include "assembly/case/case.hpp"
#include "assembly/case/section.hpp"

namespace cupola {

inline constexpr double kThinnest = 0.002, kThickest = 20.0;  // m, plausible thickness
inline constexpr double kLightest = 3e3,
                        kHeaviest = 8e4;   // N/m3, plausible weights: aerated concrete to steel
inline constexpr int kMostRings = 100000;  // a typing error gives a message rather than exhausts memory

// The keys of each section of the case file, one line per key; see Section. A new key requires a member of
// the struct, which holds its default, and one line in the declaration.

void declare_case(Section& s, Case& the_case);
void declare_swept_key(Section& s, SweptKey& swept);
void declare_ensemble(Section& s, Ensemble& ensemble);
void declare_sample_file(Section& s, SampleFile& samples);
void declare_geometry(Section& s, Geometry& geometry);
void declare_chain(Section& s, Chain& chain);
/// The rules between a chain and the member in which it lies.
void check_chain(const Section& s, const Geometry& geometry, const Chain& chain);
void declare_import(Section& s, ImportedBlocks& import);
/// Warns of a length of the structure (m) in another unit.
void expect_length(const Section& s, const char* key, double value, double low = 0.05, double high = 250.0);
/// The key `thickness` of a surface, which wythes replace. Warns above `most`, m.
void declare_shell_thickness(Section& s, double& thickness, double most, const std::string& meaning);
void declare_vault(Section& s, VaultSurface& vault);
void declare_bond(Section& s, Bond& bond);
/// `bond`, or `wythes` and `bonders`, with the rules between them.
void declare_masonry(Section& s, Masonry& masonry);
void declare_surface(Section& s, Surface& surface);
/// One of `geometry.members`.
void declare_member(Section& s, Member& member);
/// What all members have in common, that which the geometry is itself included.
void declare_shape(Section& s, Member& member);
void declare_affine_of(Section& s, Member& member);
void check_closed_bonds(const Section& s, const Member& member);
/// The rules between members.
void check_members(const Section& s, const Geometry& geometry);
void declare_imperfections(Section& s, Imperfections& imperfections);
void declare_material(Section& s, Material& material);
void declare_joints(Section& s, Joints& joints);
/// Keys that select joints: `from`, `to`, `kind`.
void declare_joint_group(Section& s, RingJoints& joints);
void declare_contact(Section& s, ContactDetection& contact);
void declare_loads(Section& s, Loads& loads);
void declare_ties(Section& s, Ties& ties);
void declare_supports(Section& s, Supports& supports);
void declare_analysis(Section& s, Analysis& analysis);
void declare_range(Section& s, RangeSearch& range);
void declare_staged(Section& s, StagedConstruction& staged);
void declare_output(Section& s, Output& output);
void declare_postproc(Section& s, Postproc& postproc);

/// The keys that select blocks; `blocks` completes the meaning of the key of that name.
void declare_region(Section& s, BlockRegion& region, const std::string& blocks);

/// Optional map that describes a variation in time. Without it the factor is 1.
void declare_time(Section& s, const std::string& key, TimeFunction& time, const std::string& meaning);

}  // namespace cupola
