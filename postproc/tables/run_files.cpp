#include "postproc/tables/run_files.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

using UnorderedJson = nlohmann::json;

UnorderedJson read_json(const std::string& path) {
  UnorderedJson json = UnorderedJson::parse(read_text(path), nullptr, /*allow_exceptions=*/false);
  if (!json.is_object())
    throw InputError(FileLocation{path},
                     "is not a complete JSON object: run the program that writes it again");
  return json;
}

/// The value at a path of keys separated by dots; nullptr if there is none.
const UnorderedJson* descend(const UnorderedJson& root, const std::string& key) {
  const UnorderedJson* at = &root;
  for (size_t start = 0; start <= key.size();) {
    const size_t dot = std::min(key.find('.', start), key.size());
    const std::string name = key.substr(start, dot - start);
    if (at->is_object() && at->contains(name)) {
      at = &(*at)[name];
    } else if (at->is_array() && !name.empty() && name.find_first_not_of("0123456789") == std::string::npos &&
               name.size() < 8 && std::stoul(name) < at->size()) {
      at = &(*at)[std::stoul(name)];
    } else {
      return nullptr;
    }
    start = dot + 1;
  }
  return at;
}

/// "; did you mean KEY?" for a key that is probably misspelt, or "".
std::string near_key(const UnorderedJson& root, const std::string& key) {
  const size_t dot = key.rfind('.');
  const std::string parent = dot == std::string::npos ? "" : key.substr(0, dot + 1);
  const UnorderedJson* map = parent.empty() ? &root : descend(root, key.substr(0, dot));
  std::vector<std::string> names;
  if (map && map->is_object())
    for (const auto& entry : map->items()) names.push_back(entry.key());
  const std::string near = nearest_name(key.substr(parent.size()), names);
  return near.empty() ? "" : fmt::format("; did you mean {}{}?", parent, near);
}

/// Those of a list; none if there is no list.
std::vector<std::string> texts_of(const UnorderedJson* list) {
  std::vector<std::string> texts;
  if (list && list->is_array())
    for (const UnorderedJson& text : *list)
      if (text.is_string()) texts.push_back(text.get<std::string>());
  return texts;
}

}  // namespace

struct RunFiles::Summaries {
  std::optional<UnorderedJson> results, post, answers;

  const UnorderedJson& results_of(const std::string& folder) {
    if (!results) results = read_json(folder + "/results/summary.json");
    return *results;
  }
  const UnorderedJson& answers_of(const std::string& folder) {
    if (!answers) answers = read_json(folder + "/post/answers.json");
    return *answers;
  }
  /// Throws InputError if it evaluates other results than those beside it.
  const UnorderedJson& post_of(const std::string& folder) {
    if (post) return *post;
    const std::string path = folder + "/post/summary.json";
    UnorderedJson read = read_json(path);
    for (const char* key : {"case_hash", "assembly_hash"})
      if (read.contains(key) && std::filesystem::exists(folder + "/results/summary.json") &&
          results_of(folder).value(key, read[key]) != read[key])
        throw InputError(FileLocation{path},
                         "is of another run than results/: run cupola-post analyse again");
    return post.emplace(std::move(read));
  }
};

RunFiles::RunFiles(std::string folder)
    : folder_(std::move(folder)), summaries_(std::make_unique<Summaries>()) {}
RunFiles::~RunFiles() = default;

std::vector<std::string> RunFiles::warnings() {
  return texts_of(descend(summaries_->post_of(folder_), "warnings"));
}

std::string RunFiles::text_of_results(const std::string& key) {
  const std::string path = folder_ + "/results/summary.json";
  const UnorderedJson* text = descend(summaries_->results_of(folder_), key);
  if (!text || !text->is_string()) throw InputError(FileLocation{path}, fmt::format("has no `{}`", key));
  return text->get<std::string>();
}

std::string RunFiles::status() {
  return text_of_results("status");
}

std::string RunFiles::message() {
  return text_of_results("message");
}

