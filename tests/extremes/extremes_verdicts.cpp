// Cross-checks of verdicts on random models: static analysis, range, bisection and direct limit answer the
// same question.
//
//   extremes_verdicts COUNT FIRST_SEED
//
// Fails if two verdicts contradict each other, or if more static analyses than largest_undecided() are
// undecided.
//
// The direct limit of the associated law is the reference. Above it no law stands, below it the associated
// law does. Under Coulomb's law a structure may move below it, but that can not be proven.

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/program/program.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "tests/arguments.hpp"
#include "tests/extremes/limit_models.hpp"

namespace {

using namespace cupola;

constexpr double kFactors[] = {0.9, 0.99, 0.999, 1.001, 1.01, 1.1};  // of a load at its limit
constexpr double kTolerances[] = {1e-2, 1e-5, 1e-9};

constexpr double kSlow = 2.0;  // s: static analyses that take longer are printed

struct Count {
  int all = 0, undecided = 0, unproven = 0, contradictions = 0;
};

struct Table {
  std::map<std::string, std::map<double, Count>> rows;
  std::vector<std::string> contradictions;
  int models = 0, without_limit = 0;
  int proven = 0, moving = 0;  ///< motions of the associated law

  void add(const std::string& row, double factor, const std::string& model, bool undecided, bool unproven,
           bool contradicts, const std::string& message) {
    Count& count = rows[row][factor];
    ++count.all;
    count.undecided += undecided;
    count.unproven += unproven;
    count.contradictions += contradicts;
    if (contradicts) contradictions.push_back(fmt::format("{}, {} at {:g}: {}", model, row, factor, message));
    if (contradicts) fmt::print(stderr, "{}\n", contradictions.back());
  }
};

/// Value of the parameter at which the load is `factor` times the limit; friction is divided by it.
double value_at(const LimitModel& model, double limit, double factor) {
  return model.stands_above ? limit / factor : limit * factor;
}

void check_statics(const LimitModel& model, double limit, Table* table) {
  for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb})
    for (const double tolerance : kTolerances)
      for (const double factor : kFactors) {
        Case scene = case_at(model.scene.input, value_at(model, limit, factor));
        scene.analysis.type = AnalysisType::static_;
        scene.analysis.friction_law = law;
        scene.analysis.tolerance = tolerance;
        const double started = cpu_seconds();
        const Summary summary = run_static(scene, model.scene.assembly, {});
        if (const double seconds = cpu_seconds() - started; seconds > kSlow)
          fmt::print(stderr, "{}, {}, {:.0e} at {:g}: {:.1f} s; {}\n", model.name, to_string(law), tolerance,
                     factor, seconds, summary.message);
        const bool stands = summary.status == Status::stable, proven = summary.status == Status::moving;
        const bool moves = cupola::moves(summary.status);
        const bool associated = law == FrictionLaw::associated;
        const bool below = factor < 1.0;
        if (associated && !below) table->moving += 1, table->proven += proven;
        table->add(fmt::format("static,{},{:g}", to_string(law), tolerance), factor, model.name,
                   !stands && !moves, moves && !proven, below ? (associated ? moves : proven) : stands,
                   summary.message);
      }
}

/// The normal force of the first joint.
JointForce first_joint(const LimitModel& model) {
  const State rest = state_at_rest(make_model(model.scene.input, model.scene.assembly));
  const ContactSet contacts =
      ContactDetector(model.scene.assembly, detection_options(model.scene.input)).update(rest.poses);
  JointForce joint;
  joint.block_a.number = contacts.points.front().block_a;
  joint.block_b.number = contacts.points.front().block_b;
  return joint;
}

void check_range(const LimitModel& model, double limit, Table* table) {
  for (const double factor : kFactors) {
    Case scene = case_at(model.scene.input, value_at(model, limit, factor));
    scene.analysis.type = AnalysisType::range;
    scene.analysis.range.quantities = {first_joint(model)};
    const Summary summary = run_range(scene, model.scene.assembly, {}).value();
    const bool stands = summary.status == Status::stable, moves = cupola::moves(summary.status);
    table->add("range,,", factor, model.name, !stands && !moves, summary.status == Status::moving_unproven,
               factor < 1.0 ? moves : stands, summary.message);
  }
}

