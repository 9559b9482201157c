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
#include "assembly/case/plausible_range.hpp"
#include "assembly/case/schema_table.hpp"
#include "assembly/files/number_text.hpp"
#include "assembly/model/block_ref.hpp"

namespace cupola {

/// A file that a key of the case names.
struct NamedFile {
  std::string key;   ///< its path, `supports.base_motion.file`
  std::string path;  ///< to open
};

/// One map of the case file. A declaration function declares every key once, with unit, range and meaning.
/// That one line reads the key, documents it in `--schema` and writes it to run.yaml:
///
///     void declare_joints(Section& s, Joints& joints) {
///       s.number("friction", joints.friction, {.min = 0}, "Coulomb friction coefficient mu");
///     }
///
/// The value of the variable on entry is the default. A key in the file that no declaration names is an
/// error.
class Section {
 public:
  /// Reads `node`. It is nullptr if the file has no such section; messages then refer to `where`. `case_file`
  /// is the path given on the command line.
  Section(const CaseNode* node, std::string path, FileLocation where, std::string case_file);
  /// Reads nothing; adds one row per key to `schema`.
  Section(SchemaTable* schema, std::string path);

  void text(const std::string& key, std::string& value, const std::string& meaning);
  /// The name of a file in or below the folder of the case file (see path_inside), or of the bundled case
  /// that names it. `path` gets the path to open; without the key it stays unchanged.
  void file(const std::string& key, std::string& path, const std::string& meaning, bool or_folder = false);
  /// `shown_default` replaces the value on entry in `--schema`, for a default that depends on other keys.
  void number(const std::string& key, double& value, const NumberRule& rule, const std::string& meaning,
              const std::string& shown_default = "");
  /// A number that another key overrides with `value`. The number in the file is checked and ignored;
  /// run.yaml gets `value`.
  void settled_number(const std::string& key, double value, const NumberRule& rule);
  /// A required key: `value` on entry is ignored.
  void required_number(const std::string& key, double& value, const NumberRule& rule,
                       const std::string& meaning);
  /// Without the key, `value` stays empty; `without` describes that default in `--schema`.
  void optional_number(const std::string& key, std::optional<double>& value, const NumberRule& rule,
                       const std::string& without, const std::string& meaning);
  void integer(const std::string& key, int& value, const NumberRule& rule, const std::string& meaning);
  void required_integer(const std::string& key, int& value, const NumberRule& rule,
                        const std::string& meaning);
  /// Blocks by number, or by their names in an imported file. A quoted number is a name.
  void required_block(const std::string& key, BlockRef& value, const std::string& meaning);
  void optional_block(const std::string& key, std::optional<BlockRef>& value, const std::string& without,
                      const std::string& meaning);
  void blocks(const std::string& key, std::vector<BlockRef>& values, const std::string& meaning);
  void flag(const std::string& key, bool& value, const std::string& meaning);
  void vector3(const std::string& key, Eigen::Vector3d& value, const NumberRule& rule,
               const std::string& meaning);
  void optional_vector3(const std::string& key, std::optional<Eigen::Vector3d>& value, const NumberRule& rule,
                        const std::string& without, const std::string& meaning);
  void numbers(const std::string& key, std::vector<double>& values, const NumberRule& rule,
               const std::string& meaning);

  /// A key of earlier versions: an error that says what replaces it.
  void retired(const std::string& key, const std::string& instead) const;
  /// A key that others of this case exclude: an error that says what to do.
  void refuse(const std::string& key, const std::string& advice) const;
  void texts(const std::string& key, std::vector<std::string>& values, const std::string& meaning);

  /// A quantity with several names, of which the case gives at most one: value = factor * number.
  struct UnitName {
    std::string key;
    double factor;
    NumberRule rule;
    std::string meaning;
  };
  /// run.yaml gets the first name, whose factor must be 1.
  void quantity(double& value, const std::vector<UnitName>& names);

