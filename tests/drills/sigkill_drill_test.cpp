// Kills a process with supervised actors at random, again and again on the same journal and trace.
//
// After each kill: the journal is sound and has every key that was ever acknowledged, once; the trace that was being
// written is kept as it lies there, torn, for a reader that is not ours (tests/peers/mcap_check.mjs).
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "io/mcap/byte_source.hpp"
#include "io/mcap/repair.hpp"
#include "io/mcap/segment_folder.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/stored_state.hpp"
#include "tests/drills/deposit_actors.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/strict_mcap_reader.hpp"
#include "tests/support/victim.hpp"

namespace godwit::tests {
namespace sigkill_drill_test {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
namespace mcap = godwit::io::mcap;
using steady_clock = std::chrono::steady_clock;

constexpr auto first_words_within = 20s; // a start on a busy machine
constexpr auto trace_within = 10s;       // the flush interval is 20 ms
constexpr auto end_within = 60s;
constexpr std::int64_t last_deposits = 500; // of the life that ends in order

// -- acknowledgements ------------------------------------------------------------------------------------------------

using keys = std::set<std::int64_t>;

// Adds what one life acknowledged to ALL. Within a life nothing is acknowledged twice; over lives it may be: the kill
// came between the acknowledgement and the mark that it went out.
void add_acknowledged(const std::string& said, keys& all) {
  keys of_this_life;
  std::istringstream lines(said);
  for (std::int64_t key = 0; lines >> key;)
    EXPECT_TRUE(of_this_life.insert(key).second) << "key " << key << " was acknowledged twice in one life";
  all.merge(of_this_life);
}

// -- the journal -----------------------------------------------------------------------------------------------------

std::vector<std::int64_t> stored_keys(runtime::journal_reader& reader) {
  std::vector<std::int64_t> result;
  auto query = reader.database().prepare("SELECT key FROM deposit_row ORDER BY key");
  EXPECT_TRUE(query);
  if (!query)
    return result;
  auto row = query->step();
  for (; row && *row; row = query->step())
    result.push_back(query->integer(0));
  EXPECT_TRUE(row);
  return result;
}

// The state that a new incarnation would have.
drill::ledger_core::state recovered_ledger(runtime::journal_reader& reader, const std::string& name) {
  drill::ledger_core::state result;
  const auto snapshot = reader.snapshot(name);
  const auto events = reader.events(name);
  EXPECT_TRUE(snapshot && events) << name;
  if (!snapshot || !events)
    return result;
  if (*snapshot)
    result = runtime::read_state<drill::ledger_core>(name, **snapshot);
  for (const auto& each : *events)
    (void)drill::ledger_core::apply(
        result, runtime::read_alternative<drill::ledger_core::event>(name, each.type, each.body), each.at_ns);
  return result;
}

// Returns the number of rows.
std::size_t check_journal(const std::string& path, const keys& acknowledged) {
  auto reader = runtime::journal_reader::open(path);
  EXPECT_TRUE(reader) << reader.error().message();
  if (!reader)
    return 0;
  const auto sound = reader->check(runtime::integrity_check::full);
  EXPECT_TRUE(sound) << sound.error().message();
  const auto stored = stored_keys(*reader);
  EXPECT_EQ(std::adjacent_find(stored.begin(), stored.end()), stored.end()) << "a key was stored twice";
  keys lost;
  std::set_difference(acknowledged.begin(), acknowledged.end(), stored.begin(), stored.end(),
                      std::inserter(lost, lost.end()));
  EXPECT_TRUE(lost.empty()) << lost.size() << " acknowledged keys are lost, the first is " << *lost.begin();
  std::int64_t deposits = 0;
  for (std::uint32_t lane = 0; lane < drill::lanes; ++lane)
    deposits += recovered_ledger(*reader, drill::ledger_name(lane)).deposits;
  EXPECT_EQ(deposits, static_cast<std::int64_t>(stored.size())) << "an event and its row commit together";
  EXPECT_EQ(reader->database().query_integer("SELECT count(*) FROM dead_letter").value_or(-1), 0);
  return stored.size();
}

// -- the trace -------------------------------------------------------------------------------------------------------

// An error also when a writer that still runs deletes a segment just now.
mcap::result<std::vector<mcap::segment>> list_segments(const fs::path& folder) {
  mcap::segment_folder listed;
  if (auto opened = listed.open({.folder = folder}); !opened)
    return tl::unexpected(opened.error());
  return listed.segments();
}

std::vector<mcap::segment> segments_in(const fs::path& folder) {
  const auto listed = list_segments(folder);
  EXPECT_TRUE(listed) << listed.error().message();
  return listed.value_or(std::vector<mcap::segment>{});
}

// Messages of the drill's own types, as our streaming reader finds them before the end or the torn place.
std::size_t drill_messages(const fs::path& file) {
  mcap::file_source source;
  const auto opened = source.open(file);
  EXPECT_TRUE(opened) << opened.error().message();
  mcap::strict_mcap_reader reader(source);
  std::set<mcap::schema_id> ours_schemas;
  std::set<mcap::channel_id> ours;
  std::size_t result = 0;
  for (;;) {
    const auto item = reader.next();
    EXPECT_TRUE(item) << file << ": " << item.error().message();
    if (!item || std::holds_alternative<mcap::end_of_file>(*item) || std::holds_alternative<mcap::truncated>(*item))
      return result;
    if (const auto* schema = std::get_if<mcap::schema_record>(&*item); schema && schema->name.starts_with("drill."))
      ours_schemas.insert(schema->id);
    if (const auto* channel = std::get_if<mcap::channel_record>(&*item);
        channel && ours_schemas.contains(channel->schema))
      ours.insert(channel->id);
    if (const auto* message = std::get_if<mcap::message_record>(&*item))
      result += ours.count(message->channel);
  }
}

// The newest segments of a run that together hold a message of the drill: the newest alone, except when it has just
// been opened. Empty when there is none yet.
std::vector<fs::path> newest_trace(const std::vector<mcap::segment>& segments, std::uint64_t run) {
  std::vector<fs::path> result;
  for (auto each = segments.rbegin(); each != segments.rend() && each->run == run; ++each) {
    result.push_back(each->path);
    if (drill_messages(each->path) > 0)
      return result;
  }
  return {};
}

void expect_complete(const fs::path& folder, std::uint64_t runs) {
  std::size_t looked_at = 0;
  for (const auto& each : segments_in(folder)) {
    if (each.run > runs)
      continue;
    mcap::file_source source;
    const auto opened = source.open(each.path);
    EXPECT_TRUE(opened) << opened.error().message();
    EXPECT_TRUE(mcap::has_end(source).value_or(false)) << each.path << " was not completed at the next start";
    ++looked_at;
  }
  EXPECT_GT(looked_at, 0U);
}

// A process that was killed before its first flush has no trace. What is appended while this looks counts as torn.
void wait_for_trace(victim& running, const fs::path& folder, std::uint64_t run) {
  const auto end = steady_clock::now() + trace_within;
  const auto has_trace = [&] {
    const auto listed = list_segments(folder);
    return listed && !newest_trace(*listed, run).empty();
  };
  while (!has_trace() && steady_clock::now() < end)
    running.listen(1ms);
}

void run_independent_reader(const std::vector<fs::path>& files) {
  ASSERT_TRUE(fs::exists(fs::path(GODWIT_MCAP_CHECK).parent_path() / "node_modules"))
      << "the independent reader is not installed: run ./dev test, or npm ci --ignore-scripts in tests/peers";
  std::vector<std::string> arguments{GODWIT_MCAP_CHECK};
  for (const auto& each : files)
    arguments.push_back(each.string());
  victim reader(GODWIT_NODE, arguments);
  ASSERT_TRUE(reader.started()) << GODWIT_NODE << " can not be started: install nodejs";
  const int status = reader.wait_for_end(120s);
  std::istringstream lines(reader.said());
  std::size_t errors = 0;
  std::size_t read = 0;
  for (std::string line; std::getline(lines, line); ++read)
    if (line.find(": ERROR: ") != std::string::npos && ++errors <= 10)
      ADD_FAILURE() << line;
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read, files.size());
}

// -- the drill -------------------------------------------------------------------------------------------------------

class sigkill_drill {
public:
  explicit sigkill_drill(std::uint64_t seed) : random_(seed) {}

