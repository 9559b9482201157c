#include "postproc/compare/side_by_side.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "postproc/figures/shell_maps.hpp"
#include "postproc/report/html.hpp"

namespace cupola {

std::vector<Figure> common_maps(const std::vector<std::string>& folders,
                                const std::vector<std::string>& labels) {
  struct OfRun {
    ShellMap map;
    size_t run = 0;
  };
  std::vector<std::vector<OfRun>> maps;  // of each wythe
  MapScales scales;
  for (size_t run = 0; run < folders.size(); ++run)
    for (ShellMap& map : read_shell_maps(folders[run])) {
      scales.include(map);
      auto same = std::ranges::find_if(maps, [&map](const std::vector<OfRun>& of_wythe) {
        return of_wythe.front().map.wythe == map.wythe;
      });
      if (same == maps.end()) same = maps.emplace(maps.end());
      same->push_back({std::move(map), run});
    }
  std::vector<Figure> figures;
  for (Figure (*draw)(const ShellMap&, const MapScales&) : {force_map, utilisation_map})
    for (const std::vector<OfRun>& of_wythe : maps)
      for (const auto& [map, run] : of_wythe) {
        Figure figure = draw(map, scales);
        if (figure.commands.empty()) continue;
        figures.push_back(std::move(figure));
        figures.back().name += " " + labels[run];
      }
  return figures;
}

std::string figure_picture(const std::string& folder, const Figure& figure, const std::string& alternative) {
  const std::string picture = html_picture(picture_file(folder, figure), alternative);
  return picture.empty() ? "Not drawn: " + html_text(alternative) : picture;
}

std::string maps_html(const std::vector<Figure>& maps, const std::string& figure_folder) {
  std::string out, title;
  for (const Figure& map : maps) {
    const std::string label = map.name.substr(map.name.find(' ') + 1);
    if (map.title != title)
      out += fmt::format(
          "{}<h3>{}</h3>\n<p>{} The scales are the same for all runs.</p>\n<div class=\"side\">\n",
          out.empty() ? "" : "</div>\n", html_text(map.title), html_text(map.caption));
    title = map.title;
    out += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                       figure_picture(figure_folder, map, title + ", " + label), html_text(label));
  }
  return out.empty() ? "" : out + "</div>\n";
}

}  // namespace cupola
