// The bytes of the 3-D view, decoded independently of scene.js.

#include "postproc/viewer/scene.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

#include "postproc/tables/result_columns.hpp"
#include "postproc/viewer/packed_arrays.hpp"
#include "postproc/viewer/packed_text.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::scene_test {
namespace {

using nlohmann::json;

/// The elements of an array as the format describes them: planes of bytes, zigzag code, differences, step,
/// origin.
std::vector<double> decoded(const std::string& bytes, const std::string& name) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), 4);
  const json array = json::parse(bytes.substr(4, length)).at("arrays").at(name);
  const std::string type = array.at("type");
  const size_t count = array.at("count"), size = type == "u8" ? 1 : type == "f64" ? 8 : 4;
  const char* start = bytes.data() + 4 + length + array.at("start").get<size_t>();
  std::vector<double> out;
  for (size_t i = 0; i < count; ++i) {
    char element[8] = {};
    for (size_t k = 0; k < size; ++k) element[k] = start[k * count + i];
    double number = 0.0;
    std::uint32_t code = 0;
    float single = 0.0f;
    std::memcpy(&number, element, 8);
    std::memcpy(&code, element, 4);
    std::memcpy(&single, element, 4);
    if (type == "i32") {
      number = code % 2 == 0 ? code / 2 : -1.0 - code / 2;
      const size_t delta = array.at("delta");
      if (delta > 0 && i >= delta) number += out[i - delta];
    } else if (type != "f64") {
      number = type == "u8" ? static_cast<unsigned char>(element[0]) : single;
    }
    out.push_back(number);
  }
  if (array.contains("step"))
    for (size_t i = 0; i < count; ++i)
      out[i] = out[i] * array["step"].get<double>() +
               (array.contains("origin") ? array["origin"][i % 3].get<double>() : 0);
  return out;
}

TEST(PackedArrays, IntegersReturnExactly) {
  const std::vector<int> values{0, 1, -1, 2, 1 << 30, -(1 << 30), 7};
  for (const int delta : {0, 1, 3}) {
    PackedArrays arrays;
    arrays.add("first", std::vector<std::uint8_t>{1, 2, 255});
    arrays.add("values", values, delta);
    const std::vector<double> out = decoded(arrays.bytes(json::object()), "values");
    EXPECT_EQ(out, std::vector<double>(values.begin(), values.end())) << delta;
  }
}

TEST(PackedArrays, DoublesReturnBitByBit) {
  const std::vector<double> values{0.1, -0.0, 1e-300, std::numeric_limits<double>::infinity(), 1.0 / 3.0};
  PackedArrays arrays;
  arrays.add("values", values);
  const std::vector<double> out = decoded(arrays.bytes(json::object()), "values");
  ASSERT_EQ(out.size(), values.size());
  EXPECT_EQ(std::memcmp(out.data(), values.data(), 8 * values.size()), 0);
}

TEST(PackedArrays, MultiplesAreHalfAStepOffAtMost) {
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back(std::sin(0.7 * i) * i);
  values.push_back(std::numeric_limits<double>::quiet_NaN());  // shown as zero
  values.push_back(1e12);                                      // beyond the range: its end
  PackedArrays arrays;
  arrays.add_multiples("values", values, 1e-3, 3);
  const std::vector<double> out = decoded(arrays.bytes(json::object()), "values");
  for (size_t i = 0; i < 200; ++i)
    EXPECT_NEAR(out[i], values[i], 0.5e-3 * (1.0 + 1e-9));  // and rounding of the product
  EXPECT_EQ(out[200], 0.0);
  EXPECT_NEAR(out[201], 1e-3 * (1 << 29), 1e-6);
}

