#include "io/mcap/repair.hpp"

#include <gtest/gtest.h>

#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace repair_test {

TEST(mcap_repair, a_complete_file_is_left_alone) {
  const temporary_folder folder;
  write_small_recording(folder / "a.mcap", true);
  const byte_buffer before = load_bytes(folder / "a.mcap");
  const result<completion> done = complete(folder / "a.mcap");
  ASSERT_TRUE(done);
  EXPECT_TRUE(done->was_complete);
  EXPECT_EQ(load_bytes(folder / "a.mcap"), before);
}

TEST(mcap_repair, a_completed_file_is_the_one_that_close_would_have_written) {
  const temporary_folder folder;
  write_small_recording(folder / "closed.mcap", true);
  write_small_recording(folder / "open.mcap", false);
  const auto size_before = std::filesystem::file_size(folder / "open.mcap");
  const result<completion> done = complete(folder / "open.mcap");
  ASSERT_TRUE(done);
  EXPECT_EQ(done->messages, small_recording_messages);
  EXPECT_EQ(done->cut_bytes, 0U);
  EXPECT_EQ(std::filesystem::file_size(folder / "open.mcap"), size_before + done->added_bytes);
  EXPECT_EQ(load_bytes(folder / "open.mcap"), load_bytes(folder / "closed.mcap"));
}

TEST(mcap_repair, a_repair_that_was_stopped_at_any_byte_is_done_again_to_the_same_end) {
  const temporary_folder folder;
  write_small_recording(folder / "open.mcap", false);
  byte_buffer file = load_bytes(folder / "open.mcap");
  file.resize(file.size() - 20); // within the message index of the last chunk
  const memory_source source{file};
  const result<completion_plan> plan = plan_completion(source);
  ASSERT_TRUE(plan);
  byte_buffer whole = file;
  whole.resize(static_cast<std::size_t>(plan->keep_bytes));
  append_bytes(whole, plan->tail);
  for (std::size_t stop = static_cast<std::size_t>(plan->keep_bytes); stop <= whole.size(); ++stop) {
    store_bytes(folder / "again.mcap", byte_view{whole}.first(stop));
    const result<completion> done = complete(folder / "again.mcap");
    ASSERT_TRUE(done) << stop << ": " << done.error().message();
    ASSERT_EQ(load_bytes(folder / "again.mcap"), whole) << stop;
  }
}

TEST(mcap_repair, what_is_no_mcap_file_is_not_touched) {
  const temporary_folder folder;
  store_bytes(folder / "a.mcap", bytes_of("SQLite format 3, or whatever else this may be"));
  const byte_buffer before = load_bytes(folder / "a.mcap");
  EXPECT_EQ(complete(folder / "a.mcap").error().code, errc::malformed);
  EXPECT_EQ(load_bytes(folder / "a.mcap"), before);
  EXPECT_EQ(complete(folder / "none.mcap").error().code, errc::io);
}

} // namespace repair_test
} // namespace godwit::io::mcap::test
