#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "io/sqlite/database.hpp"
#include "programs/godwit-drill/drill_actors.hpp"
#include "programs/godwit-drill/runtime_drill.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace drill_test {

using namespace godwit;
using namespace godwit::drill;
using tests::scratch_folder;

runtime_drill_options small_drill(const scratch_folder& scratch) {
  runtime_drill_options result;
  result.messages = 20'000;
  result.crashes = 60;
  result.seed = 7;
  result.process.journal.path = scratch.path("drill.db");
  result.process.trace.emplace();
  result.process.trace->folder = scratch.path("trace");
  return result;
}

std::int64_t count(const std::string& journal, const std::string& sql) {
  auto reader = runtime::journal_reader::open(journal);
  EXPECT_TRUE(reader) << reader.error().message();
  const auto number = reader ? reader->database().query_integer(sql).value_or(-1) : -1;
  return number;
}

TEST(runtime_drill, loses_and_doubles_nothing_while_its_actors_crash) {
  const scratch_folder scratch;
  const auto options = small_drill(scratch);
  const auto result = run_runtime_drill(options);
  ASSERT_TRUE(result) << result.error();
  EXPECT_TRUE(result->passed()) << to_table(*result);
  EXPECT_EQ(result->sent, options.messages);
  EXPECT_EQ(result->sent, result->handled + result->dead_lettered + result->lost);
  EXPECT_EQ(result->lost, 0U);
  EXPECT_EQ(result->doubled, 0U);
  EXPECT_GE(result->crashes, options.crashes);
  EXPECT_GT(result->restarts, 0U);
  EXPECT_LE(result->restarts, result->crashes);
  EXPECT_GT(result->restart_p50_us, 0);
  EXPECT_LE(result->restart_p50_us, result->restart_p99_us);
  EXPECT_LE(result->restart_p99_us, result->restart_max_us);
  EXPECT_GT(result->trace_records, options.messages);
  EXPECT_GT(result->journal_commits, 0U);
}

TEST(runtime_drill, every_tenth_message_has_one_row_that_anyone_can_count) {
  const scratch_folder scratch;
  auto options = small_drill(scratch);
  options.seed = 8;
  const auto result = run_runtime_drill(options);
  ASSERT_TRUE(result) << result.error();
  const auto expected = static_cast<std::int64_t>(options.messages / durable_every);
  EXPECT_EQ(count(options.process.journal.path, "SELECT count(*) FROM drill_effect"), expected);
  EXPECT_EQ(count(options.process.journal.path, "SELECT count(DISTINCT seq) FROM drill_effect"), expected);
  EXPECT_EQ(count(options.process.journal.path, "SELECT count(*) FROM drill_effect WHERE seq % 10 <> 0"), 0);
  EXPECT_EQ(result->effects_found, static_cast<std::uint64_t>(expected));
}

TEST(runtime_drill, refuses_a_journal_that_is_there_already) {
  const scratch_folder scratch;
  const auto options = small_drill(scratch);
  std::ofstream(options.process.journal.path) << "precious";
  const auto result = run_runtime_drill(options);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().find(options.process.journal.path), std::string::npos) << result.error();
  EXPECT_EQ(std::filesystem::file_size(options.process.journal.path), 8U) << "left as it was";
}

TEST(runtime_drill, one_message_and_no_crash_is_a_drill_too) {
  const scratch_folder scratch;
  auto options = small_drill(scratch);
  options.messages = 1;
  options.crashes = 0;
  const auto result = run_runtime_drill(options);
  ASSERT_TRUE(result) << result.error();
  EXPECT_TRUE(result->passed());
  EXPECT_EQ(result->handled, 1U);
}

TEST(runtime_drill_result, passes_only_when_nothing_is_lost_or_doubled_and_every_effect_is_found) {
  runtime_drill_result good;
  good.sent = 10;
  good.handled = 10;
  good.effects_expected = 1;
  good.effects_found = 1;
  EXPECT_TRUE(good.passed());
  auto lost = good;
  lost.lost = 1;
  EXPECT_FALSE(lost.passed());
  auto doubled = good;
  doubled.doubled = 1;
  EXPECT_FALSE(doubled.passed());
  auto without_effect = good;
  without_effect.effects_found = 0;
  EXPECT_FALSE(without_effect.passed());
}

TEST(runtime_drill_result, its_json_has_the_keys_that_scripts_rely_on) {
  const auto json = to_json(runtime_drill_result{}, 3);
  for (const auto* key : {"sent", "handled", "dead_lettered", "lost", "doubled", "restarts", "restart_p50_us",
                          "restart_p99_us", "trace_records", "trace_dropped", "journal_commits"}) {
    EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_TRUE(json.value(key, nlohmann::json()).is_number()) << key;
  }
  EXPECT_EQ(json.at("seed"), 3);
}

TEST(report, has_a_row_for_each_figure_with_its_value) {
  runtime_drill_result result;
  result.sent = 1'234'567;
  result.lost = 1;
  result.restart_p99_us = 987;
  const auto table = to_table(result);
  for (const auto* row : {"sent", "handled", "dead-lettered", "lost", "doubled", "restarts", "restart latency p50",
                          "restart latency p99", "restart latency max", "trace records", "journal commits"})
    EXPECT_NE(table.find(std::string("  ") + row), std::string::npos) << row << '\n' << table;
  const auto line_of = [&](const std::string& name) {
    const auto at = table.find("  " + name + ' ');
    return at == std::string::npos ? "" : table.substr(at, table.find('\n', at) - at);
  };
  EXPECT_EQ(line_of("lost").back(), '1') << line_of("lost");
  EXPECT_NE(line_of("sent").find("1,234,567"), std::string::npos) << line_of("sent");
  EXPECT_NE(line_of("restart latency p99").find("987 us"), std::string::npos);
}

// -- the plan
// ----------------------------------------------------------------------------------------------------------

class hand_set_time final : public runtime::time_source {
public:
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return now_ns; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return now_ns; }
  std::int64_t now_ns = 1'000;
};

TEST(crash_plan, throws_once_at_the_armed_point_and_measures_the_time_to_the_next_message) {
  hand_set_time time;
  crash_plan plan(time);
  EXPECT_TRUE(plan.arm(3, runtime::crash_point::after_handler));
  EXPECT_FALSE(plan.arm(3, runtime::crash_point::before_handler)) << "one is outstanding";
  EXPECT_NO_THROW(plan.hit(runtime::crash_point::before_handler, 3, 1));
  EXPECT_NO_THROW(plan.hit(runtime::crash_point::after_handler, 4, 1)) << "another actor";
  EXPECT_THROW(plan.hit(runtime::crash_point::after_handler, 3, 1), runtime::injected_crash);
  time.now_ns += 250;
  EXPECT_NO_THROW(plan.hit(runtime::crash_point::before_handler, 3, 1));
  EXPECT_NO_THROW(plan.hit(runtime::crash_point::after_handler, 3, 1));
  EXPECT_EQ(plan.latencies_ns(), std::vector<std::int64_t>{250});
}

TEST(crash_plan, a_disarmed_plan_does_not_throw) {
  hand_set_time time;
  crash_plan plan(time);
  EXPECT_TRUE(plan.arm(3, runtime::crash_point::before_handler));
  plan.disarm_all();
  EXPECT_NO_THROW(plan.hit(runtime::crash_point::before_handler, 3, 1));
  EXPECT_TRUE(plan.arm(3, runtime::crash_point::before_handler));
}

} // namespace drill_test
