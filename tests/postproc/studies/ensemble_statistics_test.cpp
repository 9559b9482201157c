// Statistics of ensembles against closed forms and published values.
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/studies/ensemble.hpp"
#include "postproc/studies/ensemble_results.hpp"
#include "postproc/studies/saltelli.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::ensemble_statistics_test {
namespace {

// Without a hit the high end is 1 - 0.025^(1/n). 5 of 20: Clopper and Pearson's interval as tabulated, 0.0866
// to 0.4910.
TEST(EnsembleStatistics, IntervalsOfProbabilities) {
  EXPECT_EQ(clopper_pearson(0, 10).low, 0.0);
  EXPECT_NEAR(clopper_pearson(0, 10).high, 1.0 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_NEAR(clopper_pearson(10, 10).low, std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(clopper_pearson(10, 10).high, 1.0);
  EXPECT_NEAR(clopper_pearson(5, 20).low, 0.0866, 5e-5);
  EXPECT_NEAR(clopper_pearson(5, 20).high, 0.4910, 5e-5);
}

// A block on an incline of slope 0.5 slides where its lognormal friction is less. The exact probability lies
// in at least 181 of 200 intervals: with a coverage of 95 % fewer are as improbable as 4e-3, and the coverage
// of Clopper and Pearson is more.
TEST(EnsembleStatistics, IntervalsCoverTheExactProbability) {
  const double mean = 0.6, deviation = 0.1, slope = 0.5;
  const double s2 = std::log1p(std::pow(deviation / mean, 2));
  const double exact = 0.5 * std::erfc(-(std::log(slope / mean) + 0.5 * s2) / std::sqrt(2.0 * s2));
  int covered = 0;
  for (int seed = 1; seed <= 200; ++seed) {
    const Samples samples = draw_samples({100,
                                          seed,
                                          Ensemble::Design::monte_carlo,
                                          KeptFiles::summary,
                                          {{"joints.friction", LognormalValues{mean, deviation}}}});
    int slides = 0;
    for (const auto& row : samples.rows) slides += std::stod(row[0]) < slope;
    covered += clopper_pearson(slides, 100).contains(exact);
  }
  EXPECT_GE(covered, 181);
}

// Of six pairs that differ, one is the other way round: 2 (1 + 6) / 2^6.
TEST(EnsembleStatistics, TestOfPairs) {
  EXPECT_DOUBLE_EQ(mcnemar(1, 5), 14.0 / 64.0);
  EXPECT_DOUBLE_EQ(mcnemar(5, 1), 14.0 / 64.0);
  EXPECT_EQ(mcnemar(0, 0), 1.0);
  EXPECT_EQ(mcnemar(3, 3), 1.0);
}

// t(0.975, 4) = 2.776445; the median of ten values lies between the second and the ninth with 97.9 %.
TEST(EnsembleStatistics, MeansAndQuantiles) {
  const IntervalEstimate mean = mean_of({{1, 2, 3, 4, 5}, 5});
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.interval->high, 3.0 + 2.776445 * std::sqrt(2.5 / 5.0), 1e-6);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_DOUBLE_EQ(mean_of({{1, nan, 3}, 3}).value, 2.0);
  EXPECT_FALSE(mean_of({{1, 2, 3}, 0}).interval) << "not known how they were drawn";
  // Two replicates with the means 2 and 4: t(0.975, 1) = 12.7062, standard error 1.
  EXPECT_NEAR(mean_of({{1, 3, 2, 6}, 2}).interval->high, 3.0 + 12.7062, 1e-4);
  const IntervalEstimate median = quantile_of({{10, 9, 8, 7, 6, 5, 4, 3, 2, 1}, 10}, 0.5);
  EXPECT_DOUBLE_EQ(median.value, 5.5);
  EXPECT_DOUBLE_EQ(median.interval->low, 2.0);
  EXPECT_DOUBLE_EQ(median.interval->high, 9.0);
  EXPECT_FALSE(quantile_of({{1, 2, 3}, 3}, 0.05).interval) << "too few values lie beyond it";
}

// 200 experiments of ten hypercubes of ten members with one input: the quantiles of a uniform value lie in at
// least 181 intervals, as above. The least value of a hypercube is at 5 % on average, its interpolated
// quantile at 9 %.
TEST(EnsembleStatistics, IntervalsCoverTheQuantilesOfHypercubes) {
  for (const double p : {0.05, 0.5, 0.95}) {
    int covered = 0;
    for (int seed = 1; seed <= 200; ++seed) {
      const Samples samples = draw_samples({100,
                                            seed,
                                            Ensemble::Design::latin_hypercube,
                                            KeptFiles::summary,
                                            {{"joints.friction", UniformValues{0.0, 1.0}}}});
      DrawnValues drawn{{}, 10};
      for (const auto& row : samples.rows) drawn.values.push_back(std::stod(row[0]));
      const IntervalEstimate quantile = quantile_of(drawn, p);
      covered +=
          quantile.interval && quantile.interval->contains(p) && quantile.interval->contains(quantile.value);
    }
    EXPECT_GE(covered, 181) << p;
  }
}

// b = a^2 scatters twice as much with certainty. Four pairs by hand: logarithms 0, 1, 2, 3 and 0, 2, 1, 3 have
// equal deviations and a correlation of 0.8, and t(0.975, 2) = 4.302653: k = 1 + 0.36 * 18.5128 = 7.664616.
TEST(EnsembleStatistics, RatioOfScatter) {
  const IntervalEstimate twice = scatter_ratio({{1, 16, 4, 9}, 4}, {{1, 4, 2, 3}, 4});
  EXPECT_NEAR(twice.value, 2.0, 1e-14);
  EXPECT_NEAR(twice.interval->low, 2.0, 1e-6) << "1 - r^2 is rounding, of which the interval has the root";
  const double e = std::numbers::e;
  const std::vector<double> a = {1, e, e * e, e * e * e}, b = {1, e * e, e, e * e * e};
  const IntervalEstimate even = scatter_ratio({a, 4}, {b, 4});
  EXPECT_NEAR(even.value, 1.0, 1e-14);
  EXPECT_NEAR(even.interval->high, std::sqrt(7.664616 + std::sqrt(7.664616 * 7.664616 - 1.0)), 1e-6);
  EXPECT_NEAR(even.interval->low * even.interval->high, 1.0, 1e-12);
  EXPECT_FALSE(scatter_ratio({a, 2}, {b, 2}).interval) << "members of a group depend on each other";
  EXPECT_TRUE(std::isnan(scatter_ratio({{1, -2, 3}, 3}, {{1, 2, 3}, 3}).value));
}

// 200 experiments with 30 pairs of equal scatter and a correlation of 0.6: the ratio 1 lies in at least 181
// intervals, as above.
TEST(EnsembleStatistics, IntervalsCoverTheRatioOfScatter) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int covered = 0;
  for (int experiment = 0; experiment < 200; ++experiment) {
    DrawnValues a{{}, 30}, b{{}, 30};
    for (int i = 0; i < 30; ++i) {
      const double x = normal(random);
      a.values.push_back(std::exp(0.1 * x));
      b.values.push_back(std::exp(0.1 * (0.6 * x + 0.8 * normal(random))));
    }
    covered += scatter_ratio(a, b).interval->contains(1.0);
  }
  EXPECT_GE(covered, 181);
}

TEST(EnsembleStatistics, RankCorrelation) {
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}), 1.0);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, 4}, {4, 3, 2, 1}), -1.0);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 2, 3}, {1, 2, 2, 3}), 1.0) << "ties";
  EXPECT_TRUE(std::isnan(rank_correlation({1, 1, 1}, {1, 2, 3})));
}

