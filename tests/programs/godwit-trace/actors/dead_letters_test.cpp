#include "programs/godwit-trace/actors/dead_letters.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <future>

#include "programs/godwit-trace/commands.hpp"
#include "runtime/journal/sqlite_journal.hpp"
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
