#include <algorithm>
#include <set>

#include "assembly/case/declare.hpp"

namespace cupola {
namespace {

void declare_mean_and_deviation(Section& s, const NumberRule& rule, double* mean, double* deviation) {
  s.required_number("mean", *mean, rule, "mean of the values");
  s.required_number("deviation", *deviation, {.above = 0}, "standard deviation of the values");
}

void declare_normal(Section& s, NormalValues& v) {
  declare_mean_and_deviation(s, {}, &v.mean, &v.deviation);
}

void declare_lognormal(Section& s, LognormalValues& v) {
  declare_mean_and_deviation(s, {}, &v.mean, &v.deviation);
  s.rule(v.mean > 0.0, "mean", "of a lognormal distribution must be > 0");
}

void declare_ends(Section& s, double* from, double* to) {
  s.required_number("from", *from, {}, "smallest value");
  s.required_number("to", *to, {}, "largest value");
  s.rule(*from < *to, "to", "must be greater than from");
}

void declare_uniform(Section& s, UniformValues& v) {
  declare_ends(s, &v.from, &v.to);
}

void declare_triangular(Section& s, TriangularValues& v) {
  declare_ends(s, &v.from, &v.to);
  s.required_number("mode", v.mode, {}, "most probable value");
  s.rule(v.from <= v.mode && v.mode <= v.to, "mode", "must lie between from and to");
}

void declare_table_of_values(Section& s, TableOfValues& v) {
  s.texts("values", v.values, "values of which each member takes one");
  s.numbers("weights", v.weights, {.above = 0}, "relative frequency of each value; without it all are equal");
  s.rule(!v.values.empty(), "values", "must hold at least one value");
  s.rule(v.weights.empty() || v.weights.size() == v.values.size(), "weights", "must be one per value");
}

void declare_seed(Section&, SeedValues&) {}

void declare_varied_key(Section& s, VariedKey& varied) {
  s.text("key", varied.key, "path of a key of this case, as written after --set");
  s.rule(!varied.key.empty(), "key", "must be given");
  s.variant<Distribution>(
      "distribution", varied.distribution,
      {alternative<Distribution>("normal", "normal distribution", declare_normal),
       alternative<Distribution>("lognormal", "lognormal distribution", declare_lognormal),
       alternative<Distribution>("uniform", "all values between two", declare_uniform),
       alternative<Distribution>("triangular", "triangular density", declare_triangular),
       alternative<Distribution>("table", "one of several values", declare_table_of_values),
       alternative<Distribution>("seed", "a whole number for each member", declare_seed)},
      "how the values are distributed");
}

void declare_kept_files(Section& s, KeptFiles& keep) {
  s.choice("keep", keep, "files of a finished member: summary.json only; also tables; all, with a report");
}

}  // namespace

void declare_sample_file(Section& s, SampleFile& samples) {
  s.file("file", samples.file, "CSV file: a line of key paths, then the values of one member per line");
  s.rule(!samples.file.empty(), "file", "must be given");
  declare_kept_files(s, samples.keep);
}

void declare_ensemble(Section& s, Ensemble& ensemble) {
  s.required_integer("members", ensemble.members, {.min = 2, .max = 100000}, "number of members");
  s.integer("seed", ensemble.seed, {.min = 0},
            "seed of the random numbers; the same for bonds to be compared");
  s.choice(
      "design", ensemble.design,
      "monte_carlo: independent members, for probabilities; latin_hypercube: ten hypercubes, for means and "
      "quantiles");
  declare_kept_files(s, ensemble.keep);
  s.list("vary", ensemble.vary, "keys and the distributions of their values", declare_varied_key);
  s.rule(!ensemble.vary.empty(), "vary", "must name at least one key");
  std::set<std::string> keys;
  s.rule(std::ranges::all_of(ensemble.vary, [&](const VariedKey& v) { return keys.insert(v.key).second; }),
         "vary", "names a key twice");
  const bool hypercube = ensemble.design == Ensemble::Design::latin_hypercube;
  s.rule(!hypercube ||
             (ensemble.members >= 2 * Ensemble::kReplicates && ensemble.members % Ensemble::kReplicates == 0),
         "members",
         "of a latin_hypercube must be a multiple of 10, at least 20: ten hypercubes give the intervals");
}

}  // namespace cupola