  /// One of the names of an enumeration.
  template <NamedEnum E>
  void choice(const std::string& key, E& value, const std::string& meaning);
  /// One of the names of the values in `admitted`, which must include `value` on entry.
  template <NamedEnum E>
  void choice(const std::string& key, E& value, const std::vector<E>& admitted, const std::string& meaning);
  /// A required key: `value` on entry is ignored.
  /// `advice` says how to choose.
  template <NamedEnum E>
  void required_choice(const std::string& key, E& value, const std::string& meaning,
                       const std::string& advice);
  /// Either a name or a map of keys.
  template <NamedEnum E, class Keys>
  void choice_or_section(const std::string& key, E& value, Keys& keys, const std::string& meaning,
                         void (*declare)(Section&, Keys&));
  /// Either a number or a map of keys. A required key: `value` on entry is ignored.
  template <class Keys>
  void required_number_or_section(const std::string& key, double& value, const NumberRule& rule, Keys& keys,
                                  const std::string& meaning, void (*declare)(Section&, Keys&));

  template <class T>
  void section(const std::string& key, T& value, const std::string& meaning, void (*declare)(Section&, T&));
  /// Without the key, `value` stays empty.
  template <class T>
  void optional_section(const std::string& key, std::optional<T>& value, const std::string& meaning,
                        void (*declare)(Section&, T&));
  /// `maps_or_names`: a bare name stands for the map {type: name}.
  enum class Items { maps, maps_or_names };
  template <class T>
  void list(const std::string& key, std::vector<T>& values, const std::string& meaning,
            void (*declare)(Section&, T&), Items items = Items::maps);

  /// Either a list of maps or one map of keys.
  template <class T, class Keys>
  void list_or_section(const std::string& key, std::vector<T>& values, void (*declare_item)(Section&, T&),
                       Keys& keys, void (*declare_keys)(Section&, Keys&), const std::string& meaning);

  /// One alternative of a variant: its name (after `type:`) and its keys.
  template <class Variant>
  struct Alternative {
    std::string name;
    std::string meaning;
    std::function<void(Section&, Variant&)> declare;
  };
  /// A map of one of several types; the required key `key` names the type.
  template <class Variant>
  void variant(const std::string& key, Variant& value, const std::vector<Alternative<Variant>>& alternatives,
               const std::string& meaning);

  /// True if the file gives the key, with an item if it is a list.
  bool gives(const std::string& key) const;
  /// True if the file gives no key of this section. False while the schema is described.
  bool is_empty() const;
  /// True if the file gives the key in the map that contains this one.
  bool parent_gives(const std::string& key) const { return parent_ && parent_->gives(key); }
  /// Checks a rule between several keys; the message refers to `key`.
  void rule(bool holds, const std::string& key, const std::string& text) const;

  /// Throws InputError for a missing required key of this section or of one below it. To be called once,
  /// after the declaration of the whole file: a missing key is reported only where nothing that is given is
  /// wrong.
  void finish() const;
  /// From now on `files` receives what file() reads, the files of a folder instead of the folder.
  void collect_files(std::vector<NamedFile>* files) { files_ = files; }
  /// From now on `ranges` receives what expect() is given.
  void collect_expected(std::vector<PlausibleRange>* ranges) { expected_ = ranges; }
  /// A value of this section is expected in this range: outside of it the user gets a warning.
  void expect(PlausibleRange range) const;
  /// The values in force, defaults included, as a map.
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
  BlockRef read_block(const std::string& key, const CaseNode& node) const;
  bool read_vector3_key(const std::string& key, Eigen::Vector3d& value, const NumberRule& rule);
  bool read_integer_key(const std::string& key, int& value, const NumberRule& rule);
  [[noreturn]] void fail(const std::string& key, const CaseNode& node, const std::string& rule) const;
  std::string path_of(const std::string& key) const;
  void document(const std::string& key, const std::string& type, const NumberRule& rule,
                const std::string& default_value, const std::string& meaning);
  void record(const std::string& key, const std::string& text, bool quoted = false);
  void record(const std::string& key, CaseNode value);
  void require(const std::string& key, const std::string& hint = "");
  /// End of a message about a key that is not given: an unknown key that may stand for it, or "".
  std::string misspelling_of(const std::string& key) const;
  [[noreturn]] void fail_without(const std::string& key) const;  // `key` is the last missing one
  void check_names() const;                                      // throws for an unknown key
  void close(const Section& child);  // checks its names and takes over its missing keys

