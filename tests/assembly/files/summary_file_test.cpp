#include "assembly/files/summary_file.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "tests/assembly/files/example_summary.hpp"

namespace cupola::summary_file_test {
namespace {

using test::example_summary;

TEST(SummaryJson, RoundTripsExactly) {
  const Summary s = example_summary();
  const std::string text = to_json(s);
  const Summary back = summary_from_json(text, "summary.json");
  EXPECT_EQ(to_json(back), text);
  EXPECT_EQ(back.status, s.status);
  EXPECT_EQ(back.message, s.message);
  EXPECT_EQ(back.weight_N, s.weight_N);
  EXPECT_EQ(back.applied_load_N, s.applied_load_N);
  EXPECT_EQ(back.accuracy.quantity, s.accuracy.quantity);
  EXPECT_EQ(back.accuracy.norm, s.accuracy.norm);
  EXPECT_EQ(back.accuracy.asked, s.accuracy.asked);
  EXPECT_EQ(back.accuracy.reached, s.accuracy.reached);
  EXPECT_EQ(back.accuracy.worst_over_run, s.accuracy.worst_over_run);
  EXPECT_EQ(back.certified_force_error.value, s.certified_force_error.value);
  EXPECT_EQ(back.certified_force_error.bounds, s.certified_force_error.bounds);
  EXPECT_EQ(back.forces_unique.value, s.forces_unique.value);
  EXPECT_EQ(back.forces_unique.reason, s.forces_unique.reason);
  EXPECT_EQ(back.contact_law_residual, s.contact_law_residual);
  ASSERT_TRUE(back.largest_law_violation);
  EXPECT_EQ(back.largest_law_violation->value, 0.88);
  EXPECT_EQ(back.largest_law_violation->joint, 3);
  EXPECT_EQ(back.largest_law_violation->block_b, 17);
  EXPECT_EQ(back.largest_law_violation->time, 0.25);
  ASSERT_TRUE(back.worst_steps && back.worst_steps->momentum_residual &&
              back.worst_steps->certified_force_error);
  EXPECT_EQ(back.worst_steps->momentum_residual->step, 7);
  EXPECT_EQ(back.worst_steps->certified_force_error->time, 0.09);
  EXPECT_FALSE(back.worst_steps->contact_law_residual);
  EXPECT_FALSE(back.max_speed_m_per_s);
  EXPECT_EQ(text.find("max_speed_m_per_s"), std::string::npos);
  EXPECT_EQ(back.peak_memory_bytes, s.peak_memory_bytes);
}

TEST(SummaryJson, WritesNotCertifiedAndNull) {
  Summary s = example_summary();
  s.certified_force_error = {{}, "Coulomb's law has no duality gap"};
  s.momentum_residual = std::numeric_limits<double>::infinity();
  const std::string text = to_json(s);
  EXPECT_NE(text.find("\"not_certified\": \"Coulomb's law has no duality gap\""), std::string::npos);
  EXPECT_NE(text.find("\"momentum_residual\": null"), std::string::npos);
  const Summary back = summary_from_json(text, "summary.json");
  EXPECT_FALSE(back.certified_force_error.value);
  EXPECT_EQ(back.certified_force_error.bounds, s.certified_force_error.bounds);
  EXPECT_TRUE(std::isnan(back.momentum_residual.value()));
}

TEST(SummaryJson, RangesRoundTrip) {
  Summary s = example_summary();
  s.analysis = AnalysisType::range;
  s.ranges = {{"thrust",
               "N",
               {RangeOutcome::bounded, 1.0 / 3.0, 0.3333, 1},
               {RangeOutcome::unbounded, {}, {}, 2},
               0.7},
              {"force of tie 0", "N", {}, {}, {}}};
  const std::string text = to_json(s);
  const Summary back = summary_from_json(text, "summary.json");
  EXPECT_EQ(to_json(back), text);
  ASSERT_EQ(back.ranges.size(), 2u);
  EXPECT_EQ(back.ranges[0].quantity, "thrust");
  EXPECT_EQ(back.ranges[0].min.value, 1.0 / 3.0);
  EXPECT_EQ(back.ranges[0].min.bound, 0.3333);
  EXPECT_EQ(back.ranges[0].max.outcome, RangeOutcome::unbounded);
  EXPECT_FALSE(back.ranges[0].max.value);
  EXPECT_EQ(back.ranges[0].max.frame, 2);
  EXPECT_EQ(back.ranges[0].chosen, 0.7);
  EXPECT_EQ(back.ranges[1].max.outcome, RangeOutcome::unconverged);
  std::string damaged = text;
  damaged.replace(damaged.find("\"min\""), 5, "\"low\"");
  EXPECT_THROW(summary_from_json(damaged, "summary.json"), InputError);
}

TEST(SummaryJson, WhatASearchFoundRoundTrips) {
  Summary s = example_summary();
  EXPECT_EQ(to_json(s).find("sought"), std::string::npos) << "as of earlier versions, which are read above";
  s.sought = Sought{"critical friction", "no limit above 0.15", "it stands", "widen it", "it moves at 2"};
  const Summary back = summary_from_json(to_json(s), "summary.json");
  ASSERT_TRUE(back.sought);
  EXPECT_EQ(back.sought->quantity, "critical friction");
  EXPECT_EQ(back.sought->found, "no limit above 0.15");
  EXPECT_EQ(clauses(*back.sought), "it stands; widen it; it moves at 2");
}

TEST(SummaryJson, ErrorsNameTheKey) {
  const std::string good = to_json(example_summary());
  const auto error_of = [](const std::string& text) -> std::string {
    try {
      summary_from_json(text, "r/summary.json");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto with = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(error_of(good.substr(0, good.size() / 2)),
            "r/summary.json: error: is not a complete JSON object: damaged, or not a summary");
  EXPECT_EQ(error_of("[1]"),
            "r/summary.json: error: is not a complete JSON object: damaged, or not a summary");
  EXPECT_EQ(error_of(with("\"format_version\": 3", "\"format_version\": 9")),
            "r/summary.json: error: has format_version 9, this program reads versions 2 to 3; run "
            "cupola-solve again");
  EXPECT_EQ(error_of(with("\"format_version\": 3", "\"format_version\": 1")),
            "r/summary.json: error: has format_version 1, this program reads versions 2 to 3; run "
            "cupola-solve again");
  EXPECT_NE(error_of(with("\"norm\"", "\"name\"")).find("r/summary.json: error: accuracy = {"),
            std::string::npos);
  EXPECT_EQ(error_of(with("\"weight_N\"", "\"weight\"")), "r/summary.json: error: key `weight_N` is missing");
  EXPECT_EQ(error_of(with("\"moving\"", "\"dancing\"")),
            "r/summary.json: error: status = \"dancing\": has the wrong type or an unknown value");
  EXPECT_EQ(error_of(with("\"blocks\": 3", "\"blocks\": \"3\"")),
            "r/summary.json: error: blocks = \"3\": has the wrong type or an unknown value");
  for (const std::string count : {"3.5", "1e+85", "4294967299", "-4294967293", "18446744073709551615"})
    EXPECT_EQ(error_of(with("\"blocks\": 3", "\"blocks\": " + count)),
              "r/summary.json: error: blocks = " + count + ": has the wrong type or an unknown value");
}

}  // namespace
}  // namespace cupola::summary_file_test