std::string RunFiles::found_instead() {
  const UnorderedJson* found = descend(summaries_->results_of(folder_), "sought.found");
  return found && found->is_string() && found->get_ref<const std::string&>() != "" ? found->get<std::string>()
                                                                                   : message();
}

std::string RunFiles::answer(const std::string& key) {
  const UnorderedJson* text = descend(summaries_->answers_of(folder_), key);
  return text && text->is_string() ? text->get<std::string>() : "";
}

std::vector<std::string> RunFiles::answers(const std::string& key) {
  return texts_of(descend(summaries_->answers_of(folder_), key));
}

std::string RunFiles::revision() {
  const std::string version = text_of_results("program_version");
  const size_t open = version.rfind('('), close = version.rfind(')');
  return open == std::string::npos || close == std::string::npos ? version
                                                                 : version.substr(open + 1, close - open - 1);
}

double RunFiles::number_of_case(const std::string& key) {
  const std::string path = folder_ + "/results/run.yaml";
  if (!case_) case_ = load_case_tree(path, {});
  const CaseNode* node = &*case_;
  for (size_t start = 0; node && start <= key.size();) {
    const size_t dot = std::min(key.find('.', start), key.size());
    node = node->find(key.substr(start, dot - start));
    start = dot + 1;
  }
  double value = 0.0;
  if (!node || node->kind != CaseNode::Kind::scalar || !read_number(node->text, &value).empty())
    throw InputError(FileLocation{path}, fmt::format("has no number `{}`", key));
  return value;
}

double RunFiles::number(const std::string& key) {
  const bool of_results = key.starts_with("results.");
  if (key.starts_with("case.")) return number_of_case(key.substr(key.find('.') + 1));
  if (!of_results && !key.starts_with("post."))
    throw InputError(fmt::format("key {}: must begin with `results.`, `post.` or `case.`", key));
  const std::string path = folder_ + (of_results ? "/results/" : "/post/") + "summary.json";
  const UnorderedJson& json = of_results ? summaries_->results_of(folder_) : summaries_->post_of(folder_);
  const std::string inner = key.substr(key.find('.') + 1);
  const UnorderedJson* value = descend(json, inner);
  if (value && value->is_boolean()) return value->get<bool>() ? 1.0 : 0.0;
  if (!value || !value->is_number())
    throw InputError(FileLocation{path}, fmt::format("has no number `{}`{}", inner, near_key(json, inner)));
  return value->get<double>();
}

std::optional<double> RunFiles::number_if_any(const std::string& key) {
  try {
    return number(key);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

bool RunFiles::has_results_table(const std::string& name) {
  if (!std::filesystem::exists(folder_ + "/results/summary.json")) return false;
  const UnorderedJson* files = descend(summaries_->results_of(folder_), "text_files");
  return files && files->contains(name + ".csv");
}

const CsvFile& RunFiles::table(const std::string& name) {
  const auto found = tables_.find(name);
  if (found != tables_.end()) return found->second;
  const bool of_results = name.starts_with("results/");
  const std::string path = fmt::format("{}/{}{}.csv", folder_, of_results ? "" : "post/", name);
  if (of_results && !has_results_table(name.substr(name.find('/') + 1)))
    throw InputError(FileLocation{path}, "is not listed in summary.json, so it does not belong to this run");
  return tables_.emplace(name, read_csv(path)).first->second;
}

std::vector<std::string> RunFiles::table_names(const std::string& start) const {
  std::vector<std::string> names;
  std::error_code missing_folder;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ + "/post", missing_folder)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == ".csv" && path.stem().string().starts_with(start))
      names.push_back(path.stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool RunCache::finished(const std::string& name) const {
  const std::filesystem::path folder = std::filesystem::path(out_) / name;
  return std::filesystem::exists(folder / "post" / "summary.json") &&
         std::filesystem::exists(folder / "results" / "summary.json");
}

RunFiles& RunCache::run(const std::string& name) {
  return runs_.try_emplace(name, (std::filesystem::path(out_) / name).string()).first->second;
}

}  // namespace cupola
