#pragma once

#include "solver/collision/contact_detector.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

// The fields of a contact memory that a checkpoint stores. Add any new field that persists from step to step.

template <class Archive>
void visit(Archive& archive, JointDamage& x) {
  archive(x.damage, x.opening, x.crushing, x.step_damage, x.bears);
}

template <class Archive>
void visit(Archive& archive, ContactMemory& x) {
  archive(x.impulse, x.tangent_A, x.point_A, x.elastic_gap, x.elastic_slip_A, x.plastic_slip, x.force_A,
          x.filtered_A, x.loaded_steps, x.rest_gap, x.joint);
}

template <class Archive>
void visit(Archive& archive, TieMemory& x) {
  archive(x.impulse, x.yielded);
}

// The fields of a state, of its contacts and of their memories that a checkpoint stores. Add any new field of
// these structs that persists from step to step.

template <class Archive>
void visit(Archive& archive, Pose& x) {
  archive(x.p_WB, x.q_WB);
}
template <class Archive>
void visit(Archive& archive, ContactId& x) {
  archive(x.part_a, x.part_b, x.face_a, x.face_b, x.corner);
}
template <class Archive>
void visit(Archive& archive, Contact& x) {
  archive(x.id, x.block_a, x.block_b, x.patch, x.point_a, x.point_b, x.normal, x.gap, x.area, x.closed_share,
          x.multiplicity);
}
template <class Archive>
void visit(Archive& archive, Patch& x) {
  archive(x.block_a, x.block_b, x.kind, x.ring, x.polygon, x.area);
}
template <class Archive>
void visit(Archive& archive, ContactAnchor& x) {
  archive(x.r_a, x.r_b, x.normal_a, x.normal_b, x.weight_a, x.rest_gap);
}
template <class Archive>
void visit(Archive& archive, AnchoredContacts& x) {
  archive(x.set.points, x.set.patches, x.anchors, x.patch_polygons);
}
template <class Archive>
void visit(Archive& archive, Reach& x) {
  archive(x.poses, x.travel);
}
template <class Archive>
void visit(Archive& archive, TrackedPair& x) {
  archive(x.a, x.b, x.X_AB, x.travel, x.stale);
}
template <class Archive>
void visit(Archive& archive, DetectionMemory& x) {
  archive(x.boxes, x.now, x.contacts, x.pairs, x.num_detections);
}
template <class Archive>
void visit(Archive& archive, ContactMemories& x) {
  archive(x.ids, x.values, x.ties, x.as_built);
}
template <class Archive>
void visit(Archive& archive, State& x) {
  archive(x.time, x.poses, x.v, x.ground);
}

}  // namespace cupola
