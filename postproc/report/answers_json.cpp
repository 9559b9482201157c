#include <nlohmann/json.hpp>

#include "postproc/report/answers.hpp"

namespace cupola {
namespace {

nlohmann::ordered_json to_json(const KeyNumber& number) {
  return {{"name", number.name}, {"value", number.value}, {"details", number.details}};
}

nlohmann::ordered_json to_json(const std::optional<KeyNumber>& number) {
  return number ? to_json(*number) : nlohmann::ordered_json();
}

}  // namespace

std::string answers_json(const Evaluation& e) {
  const VerdictWords verdict = verdict_words(e);
  const nlohmann::ordered_json json{
      {"verdict",
       {{"words", verdict.words},
        {"stands", verdict.good ? "yes" : "no"},
        {"reason", reason_for_verdict(e)}}},
      {"margin", to_json(margin_answer(e))},
      {"thrust", to_json(thrust_answer(e))},
      {"crack", to_json(crack_answer(e))},
      {"certain", certain_sentence(e)},
  };
  return json.dump(2) + "\n";
}

}  // namespace cupola
