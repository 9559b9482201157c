#pragma once

#include <optional>
#include <vector>

namespace cupola {

/// A two-sided interval of 95 %.
struct ConfidenceInterval {
  double low = 0.0, high = 0.0;
  bool contains(double value) const { return low <= value && value <= high; }
};

struct IntervalEstimate {
  double value = 0.0;
  std::optional<ConfidenceInterval> interval;  ///< nothing: not known
};

/// Interval of a probability of which `hits` of `trials` independent trials, at least 1, are known (C. J.
/// Clopper, E. S. Pearson, 1934): it covers the probability in at least 95 % of all experiments.
ConfidenceInterval clopper_pearson(int hits, int trials);

/// Probability that two equally frequent outcomes differ as often as they did or more: exact two-sided test
/// of the pairs that differ (Q. McNemar, 1947). 1 without such pairs.
double mcnemar(int only_first, int only_second);

/// How the values were drawn. `replicates` equal groups that follow each other are independent; within a
/// group values may depend on each other, as those of one Latin hypercube do. 0: not known, no intervals.
struct DrawnValues {
  std::vector<double> values;  ///< NaN: a member without the value
  int replicates = 0;
};

/// Mean, with the interval of Student's t over the means of the replicates.
IntervalEstimate mean_of(const DrawnValues& drawn);

/// Quantile p in (0, 1), interpolated between the order statistics (definition 7 of R. J. Hyndman and Y. Fan,
/// 1996). The interval, that of two order statistics, which the values do not always reach: of independent
/// values by the binomial distribution, else by Student's t over the shares of the replicates below it (R. S.
/// Woodruff, 1952), because small replicates have quantiles of their own.
IntervalEstimate quantile_of(const DrawnValues& drawn, double p);

/// Standard deviation (n - 1); NaN of fewer than two values.
double deviation_of(const std::vector<double>& values);

/// How much more the first of two positive results of the same members scatters: the ratio of the standard
/// deviations of their logarithms. The interval of independent pairs allows for their correlation (E. J. G.
/// Pitman, 1939, Biometrika 31, 9-12). NaN of fewer than three pairs, without scatter or with a value <= 0.
IntervalEstimate scatter_ratio(const DrawnValues& first, const DrawnValues& second);

/// Spearman's rank correlation of two inputs of equal size, ties by mean ranks; NaN if one of them is
/// constant.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

/// First-order Sobol index of x for y from independent members: Var(E(y | x)) / Var(y), estimated by pairs of
/// neighbours in the order of x (F. Gamboa, P. Gremaud, T. Klein, A. Lagnoux, 2022, Bernoulli 28, 2345-2374,
/// eq. 5). Its standard error is about 1 / sqrt(n) where x has no influence. NaN if y is constant.
double first_order_index(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace cupola