TEST(PackedArrays, DeflatedBytesAreThoseOfZlib) {
  const std::string text(100'000, 'x'), packed = deflated(text);
  EXPECT_LT(packed.size(), 500u);
  std::string out(text.size(), '\0');
  libdeflate_decompressor* inflate = libdeflate_alloc_decompressor();
  ASSERT_EQ(
      libdeflate_zlib_decompress(inflate, packed.data(), packed.size(), out.data(), out.size(), nullptr),
      LIBDEFLATE_SUCCESS);
  libdeflate_free_decompressor(inflate);
  EXPECT_EQ(out, text);
}

std::string column_scene(const Evaluation& e) {
  Film film(e);
  film.add(0, e.last);
  return scene_bytes(e, film);
}

TEST(Scene, VerticesAreAsNearAsItSays) {
  const Evaluation e = test::column_evaluation(0.6, 0.4);
  const std::vector<double> out = decoded(column_scene(e), "vertices");
  ASSERT_EQ(out.size(), 3 * e.assembly.vertices.size());
  const double stated = 1e-3 * largest_rounding_mm(e);
  EXPECT_LE(stated, 1e-4);
  double worst = 0.0;
  for (size_t v = 0; v < e.assembly.vertices.size(); ++v)
    worst = std::max(worst, (Vec3(&out[3 * v]) - e.assembly.vertices[v]).norm());
  EXPECT_LE(worst, stated * (1.0 + 1e-9));
}

// A model of 60 m needs steps of 0.1 mm, one of 10 mm steps of a 65,535th of its size.
TEST(Scene, RoundsByATenthOfAMillimetreAtMostWhateverTheSize) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  const double size = e.assembly.vertices.back().cwiseAbs().maxCoeff();
  for (const double target : {60.0, 0.01}) {
    Evaluation scaled = e;
    for (Vec3& v : scaled.assembly.vertices) v *= target / size;
    EXPECT_LE(largest_rounding_mm(scaled), 0.1);
    EXPECT_LE(1e-3 * largest_rounding_mm(scaled), 2e-5 * target);  // sqrt(3)/2 of a 65,535th
  }
}

TEST(Scene, HoldsTheDoublesOfTheTables) {
  const Evaluation e = test::column_evaluation(0.5, 0.3);
  const std::string bytes = column_scene(e);
  const auto& joints = e.last.joints.wrenches;
  const std::vector<double> normal = decoded(bytes, "state0.normal_force_N");
  const std::vector<double> force_z = decoded(bytes, "state0.force_z_N");
  ASSERT_EQ(normal.size(), joints.size());
  for (size_t j = 0; j < joints.size(); ++j) {
    EXPECT_EQ(normal[j], joints[j].normal_force);
    EXPECT_EQ(force_z[j], joints[j].wrench.force.z());
  }
}

// A rod under thrust, which is a tie and a strut, and a tie.
TEST(Scene, HoldsOneTensionPerRodThrustNegative) {
  Evaluation e = test::column_evaluation(0.5, 0.3);
  TieTable& ties = e.last.frame.ties;
  ties.chain = {-1, -1, -1};
  ties.block_a = {0, 0, 0};
  ties.block_b = {1, 1, 2};
  ties.point_a = {Vec3::Zero(), Vec3::Zero(), Vec3::UnitX()};
  ties.point_b = {Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()};
  ties.force = {0.0, 1183.0, 500.0};
  ties.yield_force.assign(3, std::numeric_limits<double>::infinity());
  ties.yielded.assign(3, 0.0);
  ties.strut = {0, 1, 0};
  const std::string bytes = column_scene(e);
  EXPECT_EQ(decoded(bytes, "tie.force"), (std::vector<double>{-1183.0, 500.0}));
  EXPECT_EQ(decoded(bytes, "ties").size(), 12u);
}

// The joint of blocks 1 and 2 may carry 1 to 3 MN: a range of 2 MN about 2 MN. The others have no range.
TEST(Scene, HoldsTheCertaintyOfTheJoints) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  ForceRange range{"normal force of joint 1-2", "N", {}, {}, {}};
  range.min = {RangeOutcome::bounded, 1e6, {}, {}};
  range.max = {RangeOutcome::bounded, 3e6, {}, {}};
  range.joint = {1, 2};
  e.summary.ranges = {range};
  const std::string bytes = scene_bytes(e, Film(e));
  const std::vector<double> certainty = decoded(bytes, "state0.relative_range");
  ASSERT_EQ(certainty.size(), 3u);
  for (size_t j = 0; j < 3; ++j) {
    if (e.last.joints.wrenches[j].block_a == 1)
      EXPECT_EQ(certainty[j], 1.0);
    else
      EXPECT_TRUE(std::isnan(certainty[j]));
  }
}

