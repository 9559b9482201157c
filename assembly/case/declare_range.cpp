#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_listed(Section& s, BaseBlocks& blocks) {
  s.blocks("blocks", blocks.blocks, "numbers or names of blocks that rest on supports");
  s.rule(!blocks.blocks.empty(), "blocks", "must list at least one block");
}

void declare_group(Section& s, const std::string& key, BaseBlocks& group) {
  s.choice_or_section(
      key, group.group, group,
      "blocks that rest on supports: of the ribs, nearest the middle of each sail, herringbone "
      "blocks, or listed",
      declare_listed);
  s.rule(group.group != BaseBlocks::Group::listed || !group.blocks.empty(), key,
         "must be ribs, mid_sails or herringbone, or list blocks: {blocks: [12, 13]}");
}

void declare_thrust(Section&, BaseThrust&) {}

void declare_reaction(Section& s, BlockReaction& reaction) {
  s.required_block("block", reaction.block, "number or name of a block on supports, or of a support");
  s.choice("component", reaction.component,
           "of the force on the supports: vertical (downwards) or outward (from the axis of the vault)");
  s.optional_vector3("direction", reaction.direction, {}, "component",
                     "instead of a component, of any length");
  s.rule(!reaction.direction || reaction.direction->norm() > 0.0, "direction", "must not be zero");
}

void declare_joint(Section& s, JointForce& joint) {
  std::vector<BlockRef> blocks;
  s.blocks("blocks", blocks, "numbers or names of the two blocks that share the joint");
  s.rule(blocks.size() == 2, "blocks", "must name the two blocks of the joint: [12, 13]");
  if (blocks.size() == 2) {
    joint.block_a = blocks[0];
    joint.block_b = blocks[1];
  }
  s.required_choice("component", joint.component,
                    "normal force; shear; resultant along `direction`; eccentricity of the pressure point",
                    "normal is the usual one");
  s.optional_vector3("direction", joint.direction, {}, "outwards",
                     "shear, resultant, eccentricity: direction, of any length");
  s.rule(!joint.direction || joint.direction->norm() > 0.0, "direction", "must not be zero");
}

void declare_hoop(Section& s, HoopForce& hoop) {
  s.required_integer("ring", hoop.ring, {.min = 0}, "course whose mean hoop force is sought");
}

void declare_share(Section& s, BaseShare& share) {
  declare_group(s, "of", share.of);
}

void declare_ratio(Section& s, BaseRatio& ratio) {
  declare_group(s, "of", ratio.of);
  declare_group(s, "over", ratio.over);
}

void declare_tie(Section& s, TieForce& tie) {
  s.required_integer("tie", tie.tie, {.min = 0},
                     "number in ties.csv: pairs, links of the chains, imported ties; a rod has two");
}

void declare_restraint_force(Section& s, RestraintForce& restraint) {
  s.required_integer("restraint", restraint.restraint, {.min = 0}, "number in supports.restraints");
}

void declare_all_joints(Section& s, AllJoints& joints) {
  s.integer("sectors", joints.sectors, {.min = 1, .max = 100000},
            "equal sectors about the axis of the vault, of whose first one the joints are evaluated");
}

void declare_quantity(Section& s, ForceQuantity& quantity) {
  s.variant<ForceQuantity>(
      "type", quantity,
      {alternative<ForceQuantity>("thrust",
                                  "outward horizontal force on the supports, each joint along the direction "
                                  "at its centroid; of an arch at one springing; of each stack of members",
                                  declare_thrust),
       alternative<ForceQuantity>("reaction", "force of a block on the supports", declare_reaction),
       alternative<ForceQuantity>("joint", "force in the joint of two blocks", declare_joint),
       alternative<ForceQuantity>("hoop_force", "mean hoop force of a course, compression positive",
                                  declare_hoop),
       alternative<ForceQuantity>("share", "share of the vertical reaction that a group of blocks carries",
                                  declare_share),
       alternative<ForceQuantity>("ratio", "mean vertical reaction of a block of one group over another's",
                                  declare_ratio),
       alternative<ForceQuantity>("tie", "force of a tie or rod, tension positive", declare_tie),
       alternative<ForceQuantity>("restraint", "force of a restraint on its block along its direction",
                                  declare_restraint_force),
       alternative<ForceQuantity>("all_joints", "normal force of every joint of a sector",
                                  declare_all_joints)},
      "quantity; a name alone stands for {type: name}");
}

}  // namespace

void declare_range(Section& s, RangeSearch& range) {
  s.list("quantities", range.quantities, "quantities whose smallest and largest values are sought",
         declare_quantity, Section::Items::maps_or_names);
  s.flag("states", range.states, "write the forces at each end of a range as a frame");
}

}  // namespace cupola
