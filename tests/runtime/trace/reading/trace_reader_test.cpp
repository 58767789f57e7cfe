#include "runtime/trace/reading/trace_reader.hpp"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "runtime/trace/reading/ordered_reader.hpp"
#include "tests/runtime/trace/reading/written_trace.hpp"

namespace trace_reader_test {

using namespace godwit;
using namespace godwit::runtime;
using tests::trace_begin_ns;
using tests::written_trace;

struct read_trace {
  std::vector<delivery> deliveries; // their bodies are in `bodies`
  std::vector<std::string> bodies;
  std::vector<loss> losses;
  read_counts counts;
  name_table names;
};

read_trace read(const std::filesystem::path& where, time_span_ns span = {}) {
  read_trace result;
  const std::string path = where.string();
  auto files = find_trace_files(std::span(&path, 1));
  EXPECT_TRUE(files.has_value());
  trace_reader reader(*files, result.names, span);
  ordered_reader ordered(reader);
  delivery each;
  while (ordered.next(each)) {
    result.bodies.emplace_back(each.body);
    result.deliveries.push_back(each);
  }
  result.losses = reader.losses();
  result.counts = reader.counts();
  return result;
}

bool has(const read_trace& trace, loss_kind kind) { return std::ranges::count(trace.losses, kind, &loss::kind) > 0; }

void write_many(const std::filesystem::path& folder, int count, std::uint64_t run = 1) {
  written_trace trace(folder, run, 32U << 10U);
  for (int n = 0; n < count; ++n)
    trace.add({.at_ms = n * 100,
               .actor = n % 2 == 0 ? "executor" : "failsafe",
               .type = "tick",
               .body = R"({"n":)" + std::to_string(n) + "}",
               .id = static_cast<std::uint64_t>(n) + 1});
  trace.close();
}

TEST(trace_reader, every_delivery_of_every_segment_comes_in_order_of_time) {
  const tests::trace_folder folder;
  write_many(folder.path(), 1000);
  const auto trace = read(folder.path());
  ASSERT_EQ(trace.deliveries.size(), 1000U);
  EXPECT_GT(trace.counts.files, 2U);
  EXPECT_TRUE(trace.losses.empty());
  for (std::size_t n = 0; n < trace.deliveries.size(); ++n) {
    EXPECT_EQ(trace.deliveries[n].id, n + 1);
    EXPECT_EQ(trace.bodies[n], R"({"n":)" + std::to_string(n) + "}");
    EXPECT_EQ(trace.names.name(trace.deliveries[n].actor), n % 2 == 0 ? "executor" : "failsafe");
  }
}

TEST(trace_reader, what_two_threads_did_is_brought_into_the_order_of_time_within_a_run) {
  const tests::trace_folder folder;
  {
    written_trace trace(folder.path(), 1);
    for (const int at_ms : {100, 300, 500, 0, 200, 400})
      trace.add({.at_ms = at_ms, .actor = "a", .type = "t"});
    trace.close();
  }
  {
    written_trace trace(folder.path(), 2); // its clock stands behind that of the first
    for (const int at_ms : {50, 10})
      trace.add({.at_ms = at_ms, .actor = "a", .type = "t"});
    trace.close();
  }
  std::vector<std::int64_t> at_ms;
  for (const auto& each : read(folder.path()).deliveries)
    at_ms.push_back((each.began_ns - trace_begin_ns) / 1'000'000);
  EXPECT_EQ(at_ms, (std::vector<std::int64_t>{0, 100, 200, 300, 400, 500, 10, 50}));
}

TEST(trace_reader, a_time_reads_only_its_segments) {
  const tests::trace_folder folder;
  write_many(folder.path(), 1000);
  const auto trace = read(folder.path(), {trace_begin_ns + 50'000'000'000, trace_begin_ns + 50'300'000'000});
  EXPECT_EQ(trace.deliveries.size(), 3U);
  EXPECT_EQ(trace.counts.files, 1U);
  EXPECT_GT(trace.counts.files_skipped, 2U);
}

TEST(trace_reader, a_segment_that_is_being_written_is_read_and_its_cut_is_named_and_no_hole) {
  const tests::trace_folder folder;
  written_trace trace(folder.path());
  trace.add({.at_ms = 1, .actor = "a", .type = "t"});
  trace.flush();
  const auto seen = read(folder.path());
  EXPECT_EQ(seen.deliveries.size(), 1U);
  ASSERT_EQ(seen.losses.size(), 1U);
  EXPECT_EQ(seen.losses[0].kind, loss_kind::cut);
  EXPECT_FALSE(seen.losses[0].is_hole);
}

TEST(trace_reader, a_trace_that_is_being_written_is_followed_over_its_segments) {
  const tests::trace_folder folder;
  written_trace trace(folder.path(), 1, 32U << 10U);
  const std::string path = folder.path().string();
  const auto list = [&] { return find_trace_files(std::span(&path, 1)).value_or(std::vector<trace_file>{}); };
  name_table names;
  trace_reader reader({}, names);
  reader.follow(list);
  delivery each;
  EXPECT_FALSE(reader.next(each)) << "there is no file yet";
  std::uint64_t seen = 0;
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    trace.add({.at_ms = static_cast<std::int64_t>(n), .actor = "a", .type = "t", .id = n});
    if (n % 7 != 0)
      continue;
    trace.flush();
    while (reader.next(each))
      ASSERT_EQ(each.id, ++seen);
    ASSERT_EQ(seen, n);
    ASSERT_FALSE(reader.next(each)) << "and nothing twice";
  }
  EXPECT_GT(reader.counts().files, 2U);
  EXPECT_TRUE(reader.losses().empty());
}

