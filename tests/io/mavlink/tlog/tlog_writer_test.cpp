#include "io/mavlink/tlog/tlog_writer.hpp"

#include <csignal>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/resource.h>

#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "tests/io/mavlink/tlog/tlog_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace tlog_writer_test {

namespace fs = std::filesystem;

frame_buffer some_heartbeat(std::uint8_t sequence = 0, signing sign = signing::off) {
  return encode(heartbeat{}, sender{255, 190}, sequence, sign);
}

frame_buffer signed_frame() {
  const std::array<std::byte, secret_key_size> key{std::byte{1}};
  signer out(secret_key(key), link_id{0}, signing_time{1000});
  auto frame = some_heartbeat(7, signing::on);
  EXPECT_TRUE(out.sign(frame, 0));
  return frame;
}

// The smallest files that are allowed, and a log that does not fit into one.
tlog_writer_options small_files(const fs::path& file, unsigned older_files) {
  return {file, tlog_writer::buffer_bytes, older_files};
}
constexpr std::size_t heartbeat_record_size = tlog_time_size + 21;
constexpr std::size_t heartbeats_in_a_file = tlog_writer::buffer_bytes / heartbeat_record_size;

void write_heartbeats(tlog_writer& writer, std::size_t from, std::size_t count) {
  for (std::size_t i = from; i < from + count; ++i)
    ASSERT_TRUE(writer.write(some_day_us + i, some_heartbeat().view()));
}

TEST(mavlink_tlog_writer, a_record_is_eight_bytes_of_time_high_byte_first_and_the_frame) {
  const temporary_folder folder;
  {
    tlog_writer writer;
    ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
    ASSERT_TRUE(writer.write(0x0006'60C2'8CDC'55E6, some_heartbeat().view()));
  }
  EXPECT_EQ(read_file(folder / "flight.tlog").records.size(), 1U);
  std::ifstream file(folder / "flight.tlog", std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(to_hex(std::as_bytes(std::span(content))), "000660c28cdc55e6" + to_hex(some_heartbeat().span()));
}

TEST(mavlink_tlog_writer, no_file_is_made_before_there_is_something_to_write) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
  ASSERT_TRUE(writer.flush());
  ASSERT_TRUE(writer.close());
  EXPECT_FALSE(fs::exists(folder / "flight.tlog"));
}

TEST(mavlink_tlog_writer, flush_hands_everything_to_the_kernel) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
  write_heartbeats(writer, 0, 3);
  EXPECT_EQ(writer.counts().frames_written, 0U);
  ASSERT_TRUE(writer.flush());
  EXPECT_EQ(writer.counts().frames_written, 3U);
  EXPECT_EQ(read_file(folder / "flight.tlog").records.size(), 3U);
}

TEST(mavlink_tlog_writer, signatures_are_taken_off) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
  ASSERT_TRUE(writer.write(some_day_us, signed_frame().view()));
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(read_file(folder / "flight.tlog").records,
            (std::vector<plain_record>{{some_day_us, to_hex(some_heartbeat(7).span())}}));
}

TEST(mavlink_tlog_writer, the_key_is_never_written) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
  setup_signing secret;
  secret.secret_key.fill('K');
  ASSERT_TRUE(writer.write(some_day_us, encode(secret, sender{255, 190}, 0).view()));
  ASSERT_TRUE(writer.write(some_day_us, some_heartbeat().view()));
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(writer.counts().keys_withheld, 1U);
  EXPECT_EQ(writer.counts().frames_written, 1U);
  std::ifstream file(folder / "flight.tlog", std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(content.find("KKKK"), std::string::npos);
}

