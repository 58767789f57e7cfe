#include <future>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "messages/mission_client/types.hpp"
#include "programs/godwit-trace/actors/dead_letters.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "runtime/journal/sqlite_journal.hpp"
#include "runtime/stored_state.hpp"
#include "tests/programs/godwit-trace/actors/command_fixture.hpp"
#include "tests/programs/godwit-trace/actors/small_flight.hpp"

namespace dead_letters_test {

using namespace godwit;
using namespace godwit::trace_tool;

void give_up(const std::string& path) {
  const auto journal = runtime::sqlite_journal::open({.path = path}).value();
  runtime::journal_write write;
  write.actor = "executor";
  write.incarnation = 3;
  write.dead_letters = {{10, 7, 2'000'000'000, "mission_client", "mission_client.assignment_arrived",
                         R"({"revision":2})", 3, "no such item"}};
  std::promise<bool> done;
  write.done = [&done](const runtime::commit_result& result) { done.set_value(result.has_value()); };
  ASSERT_TRUE(journal->submit(std::move(write)));
  ASSERT_TRUE(done.get_future().get());
}

TEST(dead_letters, messages_that_were_given_up_are_shown_behind_the_crashes) {
  const tests::trace_folder folder;
  tests::write_small_flight(folder.path() / "trace");
  const auto journal = (folder.path() / "godwit.db").string();
  give_up(journal);
  const auto trace = (folder.path() / "trace").string();
  const auto seen = trace_tool::test::run_command(add_crashes_command, {trace, "--journal", journal});
  EXPECT_EQ(seen.code, exit_code::ok) << seen.words;
  EXPECT_NE(seen.out.find("1970-01-01T00:00:02.000000000Z executor gave up mission_client.assignment_arrived #10 of "
                          "mission_client, after 3 crashes: no such item\n  {\"revision\":2}\n"),
            std::string::npos)
      << seen.out;
  const auto lines = trace_tool::test::run_command(add_crashes_command, {trace, "--journal", journal, "--json"}).out;
  const auto last = nlohmann::json::parse(lines.substr(lines.rfind('\n', lines.size() - 2) + 1));
  EXPECT_EQ(last["dead_letter"], 10);
  EXPECT_EQ(last["message"], R"({"revision":2})");
}

TEST(dead_letters, a_journal_that_is_not_there_is_said_and_is_exit_code_1) {
  const tests::trace_folder folder;
  tests::write_small_flight(folder.path() / "trace");
  const auto seen = trace_tool::test::run_command(
      add_crashes_command, {(folder.path() / "trace").string(), "--journal", (folder.path() / "none.db").string()});
  EXPECT_EQ(seen.code, exit_code::failed);
  EXPECT_NE(seen.words.find("none.db"), std::string::npos) << seen.words;
}

} // namespace dead_letters_test

namespace journal_facts_test {

using namespace godwit;

using namespace godwit::trace_tool;

constexpr const char* mission = "5c0f3f6e-3d6b-4f3a-9b77-2f1f5a1c0001";

void commit(runtime::sqlite_journal& journal, runtime::journal_write write) {
  std::promise<bool> done;
  write.incarnation = 1;
  write.done = [&done](const runtime::commit_result& result) { done.set_value(result.has_value()); };
  ASSERT_TRUE(journal.submit(std::move(write)));
  ASSERT_TRUE(done.get_future().get());
}

std::string report(std::uint32_t number) {
  mission_client::report_progress result;
  result.key = "key " + std::to_string(number);
  result.report.mission_id = mission;
  result.report.report_no = number;
  result.report.at = "2026-05-04T10:15:30Z";
  return runtime::json_of(result);
}

// mission_client has taken two reports, and the executor owes a third one.
void write_journal(const std::string& path) {
  const auto journal = runtime::sqlite_journal::open({.path = path}).value();
  const std::string type(mission_client::report_progress::fields.type_name);
  runtime::journal_write taken;
  taken.actor = "mission_client";
  taken.events = {{1, 1'000, type, report(1)}, {2, 2'000, type, report(2)}};
  taken.outbox = {
      {.idempotency_key = "key 2", .destination = "progress", .body = "{}", .created_ns = 2'000, .last_error = {}}};
  commit(*journal, std::move(taken));
  runtime::journal_write owed;
  owed.actor = "executor";
  owed.events = {{1, 3'000, "executor.something", "{}"}};
  owed.effects = {{{1, 0}, type, report(3)}};
  commit(*journal, std::move(owed));
}

TEST(journal_facts, what_was_taken_and_what_is_owed_is_read) {
  const tests::trace_folder folder;
  const auto path = (folder.path() / "godwit.db").string();
  write_journal(path);
  const auto found = read_journal_record(path, {"executor", "mission_client"});
  ASSERT_TRUE(found.has_value()) << found.error();
  EXPECT_EQ(found->last_reports.at(mission), 2U);
  ASSERT_EQ(found->outbox.size(), 1U);
  EXPECT_EQ(found->outbox[0].idempotency_key, "key 2");
  ASSERT_EQ(found->owed.size(), 1U);
  EXPECT_NE(found->owed[0].body.find("\"report_no\":3"), std::string::npos);
}

TEST(journal_facts, verify_decides_what_is_promised_of_the_journal_only_where_one_is_named) {
  const tests::trace_folder folder;
  tests::write_small_flight(folder.path() / "trace");
  const auto trace = (folder.path() / "trace").string();
  const auto path = (folder.path() / "godwit.db").string();
  write_journal(path);
  const auto without = trace_tool::test::run_command(add_verify_command, {trace});
  EXPECT_NE(without.out.find("undecided reports_are_kept"), std::string::npos) << without.out;
  EXPECT_NE(without.out.find("name it with --journal"), std::string::npos) << without.out;
  const auto with = trace_tool::test::run_command(add_verify_command, {trace, "--journal", path});
  EXPECT_EQ(with.out.find("undecided outbox_numbers_once"), std::string::npos) << with.out;
  const auto missing = trace_tool::test::run_command(add_verify_command, {trace, "--journal", path + ".none"});
  EXPECT_EQ(missing.code, exit_code::failed);
}

} // namespace journal_facts_test
