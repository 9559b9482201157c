#include "postproc/viewer/viewer.hpp"

#include <fmt/format.h>

#include "postproc/viewer/packed_scripts.hpp"
#include "postproc/viewer/packed_text.hpp"
#include "postproc/viewer/scene.hpp"
#include "postproc/viewer/viewer_text.hpp"

namespace cupola {
namespace {

constexpr const char* kScene = "scene";

/// Text that a browser does not run.
std::string data_element(const std::string& id, const std::string& text) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, text);
}

std::string section(const std::string& attributes) {
  return fmt::format(
      "<section class=\"view\" {}><p>The 3-D view is loading.</p><noscript>It requires "
      "JavaScript.</noscript></section>\n",
      attributes);
}

std::string style() {
  return fmt::format("<style>{}</style>\n", kViewerStyle);
}

/// The program, which starts at once.
std::string program() {
  return data_element("three", kPackedScripts) +
         fmt::format("<!--\nThe 3-D view contains three.js (threejs.org):\n\n{}\n-->\n", kThreeLicence) +
         "<script>\n(() => {\n\"use strict\";\n" + kViewerScript + "})();\n</script>\n";
}

}  // namespace

std::string viewer_html(const Evaluation& evaluation, const Film& film) {
  return style() + section(fmt::format("id=\"view\" data-scene=\"{}\"", kScene)) +
         data_element(kScene, packed_text(scene_bytes(evaluation, film))) + program();
}

std::string scene_of_report(const std::string& html) {
  const std::string start = data_element(kScene, "");
  const std::string opening = start.substr(0, start.find("</script>"));
  const size_t begin = html.find(opening);
  if (begin == std::string::npos) return "";
  const size_t text = begin + opening.size();
  return html.substr(text, html.find('<', text) - text);
}

std::string linked_views_html(const std::vector<LabelledScene>& scenes) {
  std::string html = style() + "<div class=\"compared\">\n", data;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const std::string id = fmt::format("{}-{}", kScene, i);
    html += section(fmt::format("data-label=\"{}\" data-scene=\"{}\"", scenes[i].label, id));
    data += data_element(id, scenes[i].scene);
  }
  return html + "</div>\n" + data + program();
}

}  // namespace cupola
