#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "runtime/config/config.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/process.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"
#include "tests/support/ledger.hpp"

namespace process_test {

using namespace godwit;
using namespace godwit::runtime;
using namespace std::chrono_literals;
using tests::scratch_folder;

process_options in(const scratch_folder& scratch) {
  process_options result;
  result.journal.path = scratch.path("journal.db");
  result.trace.emplace();
  result.trace->folder = scratch.path("trace");
  return result;
}

std::string refusal(process_options options) {
  const auto host = process::open(std::move(options));
  EXPECT_FALSE(host);
  return host ? "" : host.error();
}

TEST(process, options_from_takes_every_key_of_the_configuration) {
  const auto options = options_from(nlohmann::json::parse(R"({
    "journal": {"path": "/somewhere/else.db"},
    "trace": {"directory": "/somewhere/trace", "segment_mib": 3, "total_mib": 77, "flush_ms": 55},
    "scheduler": {"workers": 6, "max_throughput": 33},
    "supervision": {"ping_period_ms": 11, "ping_warn_ms": 22, "ping_fatal_ms": 44, "stop_timeout_ms": 88}
  })"));
  EXPECT_EQ(options.journal.path, "/somewhere/else.db");
  ASSERT_TRUE(options.trace);
  EXPECT_EQ(options.trace->folder, "/somewhere/trace");
  EXPECT_EQ(options.trace->segment_bytes, std::uint64_t{3} << 20U);
  EXPECT_EQ(options.trace->total_bytes, std::uint64_t{77} << 20U);
  EXPECT_EQ(options.trace->flush, 55ms);
  EXPECT_EQ(options.actors.workers, 6U);
  EXPECT_EQ(options.actors.max_throughput, 33U);
  EXPECT_EQ(options.actors.ping.period, 11ms);
  EXPECT_EQ(options.actors.ping.warn, 22ms);
  EXPECT_EQ(options.actors.ping.fatal, 44ms);
  EXPECT_EQ(options.actors.stop_timeout, 88ms);
}

TEST(process, the_defaults_of_the_configuration_are_those_of_the_options) {
  const auto defaults = load_config("{}", "defaults", godwit_schema());
  ASSERT_TRUE(defaults) << defaults.error().message();
  const auto options = options_from(*defaults);
  const trace_options trace;
  const system_options actors;
  EXPECT_EQ(options.trace->segment_bytes, trace.segment_bytes);
  EXPECT_EQ(options.trace->total_bytes, trace.total_bytes);
  EXPECT_EQ(options.trace->flush, trace.flush);
  EXPECT_EQ(options.actors.workers, actors.workers);
  EXPECT_EQ(options.actors.max_throughput, actors.max_throughput);
  EXPECT_EQ(options.actors.ping.period, actors.ping.period);
  EXPECT_EQ(options.actors.ping.warn, actors.ping.warn);
  EXPECT_EQ(options.actors.ping.fatal, actors.ping.fatal);
  EXPECT_EQ(options.actors.stop_timeout, actors.stop_timeout);
}

TEST(process, each_cause_of_an_exit_has_its_code) {
  EXPECT_EQ(exit_code_for(exit_cause::requested), exit_code::ok);
  EXPECT_EQ(exit_code_for(exit_cause::essential_given_up), exit_code::essential_given_up);
  EXPECT_EQ(exit_code_for(exit_cause::essential_silent), exit_code::unresponsive);
  EXPECT_EQ(exit_code_for(exit_cause::no_free_worker), exit_code::unresponsive);
}

TEST(process, a_journal_whose_folder_can_not_be_is_refused_with_its_name) {
  const scratch_folder scratch;
  std::ofstream(scratch.path("file")) << "not a folder";
  auto options = in(scratch);
  options.journal.path = scratch.path("file/journal.db");
  const auto why = refusal(options);
  EXPECT_NE(why.find(options.journal.path), std::string::npos) << why;
  EXPECT_FALSE(std::filesystem::exists(scratch.path("trace"))) << "the journal comes first";
}

TEST(process, a_file_that_is_no_journal_is_refused_and_left_as_it_is) {
  const scratch_folder scratch;
  std::ofstream(scratch.path("journal.db")) << "my shopping list, not a database of any kind";
  const auto why = refusal(in(scratch));
  EXPECT_NE(why.find(scratch.path("journal.db")), std::string::npos) << why;
  EXPECT_EQ(std::filesystem::file_size(scratch.path("journal.db")), 44U);
}

TEST(process, a_journal_that_another_writes_is_refused) {
  const scratch_folder scratch;
  const auto first = process::open(in(scratch));
  ASSERT_TRUE(first) << first.error();
  auto second = in(scratch);
  second.trace->folder = scratch.path("trace_of_the_second");
  const auto why = refusal(second);
  EXPECT_NE(why.find(scratch.path("journal.db")), std::string::npos) << why;
  EXPECT_NE(why.find(std::to_string(::getpid())), std::string::npos) << "names the process that has it: " << why;
  EXPECT_FALSE(std::filesystem::exists(scratch.path("trace_of_the_second")));
}

TEST(process, a_trace_folder_that_can_not_be_made_is_refused_and_the_journal_given_back) {
  const scratch_folder scratch;
  std::ofstream(scratch.path("file")) << "not a folder";
  auto options = in(scratch);
  options.trace->folder = scratch.path("file/trace");
  const auto why = refusal(options);
  EXPECT_NE(why.find(options.trace->folder.string()), std::string::npos) << why;
  const auto again = process::open(in(scratch));
  EXPECT_TRUE(again) << again.error();
}

TEST(process, each_run_has_its_number_in_the_names_of_its_trace) {
  const scratch_folder scratch;
  for (int run = 1; run <= 2; ++run) {
    auto host = process::open(in(scratch));
    ASSERT_TRUE(host) << host.error();
    EXPECT_EQ((*host)->journal().status().run, static_cast<std::uint64_t>(run));
    tests::audit seen;
    (void)(*host)->actors().add<tests::auditor_actor>({.name = "auditor"}, {}, &seen);
    (*host)->actors().start();
    EXPECT_TRUE(tests::wait_for([&] { return (*host)->traced().recorded > 0; }))
        << "the guardian has told of its child";
    EXPECT_EQ((*host)->finish(0), 0);
    EXPECT_TRUE(std::filesystem::exists(scratch.path("trace/godwit-000000000" + std::to_string(run) + "-000001.mcap")));
  }
}

TEST(process, finish_handles_what_is_queued_then_writes_the_trace_then_the_journal) {
  const scratch_folder scratch;
  constexpr std::int64_t deposits = 200;
  tests::audit seen;
  auto host = process::open(in(scratch));
  ASSERT_TRUE(host) << host.error();
  const auto auditor = (*host)->actors().add<tests::auditor_actor>({.name = "auditor"}, {}, &seen);
  const auto ledger = (*host)->actors().add<tests::ledger_actor>({.name = "ledger"}, {}, auditor);
  (*host)->actors().start();
  auto gate = (*host)->actors().make_gateway("test");
  gate.tell(ledger, tests::deposit{1, 1});
  ASSERT_TRUE(tests::wait_for([&] { return (*host)->actors().counters(1).handled == 1; })) << "it is up";
  for (std::int64_t i = 2; i <= deposits; ++i)
    gate.tell(ledger, tests::deposit{i, 1});
  EXPECT_EQ((*host)->finish(5), 5);
  const auto traced = (*host)->traced();
  EXPECT_GE(traced.recorded, static_cast<std::uint64_t>(deposits));
  EXPECT_EQ(traced.written, traced.recorded);
  EXPECT_EQ(traced.dropped, 0U);
  auto reader = journal_reader::open(scratch.path("journal.db"));
  ASSERT_TRUE(reader) << reader.error().message();
  const auto actors = reader->actors();
  ASSERT_TRUE(actors);
  ASSERT_EQ(actors->size(), 1U);
  EXPECT_EQ(actors->front().last_event, deposits);
  EXPECT_EQ((*host)->finish(6), 6) << "a second time it has nothing to do";
}

TEST(process, its_actors_are_responsive_from_the_start_until_somebody_asks_for_the_end) {
  const scratch_folder scratch;
  tests::audit seen;
  auto host = process::open(in(scratch));
  ASSERT_TRUE(host) << host.error();
  auto& actors = (*host)->actors();
  (void)actors.add<tests::auditor_actor>({.name = "auditor"}, {}, &seen);
  EXPECT_FALSE(actors.has_begun());
  EXPECT_FALSE(actors.is_responsive());
  actors.start();
  EXPECT_TRUE(tests::wait_for([&] { return actors.has_begun(); }));
  EXPECT_TRUE(actors.is_responsive());
  actors.request_exit({exit_cause::essential_silent, "it does not answer"});
  EXPECT_FALSE(actors.is_responsive());
  EXPECT_TRUE(actors.has_begun());
  EXPECT_EQ((*host)->finish(0), 0);
}

journal_write nothing_of(const std::string& actor) {
  journal_write result;
  result.actor = actor;
  result.incarnation = 1;
  return result;
}

// What hangs in a write tells nobody itself.
TEST(process, a_journal_whose_queue_is_nearly_full_is_red_until_it_is_written) {
  const scratch_folder scratch;
  auto options = in(scratch);
  options.journal.own_thread = false;
  options.journal.max_queued_writes = 10;
  const auto host = process::open(std::move(options));
  ASSERT_TRUE(host) << host.error();
  const auto colour = [&] {
    (void)(*host)->look_at_journal();
    const auto shown = (*host)->health().entries();
    return std::ranges::find(shown, "journal", &health_entry::component)->colour;
  };
  for (int i = 1; i <= 7; ++i)
    ASSERT_TRUE((*host)->journal().submit(nothing_of("ledger")));
  EXPECT_EQ(colour(), health_colour::green);
  ASSERT_TRUE((*host)->journal().submit(nothing_of("ledger")));
  EXPECT_EQ(colour(), health_colour::red);
  EXPECT_TRUE((*host)->journal().flush(0ms));
  EXPECT_EQ(colour(), health_colour::green);
}

} // namespace process_test