  // One life of the process, which ends by SIGKILL, and the look at what it left.
  void round(std::uint64_t number) {
    victim running(GODWIT_ACTOR_VICTIM, {folder_.path("")});
    ASSERT_TRUE(running.started());
    running.wait_for_words(first_words_within);
    ASSERT_FALSE(running.said().empty()) << "it acknowledges nothing";
    running.listen(std::chrono::microseconds(life_us_(random_)));
    wait_for_trace(running, trace_, number);
    ASSERT_TRUE(running.kill()) << "it ended by itself";
    add_acknowledged(running.said(), acknowledged_);
    rows_ = check_journal(journal_, acknowledged_);
    if (number > 1)
      expect_complete(trace_, number - 1);
    keep_trace(number);
  }

  // One life that ends in order. After it nothing is torn and nothing is owed.
  void last_life(std::uint64_t number) {
    victim running(GODWIT_ACTOR_VICTIM, {folder_.path(""), std::to_string(last_deposits)});
    ASSERT_TRUE(running.started());
    EXPECT_EQ(running.wait_for_end(end_within), 0);
    add_acknowledged(running.said(), acknowledged_);
    rows_ = check_journal(journal_, acknowledged_);
    EXPECT_EQ(acknowledged_.size(), rows_) << "what was stored before a kill is acknowledged by a later life";
    expect_complete(trace_, number);
    for (const auto& each : segments_in(trace_))
      kept_.push_back(each.path);
  }

