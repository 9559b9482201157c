#include "postproc/claims/verdict.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/model/status.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {
namespace {

std::string listed(const std::set<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " "));
}

/// The quantity of its run number `i` alone; unchanged if it names a single run.
Quantity of_run(const Quantity& quantity, size_t i) {
  Quantity one = quantity;
  if (quantity.runs.size() > 1) one.runs = {quantity.runs[i]};
  return one;
}

std::vector<double> claimed_numbers(const Claim& claim, RunCache& cache) {
  std::vector<double> numbers;
  const size_t count = claim.each_run ? claim.value.runs.size() : 1;
  for (size_t i = 0; i < count; ++i) {
    const auto value_of = [&](const Quantity& quantity) {
      return evaluate(claim.each_run ? of_run(quantity, i) : quantity, cache);
    };
    double number = value_of(claim.value);
    if (claim.over) number /= value_of(*claim.over);
    if (claim.minus) number -= evaluate(*claim.minus, cache);
    numbers.push_back(number);
  }
  return numbers;
}

bool is_within(const ClaimLimits& limits, double number) {
  return (!limits.at_least || number >= *limits.at_least) &&
         (!limits.at_most || number <= *limits.at_most);  // false for NaN
}

/// The text that replaces a placeholder of the note.
std::string placeholder_text(const std::string& name, const Claim& claim, double number, RunCache& cache) {
  if (name == "value") return to_display(number);
  if (name == "over") return to_display(evaluate(*claim.over, cache));
  if (name == "minus") return to_display(evaluate(*claim.minus, cache));
  if (name == "message") return cache.run(claim.value.runs.front()).message();
  for (const NamedQuantity& also : claim.also)
    if (also.name == name)
      return to_display(evaluate(also.value, cache) / (also.over ? evaluate(*also.over, cache) : 1.0));
  throw InputError(fmt::format("claims: placeholder {{{}}}: has no value", name));
}

/// The note with each placeholder replaced by its value.
std::string filled_note(const Claim& claim, double number, RunCache& cache) {
  std::string note = claim.note;
  for (const std::string& name : placeholders(claim.note))
    note.replace(note.find("{" + name + "}"), name.size() + 2, placeholder_text(name, claim, number, cache));
  return note;
}

ClaimResult evaluate(const Claim& claim, RunCache& cache) {
  std::set<std::string> missing, unsolved;
  for (const Quantity* quantity : quantities(claim))
    for (const std::string& name : runs_of(*quantity)) {
      if (!cache.finished(name))
        missing.insert(name);
      else if (missed(cache.run(name).status()))
        unsolved.insert(name);
    }
  ClaimResult result;
  if (!missing.empty()) {
    result.reason = "Not run: " + listed(missing) + ".";
    return result;
  }
  if (!unsolved.empty()) {
    result.verdict = Verdict::not_solved;
    result.reason = "Not solved: " + listed(unsolved) + ".";
    return result;
  }
  result.numbers = claimed_numbers(claim, cache);
  result.number = reduce(Take::mean, result.numbers);
  result.note = filled_note(claim, *result.number, cache);
  if (claim.open) {
    result.verdict = Verdict::open;
    return result;
  }
  const auto within = std::count_if(result.numbers.begin(), result.numbers.end(), [&claim](double number) {
    return is_within(claim.paper, number) && is_within(claim.ours, number);
  });
  const bool holds = within == static_cast<std::ptrdiff_t>(result.numbers.size());
  if (!holds && claim.each_run)
    result.reason =
        fmt::format("Within the limits in {} of {}.", within, counted(result.numbers.size(), "run"));
  if (claim.quote.empty())
    result.verdict = holds ? Verdict::holds : Verdict::does_not_hold;
  else
    result.verdict = holds ? Verdict::reproduced : Verdict::not_reproduced;
  return result;
}

}  // namespace

std::vector<ClaimResult> evaluate_claims(const std::vector<Claim>& claims, const std::string& out) {
  RunCache cache(out);
  std::vector<ClaimResult> results;
  for (const Claim& claim : claims) results.push_back(evaluate(claim, cache));
  return results;
}

}  // namespace cupola
