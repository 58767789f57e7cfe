#include <algorithm>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "programs/godwit-trace/commands.hpp"
#include "tests/programs/godwit-trace/actors/command_fixture.hpp"
#include "tests/programs/godwit-trace/actors/small_flight.hpp"

namespace godwit::trace_tool::test {
namespace trace_commands_test {

using nlohmann::json;

class trace_commands : public testing::Test {
protected:
  trace_commands() { tests::write_small_flight(folder_.path()); }

  command_result run(add_command add, std::vector<std::string> arguments) const {
    arguments.push_back(folder_.path().string());
    return run_command(add, std::move(arguments));
  }
  std::vector<json> run_json(add_command add, std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    std::vector<json> result;
    for (const auto& each : lines_of(run(add, std::move(arguments)).out))
      result.push_back(json::parse(each));
    return result;
  }

  tests::trace_folder folder_;
};

TEST_F(trace_commands, ls_counts_by_run_and_actor) {
  const auto seen = run_json(add_ls_command, {}).at(0);
  ASSERT_EQ(seen["runs"].size(), 2U);
  EXPECT_EQ(seen["runs"][0]["messages"], 12);
  const auto& executor = seen["runs"][0]["actors"].at(0);
  EXPECT_EQ(executor["actor"], "executor");
  EXPECT_EQ(executor["first_incarnation"], 1);
  EXPECT_EQ(executor["last_incarnation"], 2);
  EXPECT_EQ(executor["crashed"], 1);
  EXPECT_TRUE(seen["losses"].empty());
  const auto text = run(add_ls_command, {}).out;
  EXPECT_NE(text.find("run 1: 2026-11-18T"), std::string::npos) << text;
  EXPECT_NE(text.find("executor"), std::string::npos);
}

TEST_F(trace_commands, log_prints_time_actor_sender_type_cause_and_message) {
  const auto lines = lines_of(run(add_log_command, {"--type", "vehicle_link.*", "--actor", "vehicle_link"}).out);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("vehicle_link/1 <- executor vehicle_link.send_command #7 because #6 1 us {\"command\":400"),
            std::string::npos)
      << lines[0];
  EXPECT_NE(lines[0].find(".011000000Z "), std::string::npos);
}

TEST_F(trace_commands, log_filters_by_outcome_text_cause_run_and_time) {
  EXPECT_EQ(run_json(add_log_command, {"--outcome", "crashed"}).at(0)["id"], 10);
  EXPECT_EQ(run_json(add_log_command, {"--text", "\"by\":\"ann\""}).at(0)["id"], 6);
  EXPECT_EQ(run_json(add_log_command, {"--cause", "6"}).at(0)["id"], 7);
  EXPECT_EQ(run_json(add_log_command, {"--run", "2"}).size(), 3U);
  EXPECT_EQ(run_json(add_log_command, {"--from", "0.011", "--to", "0.013"}).size(), 2U);
  EXPECT_EQ(run(add_log_command, {"--run", "7"}).code, exit_code::failed);
  EXPECT_EQ(run(add_log_command, {"--outcome", "crushed"}).code, exit_code::usage);
}

TEST_F(trace_commands, show_prints_each_delivery_of_a_message_whole) {
  const auto seen = run(add_show_command, {"10", "--run", "1"});
  EXPECT_EQ(seen.code, exit_code::ok);
  EXPECT_NE(seen.out.find("to           executor, incarnation 1"), std::string::npos) << seen.out;
  EXPECT_NE(seen.out.find("to           executor, incarnation 2"), std::string::npos);
  EXPECT_NE(seen.out.find("\"revision\": 2"), std::string::npos);
  EXPECT_EQ(run(add_show_command, {"4711"}).code, exit_code::failed);
}

TEST_F(trace_commands, flow_draws_what_led_to_a_message_and_what_came_of_it) {
  const auto lines = lines_of(run(add_flow_command, {"7", "--run", "1"}).out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_NE(lines[0].find(" - executor <- control_handler operator.word #6"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find("   > vehicle_link <- executor"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("     - executor <- vehicle_link vehicle_link.command_outcome #8"), std::string::npos);
  EXPECT_NE(run(add_flow_command, {"100"}).words.find("--run"), std::string::npos) << "two runs have it";
}

TEST_F(trace_commands, stats_tell_waiting_and_handling_apart) {
  for (const auto& each : run_json(add_stats_command, {"--type", "vehicle_link.send_command"})) {
    EXPECT_EQ(each["waiting"]["count"], 1);
    EXPECT_EQ(each["waiting"]["max_ns"], 1'000'000 - 40'000); // 1 ms after the begin of a handler that took 40 us
    EXPECT_EQ(each["handling"]["max_ns"], 1'000);
  }
  EXPECT_NE(run(add_stats_command, {"--histogram"}).out.find("HANDLING (from this on)"), std::string::npos);
}

TEST_F(trace_commands, crashes_name_message_reason_and_how_it_went_on) {
  const auto seen = run_json(add_crashes_command, {"--before", "2"});
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0]["actor"], "executor");
  EXPECT_EQ(seen[0]["reason"], "no such item");
  EXPECT_EQ(seen[0]["crashed_on"]["id"], 10);
  EXPECT_EQ(seen[0]["before"].size(), 2U);
  EXPECT_EQ(seen[0]["delivered_again"], 1);
  EXPECT_EQ(seen[0]["first_after"]["incarnation"], 2);
  EXPECT_NE(run(add_crashes_command, {}).out.find("crashed: no such item"), std::string::npos);
}

TEST_F(trace_commands, crashes_say_what_the_restart_restored) {
  auto rows = tests::first_run();
  rows.insert(rows.end() - 2,
              {.at_ms = 32,
               .actor = "executor",
               .type = "runtime.restored",
               .body = R"({"part":0,"parts":1,"bytes":64,"text":"{\"last_event\":9,\"effects\":[{}],\"state\":{}}"})",
               .sender = "executor",
               .incarnation = 2});
  const tests::trace_folder folder;
  tests::write_flight(folder.path(), rows, {});
  const auto seen = run_command(add_crashes_command, {folder.path().string()});
  EXPECT_NE(seen.out.find("restored 64 bytes of state, up to event 9, with 1 effect that had not gone out"),
            std::string::npos)
      << seen.out;
  EXPECT_EQ(seen.out.find("runtime.restored"), std::string::npos) << seen.out; // it is no message
}

TEST_F(trace_commands, flight_tells_what_people_ask_for_and_nothing_twice) {
  std::vector<std::string> sentences;
  for (const auto& each : run_json(add_flight_command, {}))
    sentences.push_back(each["sentence"]);
  EXPECT_EQ(sentences,
            (std::vector<std::string>{
                "godwitd begins (run 1)", "the vehicle is in hold, disarmed", "operator command: start (ann)",
                "executor commands component_arm_disarm (1, 0)", "component_arm_disarm of executor: accepted",
                "the vehicle is in mission, armed", "report 1: started a", "replan to revision 2: 3 items after a",
                "executor, incarnation 1: crashed: no such item", "replan to revision 2: 3 items after a",
                "report 2: reached a", "godwitd begins (run 2)",
                "somebody else has the vehicle; the failsafe warns and sends nothing", "report 3: complete a"}));
}

TEST_F(trace_commands, what_is_no_trace_is_said_and_fails) {
  for (const auto add : {add_ls_command, add_log_command, add_stats_command, add_crashes_command, add_flight_command}) {
    const auto seen = run_command(add, {"/nowhere/at/all"});
    EXPECT_EQ(seen.code, exit_code::failed);
    EXPECT_NE(seen.words.find("no such file or folder"), std::string::npos);
  }
}

TEST_F(trace_commands, what_the_trace_does_not_hold_is_said) {
  std::filesystem::resize_file(folder_.path() / "godwit-0000000002-000001.mcap", 40);
  const auto seen = run(add_ls_command, {});
  EXPECT_EQ(seen.code, exit_code::ok);
  EXPECT_NE(seen.words.find("its writer was killed"), std::string::npos) << seen.words;
}

} // namespace trace_commands_test
} // namespace godwit::trace_tool::test
