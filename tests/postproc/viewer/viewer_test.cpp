// The 3-D view of a report, opened in headless Chromium without network and used with the mouse.

#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/compare/compare.hpp"
#include "postproc/tables/csv_file.hpp"
#include "tests/postproc/analysed_column.hpp"
#include "tests/postproc/browser.hpp"

namespace cupola::viewer_test {
namespace {

using test::Browser;

std::string column_at_rest() {
  const Assembly a = test::column(3);
  return test::analysed_column("rest", {test::column_at_rest(a, test::kGravity, 0.0, 0.5, 0.3)},
                               test::column_summary(a));
}

/// The upper blocks slide away by 0.4 m per frame.
std::string sliding_column(int num_frames) {
  const Assembly a = test::column(3);
  std::vector<Frame> frames;
  for (int i = 0; i < num_frames; ++i) {
    Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
    frame.time = i;
    for (const size_t b : {2u, 3u}) {
      frame.blocks.displacement[b] = Vec3(0.4 * i, 0, 0);
      frame.blocks.position[b].x() += 0.4 * i;
    }
    frames.push_back(frame);
  }
  Summary summary = test::column_summary(a);
  summary.status = Status::collapsed;
  summary.analysis = AnalysisType::dynamic;
  summary.max_speed_m_per_s = 0.4;
  return test::analysed_column("sliding", frames, summary);
}

/// All tests share one Chromium, which takes seconds to start.
class Viewer : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::has_browser()) GTEST_SKIP() << "chromium is not installed";
    if (!browser || !browser->runs()) browser = std::make_unique<Browser>();
    browser->start_anew();
  }
  static void TearDownTestSuite() { browser.reset(); }

  /// Opens a report and waits until its view can be used. The page's variable `view` is the viewer.
  static void open_view(const std::string& post) {
    browser->open(post + "/report.html");
    browser->value("window.cupolaView.then((v) => { window.view = v; return true; })");
  }

  static inline std::unique_ptr<Browser> browser;
};

/// Pixels of the picture that differ from its corner.
constexpr const char* kDrawnPixels = R"js((() => {
  view.stage.draw();
  const gl = view.stage.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
  const p = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, p);
  let drawn = 0;
  for (let i = 4; i < p.length; i += 4) drawn += p[i] !== p[0] || p[i + 1] !== p[1] || p[i + 2] !== p[2];
  return drawn / (w * h);
})())js";

TEST_F(Viewer, DrawsTheModelWithoutComplaintInLightAndDark) {
  const std::string post = column_at_rest();
  for (const bool dark : {false, true})
    for (const int width : {1280, 390}) {
      browser->resize(width, 900, dark);
      open_view(post);
      EXPECT_GT(browser->value(kDrawnPixels).get<double>(), 0.05) << width;
      EXPECT_EQ(browser->value("document.documentElement.scrollWidth - document.documentElement.clientWidth"),
                0)
          << width;
      const std::string paper = browser->value("getComputedStyle(document.body).backgroundColor");
      EXPECT_EQ(paper == "rgb(255, 255, 255)", !dark) << paper;
      browser->value("view.model.faces.visible = false");
      EXPECT_LT(browser->value(kDrawnPixels).get<double>(), 0.01) << "the pixels were those of the blocks";
    }
  EXPECT_EQ(fmt::format("{}", fmt::join(browser->complaints(), "\n")), "");
}

TEST_F(Viewer, AClickOnABlockShowsItsNumbersOfTheTable) {
  const std::string post = column_at_rest();
  open_view(post);
  const auto middle = browser->value(
      "(() => { const r = view.stage.canvas.getBoundingClientRect(); return [r.x + r.width / 2, r.y + "
      "r.height / 2]; })()");
  browser->click(middle[0], middle[1]);
  const std::string heading = browser->value("document.querySelector('#view .numbers h3').textContent");
  ASSERT_TRUE(heading.starts_with("Block ")) << heading;
  const size_t block = std::stoul(heading.substr(6));
  const CsvFile csv = read_csv(post + "/blocks.csv");
  for (const char* key : {"weight_N", "resultant_N", "kern_use", "displacement_z_m"}) {
    const auto shown = browser->value(
        fmt::format("Number(document.querySelector('#view [data-key={}]').dataset.value)", key));
    EXPECT_EQ(shown.is_null() ? std::nan("") : shown.get<double>(), csv.number(block, csv.column(key)))
        << key;
  }
}