TEST(trace_reader, missing_segments_and_a_missing_begin_are_told) {
  const tests::trace_folder folder;
  write_many(folder.path(), 2000);
  std::filesystem::remove(folder.path() / "godwit-0000000001-000001.mcap");
  std::filesystem::remove(folder.path() / "godwit-0000000001-000003.mcap");
  const auto seen = read(folder.path());
  EXPECT_TRUE(has(seen, loss_kind::begin_missing));
  EXPECT_TRUE(has(seen, loss_kind::gap));
}

TEST(trace_reader, what_the_daemon_dropped_is_told_with_its_number) {
  const tests::trace_folder folder;
  written_trace trace(folder.path());
  for (const auto* told : {R"({"dropped":5,"unwritten":0})", R"({"dropped":12,"unwritten":3})"})
    trace.add({.actor = "outside", .type = "runtime.trace_loss", .body = told});
  trace.close();
  std::uint64_t dropped = 0;
  std::uint64_t unwritten = 0;
  for (const auto& each : read(folder.path()).losses)
    (each.kind == loss_kind::dropped ? dropped : unwritten) += each.records;
  EXPECT_EQ(dropped, 12U);
  EXPECT_EQ(unwritten, 3U);
}

TEST(trace_reader, damage_anywhere_is_survived_and_told) {
  const tests::trace_folder folder;
  {
    written_trace trace(folder.path());
    for (int n = 0; n < 6; ++n) {
      trace.add({.at_ms = n, .actor = "a", .type = "t"});
      trace.flush();
    }
    trace.close();
  }
  const auto path = folder.path() / "godwit-0000000001-000001.mcap";
  std::ifstream in(path, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  const auto damaged = folder.path() / "damaged.mcap";
  for (std::size_t at = 0; at < whole.size(); at += 3) {
    auto bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
    std::ofstream(damaged, std::ios::binary) << bytes;
    const auto seen = read(damaged);
    ASSERT_GE(seen.deliveries.size(), 5U) << at;
    ASSERT_TRUE(seen.deliveries.size() == 6 || !seen.losses.empty()) << at;
  }
  for (std::size_t cut_at = 0; cut_at < whole.size(); cut_at += 11) {
    std::ofstream(damaged, std::ios::binary) << whole.substr(0, cut_at);
    ASSERT_FALSE(read(damaged).losses.empty()) << cut_at;
  }
}

TEST(trace_files, what_is_no_trace_is_refused_with_words) {
  const tests::trace_folder folder;
  const std::string empty = folder.path().string();
  const std::string absent = empty + "/absent";
  EXPECT_NE(find_trace_files(std::span(&empty, 1)).error().find("no .mcap file"), std::string::npos);
  EXPECT_NE(find_trace_files(std::span(&absent, 1)).error().find("no such file"), std::string::npos);
}

TEST(trace_files, the_folder_above_the_trace_serves_too) {
  const tests::trace_folder folder;
  write_many(folder.path() / "trace", 10, 3);
  const std::string path = folder.path().string();
  const auto found = find_trace_files(std::span(&path, 1));
  ASSERT_TRUE(found.has_value());
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ((*found)[0].run, 3U);
  EXPECT_EQ((*found)[0].number, 1U);
}

} // namespace trace_reader_test