// Ishigami's function sin x + 7 sin^2 y + 0.1 z^4 sin x on [-pi, pi]^3 has the first-order indices 0.3139,
// 0.4424 and 0 (T. Ishigami and T. Homma, 1990). The tolerance is four standard errors, 1 / sqrt(n) each.
TEST(EnsembleStatistics, FirstOrderIndicesOfIshigamisFunction) {
  constexpr int kMembers = 10000;
  std::mt19937_64 engine(1);
  std::vector<std::vector<double>> x(3);
  std::vector<double> y;
  for (int i = 0; i < kMembers; ++i) {
    for (auto& column : x)
      column.push_back(std::numbers::pi * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0));
    y.push_back(std::sin(x[0].back()) + 7.0 * std::pow(std::sin(x[1].back()), 2) +
                0.1 * std::pow(x[2].back(), 4) * std::sin(x[0].back()));
  }
  const double tolerance = 4.0 / std::sqrt(kMembers);
  EXPECT_NEAR(first_order_index(x[0], y), 0.3139, tolerance);
  EXPECT_NEAR(first_order_index(x[1], y), 0.4424, tolerance);
  EXPECT_NEAR(first_order_index(x[2], y), 0.0, tolerance);
}

double ishigami(const std::vector<double>& x) {
  return std::sin(x[0]) + 7.0 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
}

