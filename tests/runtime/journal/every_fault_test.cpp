// The same short story again and again, and each time another operation on the disk fails: every open, write, sync,
// truncate and delete in turn, by I/O error, full disk and torn write, once and from then on, and by a power cut that
// loses what was not synced. What must hold afterwards: an explicit error or a clean recovery, and nothing acknowledged
// is lost.
#include <cstdlib>
#include <iostream>
#include <map>
#include <thread>

#include "io/sqlite/fault_vfs.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace every_fault_test {

using io::sqlite::fault_kind;
using io::sqlite::fault_vfs;
using namespace godwit::runtime;
using namespace std::chrono_literals;

constexpr std::int64_t events_each = 10;
constexpr std::int64_t snapshot_at = 5;
const std::vector<std::string> actors{"executor", "mission_client"};

// Highest acknowledged event of each actor.
using acknowledged = std::map<std::string, std::int64_t>;

journal_options options_of(const std::string& path, const char* vfs) {
  return {.path = path,
          .tables = {{"typed", {"CREATE TABLE typed(actor TEXT, event INTEGER)"}}},
          .vfs = vfs,
          .checkpoint_bytes = 64 * 1024, // a checkpoint or two within the story
          .retry_min = 1ms,
          .retry_max = 2ms,
          .close_timeout = 5ms};
}

