#include "assembly/files/content_hash.hpp"

#include "assembly/files/hash.hpp"
#include "assembly/records/assembly_record.hpp"

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
  const auto add = [&hash]<class M>(const char*, const char*, const char*, const M& member) {
    if constexpr (std::is_same_v<M, Vec3>)
      hash.add(std::span(member.data(), 3));
    else
      hash.add(member);
  };
  for (const BuiltTie& tie : assembly.ties) fields(add, tie);
  return hash.hex();
}

}  // namespace cupola
