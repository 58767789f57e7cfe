#include "programs/godwit-trace/tlog_recording.hpp"

#include <gtest/gtest.h>

#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/programs/godwit-trace/tool_fixture.hpp"

namespace godwit::trace_tool::test {
namespace tlog_recording_test {

using namespace io::mavlink;

TEST(tlog_recording, what_is_recorded_is_a_log_without_signatures_and_keys) {
  const temporary_folder folder;
  signer key(counting_key(), link_id{1}, signing_time{0});
  auto frame = encode(heartbeat{}, {1, 1}, 0, signing::on);
  ASSERT_TRUE(key.sign(frame, static_cast<std::int64_t>(some_day_us) * 1'000));
  tlog_recording recording;
  ASSERT_TRUE(recording.open(folder / "a.tlog"));
  EXPECT_EQ(recording.write(some_day_us, frame.view()), "");
  EXPECT_EQ(recording.write(some_day_us, frame_of(setup_signing{}).view()), "");
  EXPECT_EQ(recording.flush(), "");
  EXPECT_EQ(recording.close(), folder / "a.tlog" + ": 1 frames recorded, 1 with a key left out");
  io::mcap::file_source source;
  ASSERT_TRUE(source.open(folder / "a.tlog"));
  tlog_reader reader(source);
  const auto record = reader.next();
  ASSERT_TRUE(record && *record);
  EXPECT_EQ((*record)->timestamp_us, some_day_us);
  EXPECT_FALSE((*record)->frame.is_signed());
}

TEST(tlog_recording, without_a_file_nothing_is_recorded_or_said) {
  tlog_recording recording;
  EXPECT_EQ(recording.write(1, frame_of(heartbeat{}).view()), "");
  EXPECT_EQ(recording.flush(), "");
  EXPECT_EQ(recording.close(), "");
}

TEST(tlog_recording, a_place_that_can_not_be_is_refused_at_once) {
  const temporary_folder folder;
  EXPECT_NE(tlog_recording().open(folder / ".").error().find("a folder"), std::string::npos);
  EXPECT_NE(tlog_recording().open(folder / "no/a.tlog").error().find("there is no folder"), std::string::npos);
}

TEST(tlog_recording, what_can_not_be_written_is_said_once_and_counted) {
  tlog_recording recording;
  ASSERT_TRUE(recording.open("/proc/godwit.tlog")) << "a folder in which nobody can make a file";
  std::size_t sentences = 0;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(recording.write(some_day_us, frame_of(heartbeat{}).view()), "");
    sentences += recording.flush().empty() ? 0 : 1;
  }
  EXPECT_EQ(sentences, 1U);
  EXPECT_TRUE(recording.has_lost());
  EXPECT_NE(recording.close().find("3 lost"), std::string::npos);
}

} // namespace tlog_recording_test
} // namespace godwit::trace_tool::test
