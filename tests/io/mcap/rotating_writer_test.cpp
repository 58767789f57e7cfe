#include "io/mcap/rotating_writer.hpp"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace rotating_writer_test {

constexpr std::uint64_t millisecond_ns = 1'000'000;

class mcap_rotating_writer : public testing::Test {
protected:
  void SetUp() override {
    options_.segments = {folder_.path(), "godwit", 32 << 10, 128 << 10};
    options_.run = 5;
    options_.run_info = {{"host", "test"}};
    const auto schema = writer_.add_schema("numbered", "jsonschema", bytes_of(schema_text()));
    channel_ = writer_.add_channel(*schema, "/even", "json").value();
  }
  result<void> put(std::uint32_t n) {
    const std::string payload = payload_of(n);
    return writer_.write({channel_, n, 1000 + n, 900 + n, bytes_of(payload)});
  }
  std::vector<reading> read_segments() {
    std::vector<reading> all;
    for (const segment& s : writer_.folder().segments()) {
      all.push_back(read_file(s.path));
    }
    return all;
  }

  temporary_folder folder_;
  rotating_writer_options options_;
  rotating_writer writer_;
  channel_id channel_{};
};

// The limit of the process for the size of a file acts as a disk that is full, and can be lifted again.
class file_size_limit {
public:
  explicit file_size_limit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit lowered{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &lowered);
  }
  ~file_size_limit() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  file_size_limit(const file_size_limit&) = delete;
  file_size_limit& operator=(const file_size_limit&) = delete;

private:
  rlimit before_{};
};

TEST_F(mcap_rotating_writer, every_segment_is_whole_by_itself_and_within_its_size) {
  ASSERT_TRUE(writer_.open(options_));
  std::uint32_t n = 0;
  for (; writer_.counts().segments_opened < 4; ++n) {
    ASSERT_TRUE(put(n));
    if (n % 16 == 0) { // what is not flushed is reckoned as it is before it is compressed
      ASSERT_TRUE(writer_.flush());
    }
  }
  ASSERT_TRUE(writer_.close());
  std::uint32_t expected = 0;
  for (const reading& seen : read_segments()) {
    EXPECT_EQ(seen.end, ending::complete) << seen.failure.message();
    EXPECT_EQ(seen.schemas, std::vector<std::string>{"numbered"});
    EXPECT_EQ(seen.metadata, std::vector<std::string>{"godwit.run"});
    for (const seen_message& message : seen.messages) {
      EXPECT_EQ(message.sequence, expected++);
      EXPECT_EQ(message.topic, "/even");
    }
  }
  EXPECT_EQ(expected, n);
  EXPECT_EQ(writer_.counts().messages_flushed, n);
  for (const segment& s : writer_.folder().segments()) {
    EXPECT_LE(s.size_bytes, options_.segments.segment_bytes);
    EXPECT_EQ(s.size_bytes, std::filesystem::file_size(s.path));
  }
  EXPECT_GT(writer_.folder().segments().front().size_bytes, options_.segments.segment_bytes * 95 / 100);
}

TEST_F(mcap_rotating_writer, the_folder_stays_within_its_bound_and_keeps_the_newest) {
  ASSERT_TRUE(writer_.open(options_));
  std::uint32_t n = 0;
  for (; writer_.counts().segments_opened < 12; ++n) {
    ASSERT_TRUE(put(n));
    if (n % 64 == 0) {
      ASSERT_TRUE(writer_.flush());
      std::uint64_t bytes = 0;
      for (const auto& entry : std::filesystem::directory_iterator{folder_.path()}) {
        bytes += entry.file_size();
      }
      ASSERT_LE(bytes, options_.segments.total_bytes);
    }
  }
  ASSERT_TRUE(writer_.close());
  EXPECT_GE(writer_.counts().segments_deleted, 8U);
  EXPECT_EQ(read_segments().back().messages.back().sequence, n - 1);
}

TEST_F(mcap_rotating_writer, a_tick_flushes_at_its_cadence) {
  ASSERT_TRUE(writer_.open(options_));
  ASSERT_TRUE(writer_.tick(1000 * millisecond_ns));
  ASSERT_TRUE(put(1));
  ASSERT_TRUE(writer_.tick(1050 * millisecond_ns));
  EXPECT_TRUE(read_file(writer_.current_segment()).messages.empty());
  ASSERT_TRUE(writer_.tick(1100 * millisecond_ns));
  EXPECT_EQ(read_file(writer_.current_segment()).messages.size(), 1U);
}

