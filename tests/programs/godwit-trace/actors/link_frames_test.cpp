#include "programs/godwit-trace/actors/link_frames.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "io/mavlink/tlog/tlog_writer.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "tests/programs/godwit-trace/actors/command_fixture.hpp"
#include "tests/programs/godwit-trace/actors/small_flight.hpp"

namespace godwit::trace_tool::test {
namespace link_frames_test {

class links_of_a_flight : public testing::Test {
protected:
  links_of_a_flight() { tests::write_small_flight(folder_.path()); }

  // Frames AT_MS after the beginning of the trace.
  void log(const std::string& name, std::initializer_list<int> at_ms) const {
    io::mavlink::tlog_writer writer;
    ASSERT_TRUE(writer.open({folder_.path() / name}));
    for (const int each : at_ms) {
      io::mavlink::command_long command;
      command.command = static_cast<std::uint16_t>(each);
      const auto begin_us = static_cast<std::uint64_t>(tests::trace_begin_ns) / 1'000U;
      ASSERT_TRUE(writer.write(begin_us + 1'000U * static_cast<std::uint64_t>(each), frame_of(command).view()));
      ASSERT_TRUE(writer.write(begin_us + 1'000U * static_cast<std::uint64_t>(each),
                               frame_of(io::mavlink::heartbeat{}).view()));
    }
  }
  command_result run(add_command add, std::vector<std::string> arguments) const {
    arguments.push_back(folder_.path().string());
    return run_command(add, std::move(arguments));
  }

  tests::trace_folder folder_;
};

std::vector<std::string> times_of(const std::string& text) {
  std::vector<std::string> result;
  for (const auto& each : lines_of(text))
    result.push_back(each.substr(0, std::string("2026-11-18T11:06:40.000000000Z").size()));
  return result;
}

TEST_F(links_of_a_flight, both_links_and_the_trace_stand_on_one_time_line_run_by_run) {
  log("vehicle-0000000001-000001.tlog", {5, 15});
  log("vehicle-0000000001-000002.tlog", {25});
  log("ground-0000000001-000001.tlog", {6});
  log("vehicle-0000000002-000001.tlog", {505, 900});
  const auto alone = lines_of(run(add_log_command, {}).out).size();
  const auto both = run(add_log_command, {"--links"});
  EXPECT_EQ(both.words, "");
  EXPECT_EQ(lines_of(both.out).size(), alone + 12);
  EXPECT_TRUE(std::ranges::is_sorted(times_of(both.out))) << both.out;
  EXPECT_NE(both.out.find(".006000000Z ground link <- 1/1 COMMAND_LONG "), std::string::npos) << both.out;
}

TEST_F(links_of_a_flight, names_times_and_runs_choose_frames) {
  log("vehicle-0000000001-000001.tlog", {5, 15});
  log("vehicle-0000000002-000001.tlog", {505});
  const auto of_names = run(add_log_command, {"--links", "--name", "COMMAND_*", "--actor", "nobody"}).out;
  EXPECT_EQ(lines_of(of_names).size(), 3U);
  EXPECT_EQ(
      lines_of(run(add_log_command, {"--links", "--actor", "nobody", "--from", "0.010", "--to", "0.1"}).out).size(),
      2U);
  EXPECT_EQ(lines_of(run(add_log_command, {"--links", "--actor", "nobody", "--run", "2"}).out).size(), 2U);
  EXPECT_EQ(run(add_log_command, {"--links", "--name", "COMMND_LONG"}).code, exit_code::usage);
}

TEST_F(links_of_a_flight, the_page_for_people_shows_commands_and_no_telemetry) {
  log("vehicle-0000000001-000001.tlog", {5});
  const auto page = run(add_flight_command, {"--links"}).out;
  EXPECT_NE(page.find("link     vehicle <- 1/1 COMMAND_LONG"), std::string::npos) << page;
  EXPECT_EQ(page.find("HEARTBEAT"), std::string::npos) << page;
}

TEST_F(links_of_a_flight, a_damaged_or_missing_recording_is_said_and_the_rest_is_shown) {
  EXPECT_NE(run(add_log_command, {"--links"}).words.find("no .tlog of these runs"), std::string::npos);
  std::ofstream(folder_.path() / "vehicle-0000000001-000001.tlog") << std::string(5'000, '\xFD');
  log("vehicle-0000000001-000002.tlog", {5});
  const auto seen = run(add_log_command, {"--links", "--actor", "nobody"});
  EXPECT_EQ(lines_of(seen.out).size(), 2U);
  EXPECT_NE(seen.words.find("vehicle-0000000001-000001.tlog: passed over"), std::string::npos) << seen.words;
}

} // namespace link_frames_test
} // namespace godwit::trace_tool::test