void check_bisection(const LimitModel& model, double limit, Table* table) {
  for (const auto law : {FrictionLaw::associated, FrictionLaw::coulomb}) {
    Case scene = model.scene.input;
    scene.analysis.friction_law = law;
    scene.analysis.limit.method = LimitSearch::Method::bisection;
    scene.analysis.limit.low = value_at(model, limit, model.stands_above ? 1.5 : 0.5);
    scene.analysis.limit.high = value_at(model, limit, model.stands_above ? 0.5 : 1.5);
    const Summary summary = run_limit(scene, model.scene.assembly, {}).value();
    bool wrong = false;
    constexpr double kReference = 1e-5;  // default width of the direct limit
    if (summary.critical) {
      const double sign = model.stands_above ? -1.0 : 1.0;
      const auto beyond = [&](double value) { return sign * (value - limit) / limit; };
      wrong = beyond(summary.critical->stable) > kReference ||
              (law == FrictionLaw::associated && beyond(summary.critical->moving) < -kReference);
    }
    table->add(fmt::format("bisection,{},", to_string(law)), 1.0, model.name, !reached(summary.status), false,
               wrong, fmt::format("limit {:.8g}; {}", limit, summary.message));
  }
}

void check(const LimitModel& model, Table* table) {
  const Summary direct = run_limit(model.scene.input, model.scene.assembly, {}).value();
  ++table->models;
  if (!direct.critical) {
    ++table->without_limit;
    fmt::print(stderr, "{}: {}\n", model.name, direct.message);
    return;
  }
  check_statics(model, direct.critical->value, table);
  check_range(model, direct.critical->value, table);
  check_bisection(model, direct.critical->value, table);
}

/// Share of the static analyses that may be undecided at a factor on the limit.
double largest_undecided(double factor) {
  const double distance = std::abs(factor - 1.0);
  return distance > 0.05 ? 0.02 : distance > 0.005 ? 0.1 : 0.5;
}

/// Comma-separated; static analyses have a largest share of undecided ones.
void print(const Table& table) {
  fmt::print(stderr,
             "{} models, {} of them without a limit. {} of {} motions under the associated law are proven.\n",
             table.models, table.without_limit, table.proven, table.moving);
  fmt::print(
      "method,law,tolerance,factor on the limit,cases,undecided,allowed,motions without "
      "proof,contradictions\n");
  for (const auto& [row, counts] : table.rows)
    for (const auto& [factor, count] : counts)
      fmt::print("{},{:g},{},{},{},{},{}\n", row, factor, count.all, count.undecided,
                 row.starts_with("static")
                     ? fmt::format("{:g}", std::floor(largest_undecided(factor) * count.all))
                     : "",
                 count.unproven, count.contradictions);
}

bool decides_enough(const Table& table) {
  for (const auto& [row, counts] : table.rows)
    for (const auto& [factor, count] : counts)
      if (row.starts_with("static") && count.undecided > largest_undecided(factor) * count.all) return false;
  return true;
}

ExitCode run(int count, std::uint64_t first) {
  Table table;
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    const double started = cpu_seconds();
    const LimitModel model = limit_model(seed);
    check(model, &table);
    fmt::print(stderr, "{:12} {:3d} blocks {:7.2f} s\n", model.name, model.scene.assembly.blocks.size(),
               cpu_seconds() - started);
  }
  print(table);
  return table.contradictions.empty() && decides_enough(table) ? ExitCode::done : ExitCode::failed;
}

}  // namespace

int main(int argc, char** argv) {
  return run_program("extremes_verdicts", [&] {
    const auto arguments = read_arguments(argc, argv, 2, 2, "extremes_verdicts COUNT FIRST_SEED");
    return run(std::stoi(arguments[0]), std::stoull(arguments[1]));
  });
}
