#include "runtime/journal/journal_reader.hpp"

#include <thread>

#include "tests/runtime/journal/journal_fixture.hpp"

namespace godwit::tests {
namespace journal_reader_test {

using namespace godwit::runtime;

class journal_reader_test : public ::testing::Test {
protected:
  scratch_folder folder;
  std::string path = folder.path("journal.db");
};

TEST_F(journal_reader_test, reads_beside_a_running_writer) {
  auto journal = open_journal({.path = path});
  auto reader = journal_reader::open(path);
  auto second_reader = journal_reader::open(path);
  ASSERT_TRUE(reader && second_reader);
  auto write = event_write("a", 1);
  write.effects = {effect_of(1, 0)};
  write.snapshot = snapshot_record{0, 1, 1, "{}"};
  ASSERT_TRUE(commit(*journal, std::move(write)));
  EXPECT_EQ(reader->events("a")->size(), 1U);
  EXPECT_EQ(second_reader->effects("a")->size(), 1U);
  EXPECT_EQ((*reader->snapshot("a"))->number, 0);
  const auto actors = *reader->actors();
  ASSERT_EQ(actors.size(), 1U);
  EXPECT_EQ(actors[0].last_event, 1);
  EXPECT_EQ(actors[0].pending_effects, 1);
  ASSERT_TRUE(commit(*journal, event_write("a", 2)));
  EXPECT_EQ(reader->events("a", 1)->at(0).number, 2);
  EXPECT_TRUE(reader->check());
}

TEST_F(journal_reader_test, many_readers_do_not_disturb_the_writer) {
  auto journal = open_journal({.path = path, .checkpoint_bytes = 128 * 1024});
  std::atomic<bool> stop{false};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i)
    readers.emplace_back([&] {
      while (!stop) {
        auto reader = journal_reader::open(path);
        ASSERT_TRUE(reader) << reader.error().message();
        const auto events = reader->events("a");
        ASSERT_TRUE(events) << events.error().message();
        for (std::size_t n = 0; n < events->size(); ++n)
          ASSERT_EQ((*events)[n].number, static_cast<std::int64_t>(n + 1));
      }
    });
  for (std::int64_t n = 1; n <= 500; ++n)
    ASSERT_TRUE(commit(*journal, event_write("a", n)));
  stop = true;
  for (auto& reader : readers)
    reader.join();
  EXPECT_EQ(journal->status().retries, 0U);
  EXPECT_TRUE(journal_reader::open(path)->check());
}

TEST_F(journal_reader_test, reads_when_the_writer_has_gone) {
  {
    auto journal = open_journal({.path = path});
    ASSERT_TRUE(commit(*journal, event_write("a", 1)));
  }
  ASSERT_FALSE(std::filesystem::exists(path + "-wal"));
  auto reader = journal_reader::open(path);
  ASSERT_TRUE(reader) << reader.error().message();
  EXPECT_EQ(reader->events("a")->size(), 1U);
  EXPECT_TRUE(open_journal({.path = path})) << "a reader does not hinder the next writer";
}

TEST_F(journal_reader_test, can_not_write) {
  { open_journal({.path = path}); }
  EXPECT_FALSE(journal_reader::open(path)->database().exec("DELETE FROM meta"));
}

TEST_F(journal_reader_test, a_missing_journal_is_missing_and_is_not_made) {
  EXPECT_EQ(journal_reader::open(path).error().code, journal_errc::missing);
  EXPECT_FALSE(std::filesystem::exists(path));
}

} // namespace journal_reader_test
} // namespace godwit::tests