/// Samples of Ishigami's function as SALib writes them (`blocks`: all A, all B, ...), and its values.
Samples ishigami_design(size_t pairs, bool blocks, std::vector<double>* y) {
  std::mt19937_64 engine(2);
  const auto draw = [&engine] {
    std::vector<double> x;
    for (int i = 0; i < 3; ++i)
      x.push_back(std::numbers::pi * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0));
    return x;
  };
  std::vector<std::vector<double>> rows(5 * pairs);
  for (size_t j = 0; j < pairs; ++j) {
    const std::vector<double> a = draw(), b = draw();
    const auto row = [&](size_t salib, size_t block) -> std::vector<double>& {
      return rows[blocks ? block * pairs + j : 5 * j + salib];
    };
    row(0, 0) = a;
    row(4, 1) = b;
    for (size_t i = 0; i < 3; ++i) {
      row(1 + i, 2 + i) = a;
      row(1 + i, 2 + i)[i] = b[i];
    }
  }
  Samples samples{{"x", "y", "z"}, {}};
  for (const auto& row : rows) {
    samples.rows.emplace_back();
    for (const double x : row) samples.rows.back().push_back(fmt::format("{}", x));
    y->push_back(ishigami(row));
  }
  return samples;
}

// The total indices are 0.5576, 0.4424 and 0.2437 (T. Ishigami and T. Homma, 1990): z acts together with x
// only. With 4000 pairs the intervals of 95 % hold them and are narrower than 0.1.
TEST(EnsembleStatistics, TotalIndicesOfIshigamisFunction) {
  const double first[] = {0.3139, 0.4424, 0.0}, total[] = {0.5576, 0.4424, 0.2437};
  for (const bool blocks : {false, true}) {
    std::vector<double> y;
    const Samples samples = ishigami_design(4000, blocks, &y);
    const auto design = saltelli_design(samples);
    ASSERT_TRUE(design);
    for (size_t i = 0; i < 3; ++i) {
      const SobolIndices indices = sobol_indices(*design, i, y);
      EXPECT_TRUE(indices.first_order.interval->contains(first[i])) << i << " " << indices.first_order.value;
      EXPECT_TRUE(indices.total.interval->contains(total[i])) << i << " " << indices.total.value;
      EXPECT_NEAR(indices.first_order.value, first[i], 0.05);
      EXPECT_NEAR(indices.total.value, total[i], 0.05);
    }
  }
  std::vector<double> y;
  Samples other = ishigami_design(4, false, &y);
  std::swap(other.rows[1], other.rows[2]);
  EXPECT_FALSE(saltelli_design(other)) << "one member is not where the design has it";
}

// Every fourth row of two weights by an even number of thicknesses is an A, of the first weight, and the last
// of each four its B, of the second: no samples of the same inputs. A column of two texts drawn at random is.
TEST(EnsembleStatistics, AllCombinationsAreNoSaltelliDesign) {
  Samples all{{"weight", "thickness"}, {}};
  for (const char* thickness : {"0.6", "0.7", "0.8", "0.9"})
    for (const char* weight : {"1", "2"}) all.rows.push_back({weight, thickness});
  EXPECT_FALSE(saltelli_design(all));
  const Samples drawn{{"bond", "thickness"},
                      {{"a", "0.6"},
                       {"b", "0.6"},
                       {"a", "0.7"},
                       {"b", "0.7"},
                       {"b", "0.8"},
                       {"a", "0.8"},
                       {"b", "0.9"},
                       {"a", "0.9"}}};
  EXPECT_TRUE(saltelli_design(drawn));
}

}  // namespace
}  // namespace cupola::ensemble_statistics_test