  void read_traces() const { run_independent_reader(kept_); }
  [[nodiscard]] std::size_t acknowledged() const { return acknowledged_.size(); }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t files() const { return kept_.size(); }

private:
  void keep_trace(std::uint64_t number) {
    const auto newest = newest_trace(segments_in(trace_), number);
    ASSERT_FALSE(newest.empty()) << "no message of the drill is in the trace of this round";
    const fs::path folder = folder_.path("round_" + std::to_string(number));
    fs::create_directories(folder);
    for (const auto& each : newest) {
      kept_.push_back(folder / each.filename());
      fs::copy_file(each, kept_.back());
    }
  }

  std::mt19937_64 random_;
  std::uniform_int_distribution<int> life_us_{5'000, 60'000};
  scratch_folder folder_;
  const std::string journal_ = folder_.path("journal.db");
  const fs::path trace_ = folder_.path("trace");
  keys acknowledged_;
  std::size_t rows_ = 0;
  std::vector<fs::path> kept_;
};

TEST(sigkill_drill, loses_nothing_acknowledged_and_every_trace_can_be_read) {
  const auto seed = seed_of_this_run();
  const std::uint64_t rounds = is_full_run() ? 200 : 40;
  std::cout << "seed " << seed << " (TEST_SEED runs it again)\n";
  sigkill_drill drill(seed);
  const auto began = steady_clock::now();
  for (std::uint64_t number = 1; number <= rounds; ++number) {
    SCOPED_TRACE("round " + std::to_string(number) + ", seed " + std::to_string(seed));
    drill.round(number);
    if (HasFailure())
      return;
  }
  const std::chrono::duration<double, std::milli> took = steady_clock::now() - began;
  drill.last_life(rounds + 1);
  drill.read_traces();
  std::cout << rounds << " rounds, " << took.count() / static_cast<double>(rounds) << " ms each; "
            << drill.acknowledged() << " keys acknowledged, " << drill.rows() << " stored; " << drill.files()
            << " trace files read\n";
  EXPECT_GT(drill.acknowledged(), rounds);
}

} // namespace sigkill_drill_test
} // namespace godwit::tests
