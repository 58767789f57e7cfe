// Kills a process that writes to a journal, at random, again and again on the same file.
#include <algorithm>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

#include "tests/runtime/journal/journal_fixture.hpp"
#include "tests/support/run_options.hpp"
#include "tests/support/victim.hpp"

namespace godwit::tests {
namespace sigkill_test {

using namespace godwit::runtime;
using namespace std::chrono_literals;

void note_acknowledged(const std::string& text, std::map<std::string, std::int64_t>& highest, std::int64_t& count) {
  std::istringstream lines(text);
  std::string actor;
  std::int64_t number = 0;
  while (lines >> actor >> number) {
    ++count;
    highest[actor] = std::max(highest[actor], number);
  }
}

TEST(sigkill_test, loses_no_acknowledged_event_and_the_journal_stays_sound) {
  const auto started_with = seed_of_this_run();
  const int rounds = is_full_run() ? 200 : 20;
  std::cout << "seed " << started_with << " (TEST_SEED runs it again)\n";
  std::mt19937_64 random(started_with);
  std::uniform_int_distribution<int> life_us(2'000, 40'000);
  scratch_folder folder;
  const auto path = folder.path("journal.db");
  std::map<std::string, std::int64_t> highest;
  std::int64_t acknowledged = 0;
  for (int round = 1; round <= rounds; ++round) {
    SCOPED_TRACE("round " + std::to_string(round) + ", seed " + std::to_string(started_with));
    victim running(GODWIT_JOURNAL_VICTIM, {path});
    ASSERT_TRUE(running.started());
    running.wait_for_words(20s);
    running.listen(std::chrono::microseconds(life_us(random)));
    ASSERT_TRUE(running.kill()) << "it ended by itself";
    note_acknowledged(running.said(), highest, acknowledged);
    auto journal = sqlite_journal::open({.path = path, .check = integrity_check::full});
    ASSERT_TRUE(journal) << journal.error().message();
    ASSERT_EQ((*journal)->status().run, static_cast<std::uint64_t>(2 * round))
        << "each opening counts, none starts anew";
    for (const auto& [actor, number] : highest) {
      const auto state = recover(**journal, actor, 1'000'000);
      ASSERT_TRUE(state) << state.error().message();
      ASSERT_GE(state->last_event, number) << "an acknowledged event of " << actor << " is lost";
      ASSERT_EQ(state->effects.size(), 1U) << "an event and its effect commit together";
      ASSERT_EQ(state->effects[0].id.event, state->last_event);
      // Without a gap: recover itself refuses one. The snapshot and the events after it make the whole count.
      const auto covered = state->snapshot ? state->snapshot->number : 0;
      ASSERT_EQ(covered + static_cast<std::int64_t>(state->events.size()), state->last_event);
    }
  }
  std::cout << rounds << " rounds, " << acknowledged << " acknowledged events\n";
  EXPECT_GT(acknowledged, rounds);
}

} // namespace sigkill_test
} // namespace godwit::tests