TEST_F(mcap_rotating_writer, a_folder_that_is_removed_under_way_is_noticed_and_a_new_one_is_written) {
  options_.segments.folder = folder_.path() / "trace";
  ASSERT_TRUE(writer_.open(options_));
  ASSERT_TRUE(writer_.tick(1'000 * millisecond_ns));
  ASSERT_TRUE(put(1));
  ASSERT_TRUE(writer_.tick(1'100 * millisecond_ns));
  const auto removed = writer_.current_segment();
  std::filesystem::remove_all(options_.segments.folder);
  ASSERT_TRUE(put(2));
  const auto noticed = writer_.tick(2'200 * millisecond_ns);
  ASSERT_FALSE(noticed);
  EXPECT_EQ(noticed.error().code, errc::gone) << noticed.error().message();
  ASSERT_TRUE(writer_.tick(3'300 * millisecond_ns));
  ASSERT_TRUE(put(3));
  ASSERT_TRUE(writer_.flush());
  EXPECT_NE(writer_.current_segment(), removed) << "its name is not used twice";
  const auto seen = read_file(writer_.current_segment());
  ASSERT_EQ(seen.messages.size(), 1U);
  EXPECT_EQ(seen.messages[0].sequence, 3U);
  EXPECT_EQ(seen.metadata, (std::vector<std::string>{"godwit.run", "godwit.lost"}));
}

TEST_F(mcap_rotating_writer, a_message_that_fits_into_no_segment_is_refused_and_counted) {
  ASSERT_TRUE(writer_.open(options_));
  const std::string large(options_.segments.segment_bytes, 'x');
  EXPECT_EQ(writer_.write({channel_, 0, 0, 0, bytes_of(large)}).error().code, errc::too_large);
  EXPECT_EQ(writer_.counts().messages_lost, 1U);
  EXPECT_FALSE(writer_.has_failed());
  EXPECT_TRUE(put(1));
}

TEST_F(mcap_rotating_writer, after_a_full_disk_it_goes_on_and_says_what_was_lost) {
  ASSERT_TRUE(writer_.open(options_));
  ASSERT_TRUE(writer_.tick(1));
  ASSERT_TRUE(put(0));
  ASSERT_TRUE(writer_.flush());
  {
    const file_size_limit full{std::filesystem::file_size(writer_.current_segment()) + 20};
    ASSERT_TRUE(put(1));
    const result<void> flushed = writer_.flush();
    ASSERT_FALSE(flushed);
    EXPECT_TRUE(writer_.has_failed());
    EXPECT_FALSE(put(2));
    EXPECT_FALSE(writer_.tick(1 + options_.retry_interval_ns - 1));
  }
  ASSERT_TRUE(writer_.tick(1 + options_.retry_interval_ns));
  EXPECT_FALSE(writer_.has_failed());
  ASSERT_TRUE(put(3));
  ASSERT_TRUE(writer_.close());
  const rotating_writer_counts counts = writer_.counts();
  EXPECT_EQ(counts.messages_flushed, 2U);
  EXPECT_EQ(counts.messages_lost, 2U);
  EXPECT_EQ(counts.failures, 1U);
  const std::vector<reading> segments = read_segments();
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].end, ending::complete) << "the broken segment was completed";
  EXPECT_EQ(segments[0].messages, std::vector{numbered(0)});
  EXPECT_EQ(segments[1].messages.at(0).sequence, 3U);
  EXPECT_EQ(segments[1].metadata, (std::vector<std::string>{"godwit.run", "godwit.lost"}));
}

TEST_F(mcap_rotating_writer, while_the_disk_is_full_no_empty_segments_gather) {
  ASSERT_TRUE(writer_.open(options_));
  const file_size_limit full{10};
  for (std::uint32_t n = 0; n < 5; ++n) {
    EXPECT_FALSE(put(n));
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
    EXPECT_TRUE(writer_.tick((n + 1) * options_.retry_interval_ns));
  }
  EXPECT_EQ(writer_.counts().messages_lost, 5U);
}

TEST_F(mcap_rotating_writer, an_unwritable_folder_is_an_explicit_error) {
  ASSERT_TRUE(writer_.open(options_));
  std::filesystem::remove_all(folder_.path());
  const result<void> written = put(1);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, errc::io);
  EXPECT_NE(written.error().message().find("godwit-0000000005-000001.mcap"), std::string::npos);
}

} // namespace rotating_writer_test
} // namespace godwit::io::mcap::test
