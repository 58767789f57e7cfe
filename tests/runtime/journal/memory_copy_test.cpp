#include <random>

#include <gtest/gtest.h>

#include "runtime/journal/journal_file.hpp"
#include "runtime/journal/memory_copy.hpp"
#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {

namespace memory_copy_test {

using namespace runtime;

TEST(memory_copy, a_new_file_made_of_it_holds_what_the_old_one_held) {
  const scratch_folder folder;
  memory_copy copy;
  copy.note(event_write("anna", 1));
  auto covered = event_write("anna", 2);
  covered.snapshot = snapshot_record{2, 7, 1, "{}"};
  covered.effects = {effect_of(2, 0), effect_of(2, 1)};
  covered.seen = {{"bert", {4, 1}}};
  copy.note(covered);
  auto later = event_write("anna", 3);
  later.released = {{2, 0}};
  copy.note(later);
  copy.note(event_write("bert", 1));
  auto file = open_for_writing({folder.path("new.db"), "", true, integrity_check::quick, {}});
  ASSERT_TRUE(file);
  record_store store(file->db);
  ASSERT_TRUE(copy.write_to(store));
  const auto anna = store.read("anna");
  ASSERT_TRUE(anna);
  EXPECT_EQ(anna->snapshot->number, 2);
  ASSERT_EQ(anna->events.size(), 1U);
  EXPECT_EQ(anna->last_event, 3);
  ASSERT_EQ(anna->effects.size(), 1U);
  EXPECT_EQ(anna->effects[0].id.n, 1U);
  EXPECT_EQ(anna->seen.size(), 1U);
  EXPECT_EQ(store.read("bert")->last_event, 1);
  store.close();
}

TEST(memory_copy, an_actor_that_it_does_not_know_is_as_new) { EXPECT_EQ(memory_copy().of("nobody").last_event, 0); }

} // namespace memory_copy_test

namespace overlay_test {

using namespace godwit::runtime;

// A write as some actor might make it: effects, releases of any of those before, a snapshot now and then.
journal_write random_write(std::mt19937_64& random, std::int64_t number, std::vector<effect_id>& open) {
  auto write = event_write("a", number);
  const auto effects = static_cast<std::uint32_t>(random() % 3);
  for (std::uint32_t n = 0; n < effects; ++n) {
    write.effects.push_back(effect_of(number, n));
    open.push_back({number, n});
  }
  while (!open.empty() && random() % 2 == 0) {
    const auto which = static_cast<std::ptrdiff_t>(random() % open.size());
    write.released.push_back(open[static_cast<std::size_t>(which)]);
    open.erase(open.begin() + which);
  }
  if (random() % 5 == 0)
    write.snapshot = snapshot_record{number, number, 1, "{}"};
  if (random() % 2 == 0)
    write.seen.push_back({std::string(1, static_cast<char>('a' + random() % 4)),
                          {static_cast<std::int64_t>(random() % 50), static_cast<std::uint32_t>(random() % 3)}});
  return write;
}

TEST(overlay_test, tells_what_the_database_will_tell) {
  const std::uint64_t seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 20; ++round) {
    scratch_folder folder;
    auto journal = open_journal({.path = folder.path("journal.db")});
    recovered laid;
    std::vector<effect_id> open;
    for (std::int64_t n = 1; n <= 40; ++n) {
      const auto write = random_write(random, n, open);
      lay_over(laid, write);
      ASSERT_TRUE(journal->submit(journal_write(write)));
    }
    const auto read = recover(*journal, "a");
    ASSERT_TRUE(read);
    ASSERT_EQ(read->last_event, laid.last_event) << "seed " << seed;
    ASSERT_EQ(read->snapshot.has_value(), laid.snapshot.has_value());
    ASSERT_EQ(read->events.size(), laid.events.size()) << "seed " << seed;
    for (std::size_t i = 0; i < laid.events.size(); ++i)
      ASSERT_EQ(read->events[i].body, laid.events[i].body);
    ASSERT_EQ(read->effects.size(), laid.effects.size()) << "seed " << seed;
    for (std::size_t i = 0; i < laid.effects.size(); ++i)
      ASSERT_EQ(read->effects[i].id, laid.effects[i].id);
    ASSERT_EQ(read->seen.size(), laid.seen.size()) << "seed " << seed;
    for (std::size_t i = 0; i < laid.seen.size(); ++i)
      ASSERT_EQ(read->seen[i].upto, laid.seen[i].upto);
  }
}

} // namespace overlay_test

} // namespace godwit::tests
