#include "assembly/files/content_hash.hpp"

#include "assembly/files/hash.hpp"

namespace cupola {

std::string content_hash(const Assembly& assembly) {
  Hash hash;
  hash.add(std::span(assembly.vertices));
  hash.add(std::span(assembly.face_vertex_start));
  hash.add(std::span(assembly.face_vertices));
  hash.add(std::span(assembly.face_kinds));
  for (const Part& part : assembly.parts) hash.add(part.block).add(part.ring).add(part.slice);
  for (const Block& block : assembly.blocks)
    hash.add(block.kind).add(block.fixed).add(block.ring).add(block.num_rings).add(block.density);
  for (const Block& block : assembly.blocks)
    if (!block.name.empty()) hash.add(std::span<const char>(block.name));
  for (const std::string& member : assembly.members) hash.add(std::span<const char>(member));
  if (!assembly.members.empty()) {
    for (const Part& part : assembly.parts) hash.add(part.wythe);
    for (const Block& block : assembly.blocks) hash.add(block.member);
    hash.add(std::span(assembly.vertex_layers));
    hash.add(std::span(assembly.vertex_depths));
  }
  for (const BuiltTie& tie : assembly.ties) {
    hash.add(tie.block_a).add(tie.block_b).add(tie.stiffness).add(tie.length).add(tie.pushes);
    hash.add(tie.yield_force).add(tie.chain);
    hash.add(std::span(tie.point_a.data(), 3)).add(std::span(tie.point_b.data(), 3));
  }
  return hash.hex();
}

}  // namespace cupola