TEST(mavlink_tlog_writer, a_full_file_becomes_older_and_the_oldest_gives_way) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open(small_files(folder / "flight.tlog", 2)));
  write_heartbeats(writer, 0, 5 * heartbeats_in_a_file);
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(writer.counts().files_opened, 5U);
  std::uint64_t first = 2 * heartbeats_in_a_file; // what two deleted files held
  for (const std::string name : {"flight.2.tlog", "flight.1.tlog", "flight.tlog"}) {
    EXPECT_LE(fs::file_size(folder / name), tlog_writer::buffer_bytes) << name;
    const auto seen = read_file(folder / name);
    ASSERT_EQ(seen.records.size(), heartbeats_in_a_file) << name;
    EXPECT_EQ(seen.records.front().timestamp_us, some_day_us + first) << name;
    EXPECT_EQ(seen.counts.skipped_bytes, 0U) << name;
    first += heartbeats_in_a_file;
  }
  EXPECT_FALSE(fs::exists(folder / "flight.3.tlog"));
}

TEST(mavlink_tlog_writer, without_older_files_the_full_one_is_begun_anew) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open(small_files(folder / "flight.tlog", 0)));
  write_heartbeats(writer, 0, 2 * heartbeats_in_a_file);
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(read_file(folder / "flight.tlog").records.front().timestamp_us, some_day_us + heartbeats_in_a_file);
  EXPECT_FALSE(fs::exists(folder / "flight.1.tlog"));
}

TEST(mavlink_tlog_writer, a_log_of_an_earlier_run_is_kept) {
  const temporary_folder folder;
  for (std::uint64_t run = 0; run < 2; ++run) {
    tlog_writer writer;
    ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
    ASSERT_TRUE(writer.write(some_day_us + run, some_heartbeat().view()));
  }
  EXPECT_EQ(read_file(folder / "flight.tlog").records.front().timestamp_us, some_day_us + 1);
  EXPECT_EQ(read_file(folder / "flight.1.tlog").records.front().timestamp_us, some_day_us);
}

TEST(mavlink_tlog_writer, a_full_disk_is_an_error_with_a_count_and_not_the_end) {
  tlog_writer writer;
  ASSERT_TRUE(writer.open({"/dev/full"}));
  write_heartbeats(writer, 0, 2);
  for (int i = 0; i < 3; ++i) {
    const auto flushed = writer.flush();
    if (i == 0) {
      ASSERT_FALSE(flushed);
      EXPECT_EQ(flushed.error().code, mcap::errc::disk_full);
      EXPECT_EQ(flushed.error().message(), "/dev/full: disk full: write: No space left on device");
    }
  }
  EXPECT_EQ(writer.counts().frames_lost, 2U);
  EXPECT_EQ(writer.counts().failures, 1U);
}

// The limit on the size of files of this process, put back at the end. Writing beyond it fails with EFBIG; the signal
// that comes with it is ignored meanwhile.
class file_size_limit {
public:
  explicit file_size_limit(rlim_t bytes) : handler_before_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~file_size_limit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, handler_before_);
  }
  file_size_limit(const file_size_limit&) = delete;
  file_size_limit& operator=(const file_size_limit&) = delete;

private:
  rlimit before_{};
  void (*handler_before_)(int);
};

TEST(mavlink_tlog_writer, after_a_failure_it_goes_on_in_a_new_file_and_no_record_is_torn) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "flight.tlog"}));
  write_heartbeats(writer, 0, 10);
  ASSERT_TRUE(writer.flush());
  {
    const file_size_limit limit(10 * heartbeat_record_size + 50);
    write_heartbeats(writer, 10, 10);
    const auto flushed = writer.flush();
    ASSERT_FALSE(flushed);
    EXPECT_EQ(flushed.error().code, mcap::errc::io);
    write_heartbeats(writer, 20, 20);
    EXPECT_FALSE(writer.flush()); // into a new file, which stays empty and is removed
    EXPECT_EQ(writer.counts().frames_lost, 30U);
  }
  write_heartbeats(writer, 40, 5);
  ASSERT_TRUE(writer.close());
  EXPECT_EQ(writer.counts().frames_written, 15U);
  EXPECT_EQ(read_file(folder / "flight.1.tlog").records.size(), 10U);
  EXPECT_EQ(read_file(folder / "flight.1.tlog").counts.skipped_bytes, 0U);
  EXPECT_EQ(read_file(folder / "flight.tlog").records.front().timestamp_us, some_day_us + 40);
  EXPECT_FALSE(fs::exists(folder / "flight.2.tlog"));
}

