#include "runtime/journal/memory_copy.hpp"

#include <gtest/gtest.h>

#include "runtime/journal/journal_file.hpp"
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
} // namespace godwit::tests