TEST(Scene, SaysNothingOfForcesWithoutAnEquilibrium) {
  Evaluation e = test::column_evaluation(0.5, 0.3);
  e.last.frame.role = FrameRole::unconverged;
  const std::string bytes = column_scene(e);
  EXPECT_EQ(bytes.find("normal_force_N\":{"), std::string::npos);
  EXPECT_NE(bytes.find("Forces are not drawn: no equilibrium was found."), std::string::npos);
  e.last.frame.role = FrameRole::mechanism;
  EXPECT_NE(column_scene(e).find("those of a moving structure last an instant"), std::string::npos);
}

TEST(Film, LeavesOutFramesOfLongRunsAndSaysSo) {
  Evaluation e = test::column_evaluation(0.5, 0.3);
  e.last.frame.role = FrameRole::step;
  e.times.clear();
  for (int i = 0; i < 600'000; ++i) e.times.push_back(1e-3 * i);
  FrameEvaluation frame = e.last;
  e.last_frame = 599'999;
  Film film(e);
  for (size_t i = 0; i < 10; ++i) {
    frame.frame.time = e.times[i];
    film.add(i, frame);
  }
  EXPECT_EQ(film.num_frames(), 4);  // 600,000 frames of 4 blocks: every third
  EXPECT_EQ(film.skipped(), 6);
  EXPECT_EQ(film.evaluated(), -1);
  EXPECT_NE(scene_bytes(e, film).find("The film shows 4 of 10 frames."), std::string::npos);
}

// Of an open course (time 0.5: half of course 1) those blocks are laid that have contacts.
TEST(Film, ShowsTheBlocksOfAnOpenCourseFromTheFrameInWhichTheyAreLaid) {
  Evaluation e = test::column_evaluation(0.5, 0.3);
  e.last.frame.role = FrameRole::stage;
  e.times = {0.0, 0.5, 1.0, 2.0};
  ContactTable& contacts = e.last.frame.contacts;
  contacts = {};
  Film film(e);
  for (size_t i = 0; i < e.times.size(); ++i) {
    FrameEvaluation frame = e.last;
    frame.frame.time = e.times[i];
    film.add(i, frame);
  }
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const int ring = e.assembly.blocks[b].ring;
    EXPECT_EQ(film.born()[b], ring <= 0 ? 0 : ring == 1 ? 2 : 3) << "without contacts, block " << b;
  }
  Film open(e);
  FrameEvaluation frame = e.last;
  frame.frame.time = 0.5;
  frame.frame.contacts.block_a = {1};
  frame.frame.contacts.block_b = {2};
  frame.frame.contacts.joint = {0};
  open.add(0, frame);
  EXPECT_EQ(e.assembly.blocks[2].ring, 1);
  EXPECT_EQ(open.born()[2], 0);
  EXPECT_GT(open.born()[3], 0);
}

// The rings of an arch rise from both springings: the third and last is laid with the first.
TEST(Film, ShowsBothHaunchesOfAnArchFromTheFirstStage) {
  Evaluation e = test::column_evaluation(0.5, 0.3);
  e.assembly.sheets = {{.name = "arch", .num_rings = 3, .thrust_lines = Sheet::ThrustLines::one}};
  e.last.frame.role = FrameRole::stage;
  e.last.frame.contacts = {};
  e.times = {0.0, 1.0};
  Film film(e);
  for (size_t i = 0; i < e.times.size(); ++i) {
    FrameEvaluation frame = e.last;
    frame.frame.time = e.times[i];
    film.add(i, frame);
  }
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    EXPECT_EQ(film.born()[b], e.assembly.blocks[b].ring == 1 ? 1 : 0) << "block " << b;
}

}  // namespace
}  // namespace cupola::scene_test