// Each event brings two effects, releases those of the event before, and writes a row into every kind of table.
journal_write chapter(const std::string& actor, std::int64_t n) {
  auto write = event_write(actor, n);
  write.events.front().body = std::string(700, 'e');
  write.effects = {effect_of(n, 0), effect_of(n, 1)};
  if (n > 1)
    write.released = {{n - 1, 0}, {n - 1, 1}};
  if (n == snapshot_at)
    write.snapshot = snapshot_record{n, n, 1, std::string(5'000, 's')};
  write.seen = {{"source", {n, 0}}};
  write.rows = {{"INSERT INTO typed VALUES (?, ?)", {actor, n}}};
  write.outbox = {{.idempotency_key = actor + std::to_string(n),
                   .destination = "progress",
                   .body = "{}",
                   .created_ns = n,
                   .last_error = ""}};
  return write;
}

// True when acknowledged. Gives up when the disk will never work again.
bool commits(sqlite_journal& journal, journal_write write, bool for_ever) {
  auto result = submit(journal, std::move(write));
  while (result.wait_for(200us) != std::future_status::ready)
    if (for_ever && journal.status().failing)
      return false;
  return result.get().has_value();
}

// One write at a time, so that the operations on the disk have the same numbers each time.
acknowledged tell_story(const std::string& path, bool for_ever) {
  acknowledged acked;
  auto opened = sqlite_journal::open(options_of(path, fault_vfs::name));
  if (!opened) {
    EXPECT_FALSE(opened.error().what.empty());
    EXPECT_FALSE(opened.error().remedy.empty());
    EXPECT_EQ(opened.error().file, path);
    return acked;
  }
  for (std::int64_t n = 1; n <= events_each; ++n)
    for (const auto& actor : actors) {
      if (!commits(**opened, chapter(actor, n), for_ever))
        return acked;
      acked[actor] = n;
    }
  return acked; // the journal closes here, as far as the fault lets it
}

void expect_whole(const recovered& state, journal_reader& reader, const std::string& actor) {
  const auto last = state.last_event;
  ASSERT_EQ(state.snapshot.has_value(), last >= snapshot_at);
  ASSERT_EQ(static_cast<std::int64_t>(state.events.size()), last >= snapshot_at ? last - snapshot_at : last);
  ASSERT_EQ(state.effects.size(), last > 0 ? 2U : 0U);
  if (last > 0) {
    ASSERT_EQ(state.effects[0].id, (effect_id{last, 0}));
    ASSERT_EQ(state.seen.at(0).upto, (effect_id{last, 0}));
  }
  ASSERT_EQ(static_cast<std::int64_t>(reader.outbox(actor)->size()), last);
  const auto typed = reader.database().query_integer("SELECT count(*) FROM typed WHERE actor = '" + actor + "'");
  ASSERT_EQ(typed.value(), last);
}

void expect_nothing_lost(const std::string& path, const acknowledged& acked) {
  auto journal = sqlite_journal::open(options_of(path, ""));
  ASSERT_TRUE(journal) << journal.error().message();
  auto reader = journal_reader::open(path);
  ASSERT_TRUE(reader);
  ASSERT_TRUE(reader->check(integrity_check::full));
  for (const auto& actor : actors) {
    const auto state = recover(**journal, actor);
    ASSERT_TRUE(state) << state.error().message();
    const auto found = acked.find(actor);
    const auto promised = found == acked.end() ? 0 : found->second;
    ASSERT_GE(state->last_event, promised) << "an acknowledged event of " << actor << " is lost";
    ASSERT_LE(state->last_event, promised + 1);
    expect_whole(*state, *reader, actor);
    ASSERT_TRUE(commit(**journal, chapter(actor, state->last_event + 1))) << "it goes on";
  }
}

std::int64_t count_operations() {
  scratch_folder folder;
  fault_vfs::instance().disarm();
  const auto acked = tell_story(folder.path("journal.db"), false);
  EXPECT_EQ(acked.at(actors[0]), events_each);
  return fault_vfs::instance().operations();
}

class every_fault_test : public ::testing::TestWithParam<std::tuple<fault_kind, bool>> {
protected:
  ~every_fault_test() override { fault_vfs::instance().disarm(); }
};

TEST_P(every_fault_test, ends_in_an_explicit_error_or_a_clean_recovery) {
  const auto [kind, from_then_on] = GetParam();
  const auto operations = count_operations();
  ASSERT_GT(operations, 60);
  for (std::int64_t at = 1; at <= operations; ++at) {
    SCOPED_TRACE("operation " + std::to_string(at) + " of " + std::to_string(operations));
    scratch_folder folder;
    const auto path = folder.path("journal.db");
    fault_vfs::instance().arm({kind, at, from_then_on});
    const auto acked = tell_story(path, from_then_on);
    fault_vfs::instance().disarm();
    expect_nothing_lost(path, acked);
    if (HasFatalFailure() || HasNonfatalFailure())
      return;
  }
  std::cout << operations << " operations\n";
  RecordProperty("operations", static_cast<int>(operations));
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<fault_kind, bool>>& info) {
  const auto kind = std::get<0>(info.param);
  const std::string name = kind == fault_kind::io_error    ? "io_error"
                           : kind == fault_kind::disk_full ? "disk_full"
                                                           : "torn_write";
  return name + (std::get<1>(info.param) ? "_from_then_on" : "_once");
}

INSTANTIATE_TEST_SUITE_P(each, every_fault_test,
                         ::testing::Combine(::testing::Values(fault_kind::io_error, fault_kind::disk_full,
                                                              fault_kind::torn_write),
                                            ::testing::Bool()),
                         name_of);

class power_cut_test : public ::testing::TestWithParam<bool> {
protected:
  ~power_cut_test() override { fault_vfs::instance().disarm(); }
};

TEST_P(power_cut_test, loses_nothing_acknowledged) {
  const bool some_writes_survive = GetParam();
  const auto operations = count_operations();
  for (std::int64_t at = 1; at <= operations; ++at) {
    SCOPED_TRACE("power cut at operation " + std::to_string(at) + " of " + std::to_string(operations));
    scratch_folder folder;
    const auto path = folder.path("journal.db");
    auto& vfs = fault_vfs::instance();
    vfs.track_unsynced();
    vfs.arm({fault_kind::torn_write, at, true});
    const auto acked = tell_story(path, true);
    vfs.disarm();
    vfs.cut_power(some_writes_survive ? std::optional<std::uint64_t>(at) : std::nullopt);
    expect_nothing_lost(path, acked);
    if (HasFatalFailure() || HasNonfatalFailure())
      return;
  }
}

INSTANTIATE_TEST_SUITE_P(each, power_cut_test, ::testing::Bool(), [](const auto& cut) {
  return cut.param ? "some_unsynced_writes_survive" : "no_unsynced_write_survives";
});

// The proof that the power cut above bites: with a disk that only pretends to sync, acknowledged events are lost.
TEST(power_cut_proof_test, a_disk_that_lies_about_syncing_loses_acknowledged_events) {
  scratch_folder folder;
  const auto path = folder.path("journal.db");
  auto& vfs = fault_vfs::instance();
  vfs.disarm();
  { open_journal(options_of(path, fault_vfs::name)); }
  auto journal = open_journal(options_of(path, fault_vfs::name));
  vfs.track_unsynced();
  vfs.set_lying(true);
  ASSERT_TRUE(commit(*journal, chapter("executor", 1)));
  vfs.arm({fault_kind::io_error, 1, true});
  journal.reset();
  vfs.disarm();
  vfs.cut_power(std::nullopt);
  EXPECT_EQ(recover(*open_journal(options_of(path, "")), "executor")->last_event, 0);
}

} // namespace every_fault_test
} // namespace godwit::tests