TEST(mavlink_tlog_writer, a_folder_that_is_not_there_is_an_error_and_may_come) {
  const temporary_folder folder;
  tlog_writer writer;
  ASSERT_TRUE(writer.open({folder / "later" / "flight.tlog"}));
  write_heartbeats(writer, 0, 1);
  EXPECT_FALSE(writer.flush());
  fs::create_directory(folder / "later");
  write_heartbeats(writer, 1, 1);
  EXPECT_TRUE(writer.flush());
  EXPECT_EQ(writer.counts().frames_lost, 1U);
  EXPECT_EQ(writer.counts().frames_written, 1U);
}

TEST(mavlink_tlog_writer, options_without_sense_are_refused) {
  const temporary_folder folder;
  tlog_writer writer;
  for (const tlog_writer_options& options :
       {tlog_writer_options{}, tlog_writer_options{folder / "a.tlog", tlog_writer::buffer_bytes - 1, 3},
        tlog_writer_options{folder / "a.tlog", 1U << 20U, tlog_writer::max_older_files + 1}}) {
    const auto opened = writer.open(options);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().code, mcap::errc::invalid_argument);
  }
}

TEST(mavlink_tlog_writer, an_owner_that_names_the_files_finds_every_frame_in_them_in_order) {
  const temporary_folder folder;
  unsigned files = 0;
  auto options = small_files({}, 0);
  options.next_file = [&] { return folder / (std::to_string(++files) + ".tlog"); };
  tlog_writer writer;
  ASSERT_TRUE(writer.open(options));
  write_heartbeats(writer, 0, 2 * heartbeats_in_a_file + 1);
  ASSERT_TRUE(writer.close());
  ASSERT_EQ(files, 3U);
  std::uint64_t next_us = some_day_us;
  for (unsigned n = 1; n <= files; ++n)
    for (const auto& each : read_file(folder / (std::to_string(n) + ".tlog")).records)
      EXPECT_EQ(each.timestamp_us, next_us++);
  EXPECT_EQ(next_us, some_day_us + 2 * heartbeats_in_a_file + 1);
}

TEST(mavlink_tlog_writer, a_name_that_is_not_given_loses_frames_and_no_file) {
  const temporary_folder folder;
  auto options = small_files({}, 0);
  options.next_file = []() -> mcap::result<fs::path> {
    return tl::make_unexpected(mcap::error{mcap::errc::io, "folder", "no name", 0});
  };
  tlog_writer writer;
  ASSERT_TRUE(writer.open(options));
  write_heartbeats(writer, 0, 1);
  EXPECT_FALSE(writer.flush());
  EXPECT_EQ(writer.counts().frames_lost, 1U);
}

RC_GTEST_PROP(mavlink_tlog_writer_property, what_was_written_is_read_back_equal, ()) {
  std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
  const auto frames = some_frames(*rc::gen::inRange<std::size_t>(0, 3000), random);
  const temporary_folder folder;
  tlog_writer writer;
  RC_ASSERT(writer.open({folder / "flight.tlog"}).has_value());
  std::vector<plain_record> expected;
  for (const auto& frame : frames) {
    const std::uint64_t time_us = some_day_us + random() % 1'000'000;
    RC_ASSERT(writer.write(time_us, frame_view(frame.data())).has_value());
    expected.push_back({time_us, to_hex(frame)});
    if (random() % 1000 == 0)
      RC_ASSERT(writer.flush().has_value());
  }
  RC_ASSERT(writer.close().has_value());
  RC_ASSERT(writer.counts().frames_written == frames.size());
  if (!frames.empty())
    RC_ASSERT(read_file(folder / "flight.tlog").records == expected);
}

} // namespace tlog_writer_test
} // namespace godwit::io::mavlink::test