// The worst joint is named in the text, and a click on it selects it in the picture.
TEST_F(Viewer, LinksInTheTextSelectTheirJoint) {
  const std::string post = column_at_rest();
  open_view(post);
  const size_t joint = std::stoul(
      browser->value("document.querySelector('li [data-joint]').dataset.joint").get<std::string>());
  browser->value("document.querySelector('li [data-joint]').click()");
  EXPECT_EQ(browser->value("document.querySelector('#view .numbers h3').textContent"),
            fmt::format("Joint {}", joint));
  const CsvFile csv = read_csv(post + "/joints.csv");
  EXPECT_EQ(
      browser->value("Number(document.querySelector('#view [data-key=edge_distance_m]').dataset.value)"),
      csv.number(joint, csv.column("edge_distance_m")));
}

TEST_F(Viewer, EveryNumberOfEveryJointIsThatOfTheTable) {
  const std::string post = column_at_rest();
  const CsvFile csv = read_csv(post + "/joints.csv");
  open_view(post);
  const auto keys = browser->value("view.header.joint_columns.map((c) => c.key)");
  EXPECT_GE(keys.size(), 15u);
  for (const std::string key : keys) {
    const auto values = browser->value(fmt::format("Array.from(view.model.sets[0].get('{}'))", key));
    ASSERT_EQ(values.size(), csv.rows.size());
    for (size_t j = 0; j < csv.rows.size(); ++j) {
      const double expected = csv.number(j, csv.column(key));
      EXPECT_TRUE(values[j].is_number() ? values[j].get<double>() == expected : std::isnan(expected))
          << key << " of joint " << j;
    }
  }
}

TEST_F(Viewer, TheFilmOfAMotionAdvances) {
  open_view(sliding_column(6));
  EXPECT_EQ(browser->value("view.film.count"), 6);
  const char* place =
      "view.film.show({}), view.model.faces.geometry.attributes.position.array["
      "3 * view.model.blocks.start[3]]";
  const double first = browser->value(fmt::format(fmt::runtime(place), 0)).get<double>();
  const double last = browser->value(fmt::format(fmt::runtime(place), 5)).get<double>();
  EXPECT_NEAR(last - first, 2.0, 1e-4);  // rounding of the positions
  browser->value("view.find('.play').click()");
  browser->value(
      "new Promise((done) => { const t = setInterval(() => { if (view.film.frame === 5 && "
      "!view.film.isPlaying) "
      "{ clearInterval(t); done(true); } }, 50); setTimeout(() => done(false), 20000); })");
  EXPECT_EQ(browser->value("view.film.frame"), 5);
  EXPECT_EQ(browser->value("view.find('.film output').textContent"), "5.000 s");
  browser->value(
      "(() => { const slider = view.find('.frame'); slider.value = 2; slider.dispatchEvent(new "
      "Event('input')); })()");
  EXPECT_EQ(browser->value("view.film.frame"), 2) << "the slider was moved";
  EXPECT_TRUE(browser->complaints().empty());
}

