// What strangers have written into names, reasons and sentences makes no line and turns none, in each text that
// `godwitd ctl` shows.
#include "programs/godwitd/shown_answer.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/common/printable.hpp"
#include "programs/godwitd/operator_text.hpp"
#include "programs/godwitd/status_text.hpp"

namespace shown_answer_test {

using namespace godwit::daemon;
using nlohmann::json;

// An answer to each question, with TEXT wherever somebody else's may stand.
json answer_with(const std::string& text) {
  const json who{{"name", text}, {"role", text}, {"session", text}};
  const json row{{"at_ns", 0}, {"who", who}, {"what", text}, {"outcome", text}, {"reason", text}};
  const json point{{"number", 1}, {"class_name", text}, {"by", text}, {"reason", text}};
  return {{"ok", true},
          {"rows", {row, row}},
          {"holder", text},
          {"shown", {point}},
          {"confirmed", {point}},
          {"control", {{"who", who}}},
          {"sessions", {{{"who", who}}}},
          {"operators", {{"control", {{"who", who}}}, {"sessions", {{{"who", who}}}}}},
          {"service", {{"connection", text}, {"last_error", text}, {"refused", text}, {"refused_sample", text}}},
          {"flight", {{"sentence", text}, {"mission_id", text}, {"mode", text}}},
          {"missions", {{"list", {{{"mission_id", text}, {"origin", text}, {"place", text}, {"reason", text}}}}}},
          {"fleet", {{"broker", text}, {"vehicle", text}, {"sentence", text}}},
          {"vehicle", {{"phase", text}, {"reason", text}}},
          {"ground", {{"reason", text}, {"error", text}}},
          {"eyes", {{"sentence", text}}},
          {"map", {{"error", text}}}};
}

std::string all_texts(const json& answer) {
  std::string result;
  for (auto* const text : {audit_text, control_text, status_text, points_text})
    result += text(answer) + "\n";
  return result;
}

RC_GTEST_PROP(shown_answer_property, no_text_of_a_stranger_makes_a_line_or_turns_one, ()) {
  const std::vector<std::string> vices{"\n",           "\r",       "\x1b[2J", "\a",           "\xe2\x80\xae",
                                       "\xe2\x81\xa7", "\xc2\x9b", "\x7f",    "\xe2\x80\xa8", std::string(1, '\0')};
  std::string text;
  for (const auto& each : *rc::gen::container<std::vector<std::string>>(rc::gen::elementOf(vices)))
    text += "error: godwitd: " + each;
  text += *rc::gen::elementOf(vices);
  const auto shown = all_texts(shown_answer(answer_with(text)));
  RC_ASSERT(std::ranges::count(shown, '\n') == std::ranges::count(all_texts(answer_with("x")), '\n'));
  RC_ASSERT(godwit::programs::printable(shown, "") == shown);
}

TEST(shown_answer, numbers_and_names_of_members_stay) {
  const json answer{{"a\n", {1, true, nullptr, "b\nc"}}};
  EXPECT_EQ(shown_answer(answer), (json{{"a\n", {1, true, nullptr, "b\\x0ac"}}}));
}

} // namespace shown_answer_test
