#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "programs/common/printable.hpp"
#include "programs/godwitd/status_text.hpp"

namespace status_text_test {

using namespace godwit::daemon;
using nlohmann::json;

TEST(status_text, each_part_is_a_line_and_a_part_without_an_answer_says_why) {
  const json answer{
      {"ok", true},
      {"run", {{"mission_id", "7d1c"}, {"phase", "seeing"}, {"sightings", {{"recorded", 5}, {"refused", 1}}}}},
      {"service", {{"connection", "unreachable"}, {"revision", 2}, {"pull", "synced"}, {"last_error", "no route"}}},
      {"vehicle", {{"error", "there is no answer: timeout"}}}};
  EXPECT_EQ(
      status_text(answer),
      "run        mission 7d1c: seeing; sightings: 5 recorded, 1 refused, 0 unreadable\n"
      "service    unreachable, mission revision 2, map synced; outbox: 0 pending, 0 orphaned, 0 expired (no route)\n"
      "vehicle    there is no answer: timeout");
}

TEST(status_text, a_flight_says_how_it_stands_and_what_waits_for_a_person) {
  const json answer{{"ok", true},
                    {"flight",
                     {{"sentence", "preflight: degraded"},
                      {"mission_id", "7d1c"},
                      {"revision", 2},
                      {"items_done", 3},
                      {"items", 9},
                      {"reports", 7},
                      {"mode", "hold"},
                      {"is_armed", false},
                      {"preflight_report", 4}}}};
  EXPECT_EQ(status_text(answer),
            "flight     preflight: degraded; mission 7d1c revision 2: 3 of 9 items, 7 reports; hold, "
            "disarmed; preflight report 4 waits for `ctl ack`");
}

TEST(status_text, of_other_aircraft_the_nearest_is_shown_and_what_the_autopilot_warns_of) {
  const json none{{"ok", true}, {"traffic", {{"aircraft", json::array()}, {"warnings", json::array()}}}};
  EXPECT_EQ(status_text(none), "traffic    no aircraft is heard");
  const json some{{"ok", true},
                  {"traffic",
                   {{"aircraft", {{{"sentence", "SWR123, 800 m to the north-east"}}, {{"sentence", "HB-ABC"}}}},
                    {"warnings", {"the autopilot warns"}}}}};
  EXPECT_EQ(status_text(some), "traffic    2 aircraft; the nearest: SWR123, 800 m to the north-east\n"
                               "           the autopilot warns");
}

TEST(status_text, each_mission_is_a_line_with_its_place_and_the_reason_for_it) {
  const json answer{{"ok", true},
                    {"missions",
                     {{"list",
                       {{{"mission_id", "7d1c"},
                         {"revision", 2},
                         {"origin", "service"},
                         {"place", "in_flight"},
                         {"items", 9},
                         {"items_done", 3}},
                        {{"mission_id", "7d1c"},
                         {"revision", 3},
                         {"origin", "service"},
                         {"place", "waiting"},
                         {"items", 10},
                         {"items_done", nullptr},
                         {"reason", "it is uploaded when the task under way is done"}},
                        {{"mission_id", ""},
                         {"revision", nullptr},
                         {"origin", "station"},
                         {"place", "refused"},
                         {"reason", "DO_JUMP"}},
                        {{"mission_id", "0d2f"},
                         {"revision", 1},
                         {"origin", "unknown"},
                         {"place", "ended"},
                         {"outcome", "complete"}}}}}}};
  EXPECT_EQ(status_text(answer), "missions   7d1c revision 2 (service): in_flight, 3 of 9 items\n"
                                 "           7d1c revision 3 (service): waiting, 10 items (it is uploaded "
                                 "when the task under way is done)\n"
                                 "           a mission (station): refused (DO_JUMP)\n"
                                 "           0d2f revision 1: ended, complete");
}

TEST(status_text, each_actor_is_a_line_with_what_the_guardian_knows_of_it) {
  const json list = json::array({{{"name", "vehicle_link"},
                                  {"phase", "running"},
                                  {"wanted", true},
                                  {"essential", true},
                                  {"incarnation", 3},
                                  {"restarts", 2},
                                  {"last_crash", "killed"},
                                  {"health", "yellow"},
                                  {"health_reason", "no heartbeat"}},
                                 {{"name", "mission_client"},
                                  {"phase", "absent"},
                                  {"wanted", false},
                                  {"essential", false},
                                  {"incarnation", 0},
                                  {"restarts", 0},
                                  {"last_crash", ""},
                                  {"health", "green"},
                                  {"health_reason", ""}}});
  EXPECT_EQ(status_text({{"ok", true}, {"actors", {{"list", list}}}}),
            "actors     vehicle_link: running, wanted, essential, incarnation 3, 2 restarts; yellow (no heartbeat); "
            "last crash: killed\n"
            "           mission_client: absent, not wanted, incarnation 0, 0 restarts; green");
}

TEST(status_text, a_refused_mission_is_told_with_the_beginning_of_what_came) {
  const auto text = status_text({{"service",
                                  {{"connection", "reachable"},
                                   {"revision", 0},
                                   {"pull", "not_started"},
                                   {"lost_reports", 2},
                                   {"refused", "what the service sent is no mission"},
                                   {"refused_sample", "<html>"}}}});
  EXPECT_NE(text.find("; reports lost: 2"), std::string::npos) << text;
  EXPECT_NE(text.find("refused: what the service sent is no mission; it began with: <html>"), std::string::npos)
      << text;
}

TEST(status_text, the_line_of_the_stations_says_who_is_there_and_what_was_dropped) {
  const json counts = json::array({{{"name", "passed_to_vehicle"}, {"count", 7}},
                                   {{"name", "passing_dropped"}, {"count", 0}},
                                   {{"name", "frames_in"}, {"count", 99}},
                                   {{"name", "passing_refused"}, {"count", 2}}});
  EXPECT_EQ(status_text({{"ok", true},
                         {"ground",
                          {{"link_is_up", true},
                           {"stations", json::array({{{"system", 255}, {"component", 190}}})},
                           {"counts", counts}}}}),
            "ground     up, station 255/190; passed_to_vehicle 7, passing_refused 2");
  EXPECT_EQ(status_text({{"ok", true}, {"ground", {{"link_is_up", false}, {"reason", "nobody listens there"}}}}),
            "ground     down (nobody listens there)");
}

TEST(status_text, points_are_listed_with_what_can_be_done_about_them) {
  const json shown = {{"number", 3},
                      {"class_group", "vehicle"},
                      {"position", {{"latitude_deg", 47.3981}, {"longitude_deg", 8.5461}}},
                      {"confidence", 0.9},
                      {"has_moved", true},
                      {"seen_ago_ms", 12'000},
                      {"decide_within_ms", 48'000}};
  auto confirmed = shown;
  confirmed["number"] = 2;
  confirmed["has_moved"] = false;
  confirmed["by"] = "anna";
  EXPECT_EQ(
      points_text({{"ok", true},
                   {"shown", json::array({shown})},
                   {"confirmed", json::array({confirmed})},
                   {"waiting", 7},
                   {"counts", {{"confirmed", 1}, {"no_room", 2}}}}),
      "point 3: vehicle at 47.39810,8.54610, 90 %, moved, seen 12 s ago; decide within 48 s: ctl confirm 3, or "
      "decline\n"
      "point 2: vehicle at 47.39810,8.54610, 90 %, seen 12 s ago; confirmed by anna\n"
      "7 wait for their turn; 1 were confirmed, 0 declined, 0 passed over; dropped: 0 too faint, 0 too old, 2 for "
      "want of room, 0 with their mission");
}

TEST(status_text, points_of_interest_are_a_line_while_somebody_looks_for_them) {
  const json points = {{"shown", json::array({{{"number", 3}}})}, {"waiting", 2}, {"counts", {{"passed_over", 4}}}};
  EXPECT_EQ(status_text({{"ok", true}, {"points", points}}),
            "points     1 to decide about (ctl points), 2 wait for their turn; 0 confirmed, 0 declined, 4 passed over");
  EXPECT_EQ(status_text({{"ok", true}, {"points", nullptr}}), "");
}

TEST(status_text, a_retry_tells_how_many_rows_it_found) {
  EXPECT_EQ(retry_text({{"tried_now", 2}, {"queued", 1}}), "2 pending, tried now; 1 queued again");
}

TEST(status_text, the_broker_is_named_with_what_waits_for_it_and_why_there_is_none) {
  json fleet{{"is_connected", true}, {"broker", "mqtts://fleet.example.org:8883"},
             {"vehicle", "rover-7"}, {"sentence", ""},
             {"waiting", 0},         {"delivered", 412}};
  const auto line = [&] { return status_text({{"ok", true}, {"fleet", fleet}}); };
  EXPECT_EQ(line(), "fleet      connected to mqtts://fleet.example.org:8883 as rover-7; events: 0 wait, 412 delivered");
  fleet["is_connected"] = false;
  fleet["sentence"] = "there is no connection: Connection refused";
  fleet["waiting"] = 3;
  fleet["dropped"] = 5;
  fleet["next_try_ms"] = 12'345;
  EXPECT_EQ(line(), "fleet      rover-7 is NOT connected: there is no connection: Connection refused; events: 3 wait, "
                    "412 delivered, 5 DROPPED; tried again in 12 s");
}

} // namespace status_text_test

namespace operator_text_test {

using namespace godwit::daemon;

using nlohmann::json;

TEST(operator_text, a_row_of_the_audit_says_when_who_what_and_what_came_of_it) {
  const json row{{"at_ns", 1'800'000'000'900'000'000},
                 {"who", {{"name", "anna"}, {"role", "operator"}, {"session", "s7"}}},
                 {"what", "start"},
                 {"outcome", "refused"},
                 {"reason", "not ready"},
                 {"count", 2}};
  EXPECT_EQ(audit_text({{"rows", {row}}}),
            "2027-01-15T08:00:00Z  anna (operator, s7): start: refused, 2 times (not ready)");
  EXPECT_EQ(audit_text({{"rows", json::array()}}), "there are no entries");
  auto numbered = row;
  numbered["number"] = 1'200;
  EXPECT_EQ(audit_text({{"rows", {numbered}}, {"has_older", true}}).substr(0, 46),
            "older rows: godwitd ctl audit --before 1200\n20");
}

TEST(operator_text, a_stranger_is_shown_as_one) {
  const json row{{"at_ns", 0}, {"who", {{"name", "mallory"}}}, {"what", "start"}, {"outcome", "no_session"}};
  EXPECT_EQ(audit_text({{"rows", {row}}}), "1970-01-01T00:00:00Z  mallory (unknown): start: no_session");
}

TEST(operator_text, who_has_control_is_said) {
  EXPECT_EQ(control_text({{"holder", "anna"}}), "anna has control");
  EXPECT_EQ(control_text({{"holder", ""}}), "control is free");
  const json anna{{"name", "anna"}, {"role", "operator"}, {"session", "s7"}};
  EXPECT_EQ(operators_line({{"control", {{"who", anna}}}, {"sessions", {{{"who", anna}}}}}),
            "anna has control, anna (operator, s7)");
  EXPECT_EQ(operators_line({{"control", nullptr}, {"sessions", json::array()}}), "control is free");
}

} // namespace operator_text_test

namespace shown_answer_test {

using namespace godwit::daemon;
using nlohmann::json;

// What strangers have written into names, reasons and sentences makes no line and turns none, in each text that
// `godwitd ctl` shows.

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
          {"traffic", {{"aircraft", {{{"sentence", text}}}}, {"warnings", {text}}}},
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