// An arrow starts at the centre of pressure of its joint: a click half-way up selects the joint.
TEST_F(Viewer, AClickOnAnArrowShowsItsJoint) {
  open_view(column_at_rest());
  browser->value("view.find('input[name=forces]').click()");
  const auto place = browser->value(R"js((() => {
    const set = view.model.sets[0], p = set.arrows.geometry.attributes.position.array, v = 3 * set.arrows.userData.rods.per;
    const root = view.stage.middle().set(p[v], p[v + 1], p[v + 2]);  // of joint 1
    root.z += 0.5 * set.scale * set.get("force_z_N")[1];
    root.project(view.stage.camera);
    const r = view.stage.canvas.getBoundingClientRect();
    return [r.x + (root.x + 1) / 2 * r.width, r.y + (1 - root.y) / 2 * r.height];
  })())js");
  browser->click(place[0], place[1]);
  EXPECT_EQ(browser->value("document.querySelector('#view .numbers h3').textContent"), "Joint 1");
}

// What is printed is the picture on the screen, dark on white also where the screen is dark.
TEST_F(Viewer, PrintsThePictureOnWhite) {
  browser->resize(1280, 900, true);
  open_view(column_at_rest());
  const auto counts = browser->value(R"js((() => {
    window.dispatchEvent(new Event("beforeprint"));
    const c = view.find(".printed"), p = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
    let white = 0, other = 0;
    for (let i = 0; i < p.length; i += 4) p[i] === 255 && p[i + 1] === 255 && p[i + 2] === 255 ? ++white : ++other;
    return [white / (white + other), other / (white + other)];
  })())js");
  EXPECT_GT(counts[0].get<double>(), 0.5) << "paper";
  EXPECT_GT(counts[1].get<double>(), 0.05) << "blocks";
  EXPECT_EQ(browser->value("getComputedStyle(view.host).getPropertyValue('--picture').trim()"), "#1c1f22")
      << "the screen stays dark";
}

// The PNG is wide enough for print, and the row below the picture has the colours and the ends of the scale.
TEST_F(Viewer, SavesAPictureForPrintWithItsLegend) {
  open_view(column_at_rest());
  browser->value("view.setColour('joint.normal_force_N')");
  const auto saved = browser->value(R"js((() => {
    const before = view.stage.canvas.width, {canvas: c, rows} = view.printed(), pen = c.getContext("2d");
    const top = Math.ceil(c.width * view.stage.canvas.clientHeight / view.stage.canvas.clientWidth) + 1;
    const strip = pen.getImageData(0, top, c.width, c.height - top).data, found = new Set();
    for (let i = 0; i < strip.length; i += 4) found.add(strip[i] << 16 | strip[i + 1] << 8 | strip[i + 2]);
    return {width: c.width, colours: found.size, rows, restored: view.stage.canvas.width === before};
  })())js");
  EXPECT_GE(saved["width"].get<int>(), 2400);
  EXPECT_GT(saved["colours"].get<int>(), 50) << "the gradient";
  EXPECT_EQ(saved["restored"], true);
  const auto& scale = saved["rows"][1];
  EXPECT_NE(scale["text"].get<std::string>().find("ormal force"), std::string::npos) << saved["rows"].dump();
  EXPECT_GE(scale["ends"].size(), 2u);
}

// In every standard view the model touches two opposite edges of the picture, but for 4 %, and lies in its
// middle.
TEST_F(Viewer, TheModelFillsThePicture) {
  open_view(column_at_rest());
  for (const char* view : {"outside", "below", "front", "side", "top"}) {
    const auto reach = browser->value(fmt::format(R"js((() => {{
      const s = view.stage, low = [1, 1], high = [-1, -1];
      s.look("{}");
      s.camera.updateMatrixWorld();
      for (let i = 0; i < s.outline.length; i += 3) {{
        const p = new THREE.Vector3(s.outline[i], s.outline[i + 1], s.outline[i + 2]).project(s.camera);
        [p.x, p.y].forEach((v, k) => {{ low[k] = Math.min(low[k], v); high[k] = Math.max(high[k], v); }});
      }}
      return [high[0] - low[0], high[1] - low[1], high[0] + low[0], high[1] + low[1]];
    }})())js",
                                                  view));
    EXPECT_GT(std::max(reach[0].get<double>(), reach[1].get<double>()), 2 * 0.9) << view;
    EXPECT_LT(std::max(reach[0].get<double>(), reach[1].get<double>()), 2.0) << view;
    for (const int k : {2, 3}) EXPECT_NEAR(reach[k].get<double>(), 0.0, 0.05) << view;
  }
}