  /// Index of the chosen name, or the default without the key. If there is no default (-1), the key is
  /// required.
  int choose(const std::string& key, const std::vector<std::string>& names, int default_index,
             const std::string& meaning, const std::string& advice = "");
  void open(const std::string& key, const std::string& meaning, const DeclareKeys& declare);
  bool open_optional(const std::string& key, const std::string& meaning, const DeclareKeys& declare);
  void open_list(const std::string& key, Items kind, const std::string& meaning,
                 const DeclareKeys& declare_item);
  void describe_alternative(const std::string& key, const std::string& name, const std::string& meaning,
                            const DeclareKeys& declare);
  bool describing() const { return schema_ != nullptr; }

  const CaseNode* node_ = nullptr;
  const Section* parent_ = nullptr;
  SchemaTable* schema_ = nullptr;
  std::string path_;
  FileLocation where_;
  std::string case_file_;
  std::vector<NamedFile>* files_ = nullptr;
  std::vector<PlausibleRange>* expected_ = nullptr;
  CaseNode effective_;
  std::vector<std::string> known_;
  std::vector<std::pair<FileLocation, std::string>> missing_;  // messages
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
void Section::required_choice(const std::string& key, E& value, const std::string& meaning,
                              const std::string& advice) {
  const int chosen = choose(key, names_of<E>(), -1, meaning, advice);
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

template <class Keys>
void Section::required_number_or_section(const std::string& key, double& value, const NumberRule& rule,
                                         Keys& keys, const std::string& meaning,
                                         void (*declare)(Section&, Keys&)) {
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  const bool is_map = node && node->kind == CaseNode::Kind::map;
  if (!is_map) required_number(key, value, rule, meaning);
  if (is_map || describing()) section(key, keys, "instead of a number", declare);
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
                   void (*declare)(Section&, T&), Items items) {
  open_list(key, items, meaning, [&](Section& s) {
    T item{};
    declare(s, item);
    values.push_back(std::move(item));
  });
}

template <class T, class Keys>
void Section::list_or_section(const std::string& key, std::vector<T>& values,
                              void (*declare_item)(Section&, T&), Keys& keys,
                              void (*declare_keys)(Section&, Keys&), const std::string& meaning) {
  const CaseNode* node = node_ ? node_->find(key) : nullptr;
  const bool is_map = node && node->kind == CaseNode::Kind::map;
  if (!is_map) list(key, values, meaning, declare_item);
  if (is_map || describing()) section(key, keys, "instead of a list", declare_keys);
}

template <class Variant>
void Section::variant(const std::string& key, Variant& value,
                      const std::vector<Alternative<Variant>>& alternatives, const std::string& meaning) {
  std::vector<std::string> names;
  for (const auto& alternative : alternatives) names.push_back(alternative.name);
  const int chosen = choose(key, names, -1, meaning);
  if (chosen < 0 && !describing()) fail_without(key);  // the other keys depend on it
  if (chosen >= 0) alternatives[static_cast<size_t>(chosen)].declare(*this, value);
  if (!describing()) return;
  for (const auto& alternative : alternatives) {
    Variant example;
    describe_alternative(key, alternative.name, alternative.meaning,
                         [&](Section& s) { alternative.declare(s, example); });
  }
}

/// An alternative of a variant that holds a T, starting from its defaults.
template <class Variant, class T>
Section::Alternative<Variant> alternative(const std::string& name, const std::string& meaning,
                                          void (*declare)(Section&, T&)) {
  return {name, meaning, [declare](Section& s, Variant& value) { declare(s, value.template emplace<T>()); }};
}

}  // namespace cupola
