#include "postproc/viewer/viewer.hpp"

#include <fmt/format.h>

#include "assembly/files/base64.hpp"
#include "postproc/viewer/packed_arrays.hpp"
#include "postproc/viewer/scene.hpp"
#include "postproc/viewer/viewer_text.hpp"

namespace cupola {
namespace {

std::string data_element(const char* id, const std::string& bytes) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id, base64(deflated(bytes)));
}

}  // namespace

std::string viewer_html(const Evaluation& evaluation, const Film& film) {
  std::string html = fmt::format("<style>{}</style>\n", kViewerStyle);
  html +=
      "<section id=\"view\"><p>The 3-D view is loading.</p><noscript>It requires "
      "JavaScript.</noscript></section>\n";
  html += data_element("three", std::string(kThreeScript) + "\n" + kOrbitControlsScript);
  html += data_element("scene", scene_bytes(evaluation, film));
  html += fmt::format("<!--\nThe 3-D view contains three.js (threejs.org):\n\n{}\n-->\n", kThreeLicence);
  return html + "<script>\n(() => {\n\"use strict\";\n" + kViewerScript + "})();\n</script>\n";
}

}  // namespace cupola
