#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/case_node.hpp"
#include "assembly/case/schema_table.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {

/// One map of the case file while it is declared. A declaration function names every key once, with unit,
/// range and meaning; that one line reads the key, documents it in `--schema` and writes it to run.yaml:
///
///     void declare_joints(Section& s, Joints& joints) {
///       s.number("friction", joints.friction, {.min = 0}, "Coulomb friction coefficient mu");
///     }
///
/// The value that the variable holds on entry is the default. Whatever the file says and no declaration
/// names is an error.
class Section {
 public:
  /// Reads `node`; nullptr when the file leaves the section out, which `where` then locates. `case_file` is
  /// the path given on the command line.
  Section(const CaseNode* node, std::string path, FileLocation where, std::string case_file);
  /// Reads nothing and adds one row per key to `schema`.
  Section(SchemaTable* schema, std::string path);

  void text(const std::string& key, std::string& value, const std::string& meaning);
  /// A file that the case names, relative to the case file's folder and inside it (path_inside); `path` gets
  /// what a program opens. Left out, it stays empty.
  void file(const std::string& key, std::string& path, const std::string& meaning, bool or_folder = false);
  void number(const std::string& key, double& value, const NumberRule& rule, const std::string& meaning);
  /// A number that another key has settled as `value`: what the file says is checked and set aside, and
  /// run.yaml gets the value in force.
  void settled_number(const std::string& key, double value, const NumberRule& rule);
  /// They must be given: `value` on entry means nothing.
  void required_number(const std::string& key, double& value, const NumberRule& rule,
                       const std::string& meaning);
  /// Left out, it stays empty; `without` tells in `--schema` what happens then.
  void optional_number(const std::string& key, std::optional<double>& value, const NumberRule& rule,
                       const std::string& without, const std::string& meaning);
  void integer(const std::string& key, int& value, const NumberRule& rule, const std::string& meaning);
  void required_integer(const std::string& key, int& value, const NumberRule& rule,
                        const std::string& meaning);
  void flag(const std::string& key, bool& value, const std::string& meaning);
  void vector3(const std::string& key, Eigen::Vector3d& value, const NumberRule& rule,
               const std::string& meaning);
  void optional_vector3(const std::string& key, std::optional<Eigen::Vector3d>& value, const NumberRule& rule,
                        const std::string& without, const std::string& meaning);
  void numbers(const std::string& key, std::vector<double>& values, const NumberRule& rule,
               const std::string& meaning);
  void integers(const std::string& key, std::vector<int>& values, const NumberRule& rule,
                const std::string& meaning);

  void texts(const std::string& key, std::vector<std::string>& values, const std::string& meaning);

  /// One quantity under several names, of which the case gives at most one: value = factor * number.
  struct UnitName {
    std::string key;
    double factor;
    NumberRule rule;
    std::string meaning;
  };
  /// run.yaml writes it under the first name, whose factor is 1.
  void quantity(double& value, const std::vector<UnitName>& names);

  /// One of the names of an enumeration.
  template <NamedEnum E>
  void choice(const std::string& key, E& value, const std::string& meaning);
  /// One of some of the names; `value` on entry must be among them.
  template <NamedEnum E>
  void choice(const std::string& key, E& value, const std::vector<E>& admitted, const std::string& meaning);
  /// Must be given: `value` on entry means nothing.
  template <NamedEnum E>
  void required_choice(const std::string& key, E& value, const std::string& meaning);
  /// A name, or in its place a map with keys of its own.
  template <NamedEnum E, class Keys>
  void choice_or_section(const std::string& key, E& value, Keys& keys, const std::string& meaning,
                         void (*declare)(Section&, Keys&));

  template <class T>
  void section(const std::string& key, T& value, const std::string& meaning, void (*declare)(Section&, T&));
  /// Left out, it stays empty and the feature costs nothing.
  template <class T>
  void optional_section(const std::string& key, std::optional<T>& value, const std::string& meaning,
                        void (*declare)(Section&, T&));
  template <class T>
  void list(const std::string& key, std::vector<T>& values, const std::string& meaning,
            void (*declare)(Section&, T&));

  /// One kind of a variant: its name after `type:` and the keys that come with it.
  template <class Variant>
  struct Alternative {
    std::string name;
    std::string meaning;
    std::function<void(Section&, Variant&)> declare;
  };
  /// This map is one of several kinds; `key` (which has no default) says which.
  template <class Variant>
  void variant(const std::string& key, Variant& value, const std::vector<Alternative<Variant>>& alternatives,
               const std::string& meaning);

  /// A rule between several keys; the message is located at `key`.
  void rule(bool holds, const std::string& key, const std::string& text) const;

  /// Throws for a key that no declaration named and for a required one that is missing. Called by whoever
  /// opened the section, after its declaration.
  void finish() const;
  /// The values in force, as a map.
  const CaseNode& effective() const { return effective_; }

 private:
  using DeclareKeys = std::function<void(Section&)>;

