#include "postproc/compare/side_by_side.hpp"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "postproc/figures/shell_maps.hpp"
#include "postproc/report/html.hpp"

namespace cupola {

namespace fs = std::filesystem;

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
      Figure figure = draw(*maps[i], scales);
      if (figure.commands.empty()) continue;
      figures.push_back(std::move(figure));
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

}  // namespace cupola
