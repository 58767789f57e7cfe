#include "io/mavlink/tlog/read_window.hpp"

#include <gtest/gtest.h>

#include "tests/io/mavlink/tlog/tlog_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace read_window_test {

TEST(mavlink_read_window, passes_over_a_file_of_several_windows_without_a_gap) {
  byte_buffer all(3 * read_window::window_bytes + 17);
  std::mt19937_64 random(3);
  for (auto& each : all)
    each = static_cast<std::byte>(random());
  const mcap::memory_source source(all);
  read_window window(source);
  byte_buffer seen;
  for (;;) {
    ASSERT_TRUE(window.require(1000));
    if (window.bytes().empty())
      break;
    EXPECT_EQ(window.offset(), seen.size());
    EXPECT_TRUE(window.bytes().size() >= 1000 || window.offset() + window.bytes().size() == all.size());
    EXPECT_LE(window.bytes().size(), read_window::window_bytes);
    const auto count = std::min<std::size_t>(window.bytes().size(), random() % 999 + 1);
    append(seen, window.bytes().first(count));
    window.drop(count);
  }
  EXPECT_EQ(seen, all);
}

TEST(mavlink_read_window, hands_on_an_error_of_the_source) {
  const temporary_folder folder;
  std::filesystem::create_directory(folder / "sub");
  mcap::file_source source;
  ASSERT_TRUE(source.open(folder / "sub"));
  read_window window(source);
  const auto outcome = window.require(1);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, mcap::errc::io);
}

} // namespace read_window_test
} // namespace godwit::io::mavlink::test