// Everything that a pointer does, keys do: turn, zoom, go from block to block.
TEST_F(Viewer, IsUsableByKeyboard) {
  open_view(column_at_rest());
  const auto press = [](const std::string& key) {
    browser->value("view.stage.canvas.dispatchEvent(new KeyboardEvent('keydown', {key: '" + key + "'}))");
  };
  const char* place = "view.stage.camera.position.toArray()";
  const auto start = browser->value(place);
  press("ArrowLeft");
  const auto turned = browser->value(place);
  EXPECT_NE(start, turned);
  press("+");
  EXPECT_NE(browser->value(place), turned);
  press("Home");
  EXPECT_EQ(browser->value("view.stage.standard"), "outside");
  const char* heading = "document.querySelector('#view .numbers h3').textContent";
  press("n");
  const std::string first = browser->value(heading);
  press("n");
  EXPECT_NE(browser->value(heading), first);
  press("p");
  EXPECT_EQ(browser->value(heading), first);
  EXPECT_EQ(browser->value("view.stage.canvas.tabIndex"), 0);
}

// A comparison has one camera, one scale of colours and one of forces.
TEST_F(Viewer, LinksTheViewsOfAComparison) {
  const std::string post = column_at_rest(), folder = test::fresh_folder("linked");
  ASSERT_EQ(compare({post, post}, folder, true), ExitCode::done);
  browser->open(folder + "/comparison.html");
  EXPECT_EQ(browser->value("window.cupolaViews.then((v) => { window.views = v; return v.length; })"), 2);
  const auto direction = [](const char* view) {
    return browser->value(
        std::string("((s) => s.camera.position.clone().sub(s.controls.target).normalize()") +
        ".toArray())(views[" + view + "].stage)");
  };
  browser->value("views[1].stage.turn(0.5, 0.2)");
  const auto first = direction("0");
  const auto second = direction("1");
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(first[k].get<double>(), second[k].get<double>(), 1e-9);
  browser->value(
      "(() => { const s = views[0].find('.colour'); s.value = 'joint.normal_force_N'; s.dispatchEvent(new "
      "Event('change', {bubbles: true})); views[0].find('[name=forces]').click(); })()");
  EXPECT_EQ(browser->value("views[1].colouring.key"), "joint.normal_force_N");
  EXPECT_EQ(browser->value("views[1].forces"), true);
  EXPECT_EQ(browser->value("views[0].find('.legend').innerText === views[1].find('.legend').innerText"),
            true);
  EXPECT_EQ(browser->value("views[0].model.forceScale === views[1].model.forceScale"), true);
  EXPECT_EQ(fmt::format("{}", fmt::join(browser->complaints(), "\n")), "");
}

/// At rest, with the upper blocks displaced by `shift` (m).
std::string displaced_column(const std::string& name, double shift) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.5, 0.3);
  for (const size_t b : {2u, 3u}) {
    frame.blocks.displacement[b] = Vec3(shift, 0, 0);
    frame.blocks.position[b].x() += shift;
  }
  return test::analysed_column(name, {frame}, test::column_summary(a));
}

// 1 and 4 mm were drawn alike, each as a tenth of the model. One factor shows that one is four times the
// other.
TEST_F(Viewer, MagnifiesTheDisplacementsOfAComparisonAlike) {
  const std::string folder = test::fresh_folder("magnified");
  ASSERT_EQ(compare({displaced_column("little", 1e-3), displaced_column("more", 4e-3)}, folder, true),
            ExitCode::done);
  browser->open(folder + "/comparison.html");
  EXPECT_EQ(browser->value("window.cupolaViews.then((v) => { window.views = v; return v.length; })"), 2);
  browser->value(
      "(() => { const s = views[0].find('.magnify'); s.value = 1; s.dispatchEvent(new Event('input', "
      "{bubbles: true})); })()");
  const double first = browser->value("views[0].model.pose.factor"),
               second = browser->value("views[1].model.pose.factor");
  EXPECT_EQ(first, second);
  EXPECT_GT(first, 2.0);
  EXPECT_EQ(fmt::format("{}", fmt::join(browser->complaints(), "\n")), "");
}

