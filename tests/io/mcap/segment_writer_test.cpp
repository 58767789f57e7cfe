#include "io/mcap/segment_writer.hpp"

#include <gtest/gtest.h>

#include "io/mcap/repair.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace segment_writer_test {

TEST(mcap_segment_writer, what_was_written_is_read_back_in_order) {
  const temporary_folder folder;
  write_small_recording(folder / "a.mcap", true);
  const reading seen = read_file(folder / "a.mcap");
  EXPECT_EQ(seen.end, ending::complete) << seen.failure.message();
  EXPECT_TRUE(seen.library.starts_with("godwit ")) << seen.library;
  ASSERT_EQ(seen.messages.size(), small_recording_messages);
  for (std::uint32_t n = 0; n < small_recording_messages; ++n) {
    EXPECT_EQ(seen.messages[n], numbered(n));
  }
  EXPECT_EQ(seen.schemas, std::vector<std::string>{"numbered"});
  EXPECT_EQ(seen.metadata, std::vector<std::string>{"godwit.run"});
  EXPECT_EQ(seen.statistics.message_count, small_recording_messages);
  EXPECT_EQ(seen.statistics.channel_count, 2U);
  EXPECT_EQ(seen.statistics.schema_count, 1U);
  EXPECT_EQ(seen.statistics.chunk_count, 3U);
  EXPECT_EQ(seen.statistics.metadata_count, 1U);
  EXPECT_EQ(seen.statistics.start_time_ns, 1000U);
  EXPECT_EQ(seen.statistics.end_time_ns, 1011U);
}

TEST(mcap_segment_writer, what_was_flushed_is_in_the_file_at_once) {
  const temporary_folder folder;
  const two_channels channels;
  segment_writer writer{channels.registry};
  ASSERT_TRUE(writer.open(folder / "a.mcap"));
  EXPECT_EQ(read_file(folder / "a.mcap").end, ending::truncated);
  for (std::uint32_t n = 0; n < 5; ++n) {
    ASSERT_TRUE(write_numbered(writer, channels, n));
    EXPECT_EQ(writer.messages_flushed(), n);
    ASSERT_TRUE(writer.flush());
    const reading seen = read_file(folder / "a.mcap");
    EXPECT_EQ(seen.messages.size(), n + 1);
    EXPECT_EQ(seen.end, ending::truncated);
    EXPECT_EQ(seen.torn.file_bytes, writer.bytes_written());
  }
  EXPECT_EQ(writer.messages_flushed(), 5U);
}

TEST(mcap_segment_writer, an_empty_recording_is_a_valid_file) {
  const temporary_folder folder;
  const channel_registry registry;
  segment_writer writer{registry};
  ASSERT_TRUE(writer.open(folder / "a.mcap"));
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(read_file(folder / "a.mcap").end, ending::complete);
  EXPECT_EQ(writer.write({}).error().code, errc::not_open);
}

TEST(mcap_segment_writer, a_full_chunk_is_flushed_without_being_asked) {
  const temporary_folder folder;
  const two_channels channels;
  segment_writer writer{channels.registry};
  ASSERT_TRUE(writer.open(folder / "a.mcap"));
  const std::string payload(200'000, 'x');
  for (std::uint32_t n = 0; n < 6; ++n) {
    ASSERT_TRUE(writer.write({channels.even, n, n, n, bytes_of(payload)}));
  }
  EXPECT_GT(writer.messages_flushed(), 0U);
}

TEST(mcap_segment_writer, a_refused_message_changes_nothing) {
  const temporary_folder folder;
  const two_channels channels;
  segment_writer writer{channels.registry};
  ASSERT_TRUE(writer.open(folder / "a.mcap"));
  const std::string large(max_payload_bytes + 1, 'x');
  EXPECT_EQ(writer.write({channels.even, 0, 0, 0, bytes_of(large)}).error().code, errc::too_large);
  EXPECT_EQ(writer.write({channel_id{77}, 0, 0, 0, {}}).error().code, errc::invalid_argument);
  ASSERT_TRUE(write_numbered(writer, channels, 0));
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(read_file(folder / "a.mcap").messages.size(), 1U);
}

TEST(mcap_segment_writer, an_existing_file_is_never_overwritten) {
  const temporary_folder folder;
  write_small_recording(folder / "a.mcap", true);
  const channel_registry registry;
  segment_writer writer{registry};
  EXPECT_EQ(writer.open(folder / "a.mcap").error().code, errc::io);
  EXPECT_EQ(read_file(folder / "a.mcap").messages.size(), small_recording_messages);
}

TEST(mcap_segment_writer, a_full_disk_is_an_error_value_and_stays_one) {
  const two_channels channels;
  segment_writer writer{channels.registry};
  const result<void> opened = writer.open("/dev/full");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, errc::disk_full);
  EXPECT_EQ(opened.error().message(), "/dev/full: disk full: write: No space left on device");
  EXPECT_FALSE(writer.is_open());
  EXPECT_EQ(write_numbered(writer, channels, 0).error().code, errc::disk_full);
  EXPECT_EQ(writer.flush().error().code, errc::disk_full);
  EXPECT_EQ(writer.close().error().code, errc::disk_full);
  writer.abandon();
  EXPECT_EQ(writer.flush().error().code, errc::not_open);
}

TEST(mcap_segment_writer, the_announced_size_is_an_upper_bound_of_the_closed_file) {
  const temporary_folder folder;
  const two_channels channels;
  segment_writer writer{channels.registry};
  ASSERT_TRUE(writer.open(folder / "a.mcap"));
  std::uint64_t announced_bytes = 0;
  for (std::uint32_t n = 0; n < 500; ++n) {
    announced_bytes = writer.closed_bytes_with(channels.of(n), payload_of(n).size());
    ASSERT_TRUE(write_numbered(writer, channels, n));
    if (n % 7 == 0) {
      ASSERT_TRUE(writer.flush());
    }
  }
  ASSERT_TRUE(writer.close());
  EXPECT_LE(writer.bytes_written(), announced_bytes);
  EXPECT_LE(announced_bytes, writer.bytes_written() + 300) << "and not far from it";
}

} // namespace segment_writer_test
} // namespace godwit::io::mcap::test
