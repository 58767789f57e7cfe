#include "programs/godwitd/link_log/link_recording.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/programs/godwitd/link_log/link_files.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace link_recording_test {

using namespace godwit;
using namespace godwit::daemon;
using test::heartbeat;
using test::records_of;
namespace fs = std::filesystem;

constexpr std::int64_t second_ns = 1'000'000'000;

struct recorded {
  explicit recorded(link_log_options wanted = {}) : options(std::move(wanted)) {
    options.folder = folder.file("trace");
    EXPECT_TRUE(recording.open(options, "vehicle", 7));
  }
  [[nodiscard]] fs::path file(const char* name = "vehicle-0000000007-000001.tlog") const {
    return options.folder / name;
  }

  test::scratch folder;
  link_log_options options;
  link_recording recording;
};

link_batch batch_of(const link_chunk& head, std::span<const std::byte> bytes) {
  link_batch result{{head}, {bytes.begin(), bytes.end()}};
  result.chunks[0].size_bytes = bytes.size();
  return result;
}

link_chunk heard(std::uint64_t time_us) { return {time_us, 1, false, true}; }

TEST(link_recording, heard_and_sent_frames_are_in_the_file_of_the_run_once_they_are_flushed) {
  recorded link;
  link.recording.take(batch_of(heard(1'781'000'000'000'000), heartbeat(3).span()));
  link.recording.take(batch_of({1'781'000'000'000'009, 0, true, true}, heartbeat(9).span()));
  link.recording.flush(0);
  EXPECT_EQ(records_of(link.file()),
            (std::vector<test::logged>{{1'781'000'000'000'000, 0, 3, false}, {1'781'000'000'000'009, 0, 9, false}}));
  EXPECT_EQ(link.recording.problem(), "");
}

TEST(link_recording, no_signature_and_no_key_gets_into_the_file) {
  recorded link;
  io::mavlink::setup_signing setup;
  setup.secret_key.fill(0x5A);
  const auto key = io::mavlink::encode(setup, {255, 190}, 0, io::mavlink::signing::off);
  link.recording.take(batch_of(heard(1'781'000'000'000'000), key.span()));
  link.recording.take(batch_of({1'781'000'000'000'000, 0, true, true}, key.span()));
  link.recording.take(batch_of({1'781'000'000'000'000, 4, false, false}, key.span()));
  link.recording.take(batch_of(heard(1'781'000'000'000'001), test::signed_heartbeat().span()));
  link.recording.flush(0);
  EXPECT_EQ(records_of(link.file()), (std::vector<test::logged>{{1'781'000'000'000'001, 0, 0, false}}));
  EXPECT_EQ(test::scratch::read(link.file().string()).find("ZZZZ"), std::string::npos);
  EXPECT_EQ(link.recording.counts().keys_withheld, 3U);
}

TEST(link_recording, a_frame_of_a_stream_that_comes_in_pieces_is_put_together_for_each_connection) {
  recorded link;
  const auto frame = heartbeat(5);
  const auto first = frame.span().first(9);
  const auto rest = frame.span().subspan(9);
  link.recording.take(batch_of({1'781'000'000'000'000, 1, false, false}, first));
  link.recording.take(batch_of({1'781'000'000'000'000, 2, false, false}, first));
  link.recording.take(batch_of({1'781'000'000'000'001, 1, false, false}, rest));
  link.recording.take(batch_of({1'781'000'000'000'002, 2, false, false}, rest));
  link.recording.flush(0);
  EXPECT_EQ(records_of(link.file()).size(), 2U);
}

TEST(link_recording, the_files_of_all_runs_keep_to_the_bound_and_the_oldest_go_first) {
  link_log_options small;
  small.segment_bytes = io::mavlink::tlog_writer::buffer_bytes;
  small.total_bytes = 3 * small.segment_bytes;
  recorded link(small);
  std::ofstream(link.file("vehicle-0000000006-000001.tlog")) << "an older run";
  link_recording next;
  ASSERT_TRUE(next.open(link.options, "vehicle", 8));
  for (std::uint64_t n = 0; n < 20'000; ++n)
    next.take(batch_of(heard(1'781'000'000'000'000 + n), heartbeat().span()));
  next.close();
  std::uintmax_t total = 0;
  for (const auto& each : fs::directory_iterator(link.options.folder))
    total += fs::file_size(each);
  EXPECT_LE(total, small.total_bytes);
  const auto names = test::files_in(link.options.folder);
  EXPECT_EQ(names.back(), "vehicle-0000000008-000009.tlog");
  EXPECT_EQ(records_of(link.file(names.back().c_str())).back().time_us, 1'781'000'000'019'999);
}

TEST(link_recording, a_disk_that_refuses_loses_what_it_refused_pushes_out_nothing_and_is_tried_again_each_second) {
  recorded link;
  link.recording.take(batch_of(heard(1'781'000'000'000'000), heartbeat(1).span()));
  link.recording.flush(0);
  link.recording.close();
  const auto away = link.folder.file("away");
  fs::rename(link.options.folder, away);
  for (int n = 0; n < 40; ++n) {
    link.recording.take(batch_of(heard(1'781'000'000'000'000), heartbeat(2).span()));
    link.recording.flush(n * second_ns / 10);
  }
  EXPECT_NE(link.recording.problem(), "");
  EXPECT_EQ(link.recording.counts().failures, 4U) << "one try a second";
  fs::rename(away, link.options.folder);
  link.recording.take(batch_of(heard(1'781'000'000'000'009), heartbeat(3).span()));
  link.recording.flush(60 * second_ns);
  EXPECT_EQ(link.recording.problem(), "");
  EXPECT_EQ(records_of(link.file()).size(), 1U) << "what was there is still there";
  const auto names = test::files_in(link.options.folder);
  EXPECT_EQ(records_of(link.file(names.back().c_str())).back().sequence, 3);
}

} // namespace link_recording_test