std::string column_with_wythes() {
  const Assembly a = test::column_with_wythes();
  return test::analysed_column("wythes", {test::column_with_a_tie(a)}, test::column_summary(a), a);
}

TEST_F(Viewer, TakesWythesAwayMovesThemApartAndShowsTies) {
  open_view(column_with_wythes());
  EXPECT_EQ(
      browser->value("Array.from(view.host.querySelectorAll('.members label'), (l) => l.innerText.trim())"),
      (nlohmann::json{"inner", "bonder", "Support"}))
      << "no block is of the outer wythe";
  const char* triangles = "view.model.faces.geometry.drawRange.count";
  const int all = browser->value(triangles);
  browser->value("view.find('[name=member2]').click()");
  const int fewer = browser->value(triangles);
  EXPECT_EQ(browser->value("view.model.isShown(3)"), false);
  EXPECT_NE(fewer, all);
  browser->value("view.find('[name=member2]').click()");
  EXPECT_EQ(browser->value(triangles), all);
  // The bonder reaches through both wythes: its middle lies half a wythe outside that of the inner one.
  const double moved =
      browser
          ->value(
              "(() => { const s = view.find('.wythes-apart'); s.value = 1; s.dispatchEvent(new "
              "Event('input')); return view.model.pose.offset[3 * 3 + 1] / view.model.size; })()")
          .get<double>();
  EXPECT_NEAR(moved, 0.3 * 0.5, 1e-6) << "rounding to seven digits";
  EXPECT_EQ(browser->value("view.model.pose.offset[3 * 1 + 1]"), 0.0) << "the inner wythe stays";
  EXPECT_EQ(browser->value("view.model.ties.visible"), false);
  browser->value("view.find('[name=ties]').click()");
  EXPECT_EQ(browser->value("view.model.ties.visible"), true);
  const std::string legend = browser->value("view.find('.ties-legend').innerText");
  EXPECT_NE(legend.find("Tension, ties, kN"), std::string::npos) << legend;
  EXPECT_NE(legend.find("1.234"), std::string::npos) << legend;
  EXPECT_EQ(fmt::format("{}", fmt::join(browser->complaints(), "\n")), "");
}

TEST_F(Viewer, EveryControlWorksWithoutComplaint) {
  open_view(column_at_rest());
  const int used = browser->value(R"js((() => {
    window.URL.createObjectURL = () => "data:,";
    let used = 0;
    const fire = (element, type) => { element.dispatchEvent(new Event(type)); ++used; };
    for (const button of view.host.querySelectorAll("button")) { button.click(); ++used; }
    for (const select of view.host.querySelectorAll("select"))
      for (const option of select.options) { select.value = option.value; fire(select, "change"); }
    for (const range of view.host.querySelectorAll("input[type=range]"))
      for (const value of [range.min, range.max]) { range.value = value; fire(range, "input"); }
    for (const box of view.host.querySelectorAll("input[type=checkbox]")) { box.click(); ++used; }
    for (const key of ["ArrowLeft", "ArrowUp", "+", "-", "Home"]) view.stage.canvas.dispatchEvent(new KeyboardEvent("keydown", {key}));
    view.stage.draw();
    return used;
  })())js");
  EXPECT_GT(used, 30);
  EXPECT_EQ(fmt::format("{}", fmt::join(browser->complaints(), "\n")), "");
}

}  // namespace
}  // namespace cupola::viewer_test
