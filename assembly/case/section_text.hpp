#pragma once

#include <string>
#include <vector>

#include "assembly/case/case_node.hpp"

namespace cupola {

/// The names with commas between them.
inline std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

inline CaseNode scalar_node(const std::string& text, bool quoted = false) {
  CaseNode node;
  node.kind = CaseNode::Kind::scalar;
  node.text = text;
  node.quoted = quoted;
  return node;
}

}  // namespace cupola
