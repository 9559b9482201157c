#include "postproc/compare/side_by_side.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/shell_maps.hpp"
#include "postproc/report/html.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// The title of a figure: the first line of its script, "# TITLE".
std::string title_of(const std::string& name, const std::vector<std::string>& figure_folders) {
  for (const std::string& folder : figure_folders) {
    const fs::path script = fs::path(folder) / (name + ".gp");
    if (!fs::exists(script)) continue;
    const std::string text = read_text(script.string());
    if (text.starts_with("# ")) return text.substr(2, text.find('\n') - 2);
  }
  return name;
}

}  // namespace

std::vector<Figure> common_maps(const std::vector<std::string>& folders,
                                const std::vector<std::string>& labels) {
  std::vector<std::optional<ShellMap>> maps;
  MapScales scales;
  for (const std::string& folder : folders) {
    maps.push_back(read_shell_map(folder));
    if (maps.back()) scales.include(*maps.back());
  }
  std::vector<Figure> figures;
  for (Figure (*draw)(const ShellMap&, const MapScales&) : {force_map, utilisation_map})
    for (size_t i = 0; i < maps.size(); ++i) {
      if (!maps[i]) continue;
      figures.push_back(draw(*maps[i], scales));
      figures.back().name += " " + labels[i];
    }
  return figures;
}

std::string maps_html(const std::vector<Figure>& maps, const std::string& figure_folder) {
  std::string out, title;
  for (const Figure& map : maps) {
    const std::string label = map.name.substr(map.name.find(' ') + 1);
    if (map.title != title)
      out += fmt::format(
          "{}<h3>{}</h3>\n<p>{} The scales are the same for all runs.</p>\n<div class=\"side\">\n",
          out.empty() ? "" : "</div>\n", markup_text(map.title), markup_text(map.caption));
    title = map.title;
    out += fmt::format(
        "<figure>{}<figcaption>{}</figcaption></figure>\n",
        html_picture((fs::path(figure_folder) / (map.name + ".png")).string(), title + ", " + label),
        markup_text(label));
  }
  return out.empty() ? "" : out + "</div>\n";
}

std::string side_by_side(const std::string& name, const std::vector<std::string>& folders,
                         const std::vector<std::string>& labels) {
  std::vector<std::string> figure_folders;
  for (const std::string& folder : folders) figure_folders.push_back((fs::path(folder) / "figures").string());
  const std::string title = title_of(name, figure_folders);
  std::string pictures;
  for (size_t i = 0; i < folders.size(); ++i) {
    const fs::path base = figure_folders[i];
    const fs::path svg = base / (name + ".svg"), png = base / (name + ".png");
    const std::string picture =
        html_picture((fs::exists(svg) ? svg : png).string(), title + ", " + labels[i]);
    if (!picture.empty())
      pictures +=
          fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", picture, markup_text(labels[i]));
  }
  if (pictures.empty()) return "";
  return fmt::format("<h3>{}</h3>\n<div class=\"side\">\n{}</div>\n", markup_text(title), pictures);
}

}  // namespace cupola