  const CaseNode* look_up(const std::string& key);
  const CaseNode* look_up_scalar(const std::string& key);
  void read_one_number(const std::string& key, const CaseNode& node, const NumberRule& rule,
                       double* value) const;
  bool read_number_key(const std::string& key, double& value, const NumberRule& rule);
  void read_one_integer(const std::string& key, const CaseNode& node, const NumberRule& rule,
                        int* value) const;
  bool read_vector3_key(const std::string& key, Eigen::Vector3d& value, const NumberRule& rule);
  bool read_integer_key(const std::string& key, int& value, const NumberRule& rule);
  [[noreturn]] void fail(const std::string& key, const CaseNode& node, const std::string& rule) const;
  std::string path_of(const std::string& key) const;
  void document(const std::string& key, const std::string& type, const NumberRule& rule,
                const std::string& default_value, const std::string& meaning);
  void record(const std::string& key, const std::string& text, bool quoted = false);
  void record(const std::string& key, CaseNode value);
  void require(const std::string& key, const std::string& hint = "");
  void check_given(const std::string& key) const;  // a variant without its type can declare nothing more

  /// Index of the chosen name; the default where the key is left out. Without a default (-1) the key is required.
  int choose(const std::string& key, const std::vector<std::string>& names, int default_index,
             const std::string& meaning);
  void open(const std::string& key, const std::string& meaning, const DeclareKeys& declare);
  bool open_optional(const std::string& key, const std::string& meaning, const DeclareKeys& declare);
  void open_list(const std::string& key, const std::string& meaning, const DeclareKeys& declare_item);
  void describe_alternative(const std::string& key, const std::string& name, const std::string& meaning,
                            const DeclareKeys& declare);
  bool describing() const { return schema_ != nullptr; }

  const CaseNode* node_ = nullptr;
  SchemaTable* schema_ = nullptr;
  std::string path_;
  FileLocation where_;
  std::string case_file_;
  CaseNode effective_;
  std::vector<std::string> known_;
  std::vector<std::string> missing_;
};

template <NamedEnum E>
void Section::choice(const std::string& key, E& value, const std::string& meaning) {
  value = static_cast<E>(choose(key, names_of<E>(), static_cast<int>(value), meaning));
}

template <NamedEnum E>
void Section::choice(const std::string& key, E& value, const std::vector<E>& admitted,
                     const std::string& meaning) {
  std::vector<std::string> names;
  for (const E one : admitted) names.push_back(to_string(one));
  const auto current = std::find(admitted.begin(), admitted.end(), value);
  CUPOLA_ASSERT(current != admitted.end());
  const int chosen = choose(key, names, static_cast<int>(current - admitted.begin()), meaning);
  value = admitted[static_cast<size_t>(chosen)];
}

template <NamedEnum E>
void Section::required_choice(const std::string& key, E& value, const std::string& meaning) {
  const int chosen = choose(key, names_of<E>(), -1, meaning);
  if (chosen >= 0) value = static_cast<E>(chosen);
}

template <NamedEnum E, class Keys>
void Section::choice_or_section(const std::string& key, E& value, Keys& keys, const std::string& meaning,
                                void (*declare)(Section&, Keys&)) {
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  const bool is_map = node && node->kind == CaseNode::Kind::map;
  if (!is_map) choice(key, value, meaning);
  if (is_map || describing()) section(key, keys, "instead of a name", declare);
}

template <class T>
void Section::section(const std::string& key, T& value, const std::string& meaning,
                      void (*declare)(Section&, T&)) {
  open(key, meaning, [&](Section& s) { declare(s, value); });
}

template <class T>
void Section::optional_section(const std::string& key, std::optional<T>& value, const std::string& meaning,
                               void (*declare)(Section&, T&)) {
  T present{};
  if (open_optional(key, meaning, [&](Section& s) { declare(s, present); })) value = std::move(present);
}

template <class T>
void Section::list(const std::string& key, std::vector<T>& values, const std::string& meaning,
                   void (*declare)(Section&, T&)) {
  open_list(key, meaning, [&](Section& s) {
    T item{};
    declare(s, item);
    values.push_back(std::move(item));
  });
}

template <class Variant>
void Section::variant(const std::string& key, Variant& value,
                      const std::vector<Alternative<Variant>>& alternatives, const std::string& meaning) {
  std::vector<std::string> names;
  for (const auto& alternative : alternatives) names.push_back(alternative.name);
  const int chosen = choose(key, names, -1, meaning);
  check_given(key);
  if (chosen >= 0) alternatives[static_cast<size_t>(chosen)].declare(*this, value);
  if (!describing()) return;
  for (const auto& alternative : alternatives) {
    Variant example;
    describe_alternative(key, alternative.name, alternative.meaning,
                         [&](Section& s) { alternative.declare(s, example); });
  }
}

/// An alternative of a variant that starts from the defaults of T.
template <class Variant, class T>
Section::Alternative<Variant> alternative(const std::string& name, const std::string& meaning,
                                          void (*declare)(Section&, T&)) {
  return {name, meaning, [declare](Section& s, Variant& value) { declare(s, value.template emplace<T>()); }};
}

}  // namespace cupola
