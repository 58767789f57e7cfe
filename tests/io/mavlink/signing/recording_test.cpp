// A recording of ArduPilot Rover on a port where signing was switched on; what it did stands in the file beside it,
// ardurover_signing_serial1.events.txt. The key is in the SETUP_SIGNING of the recording. The ground station is
// 255/190; times in comments are seconds since the start of the recording.
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/verifier.hpp"
#include "io/mavlink/tlog/tlog_reader.hpp"
#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace recording_test {

struct recorded_frame {
  std::int64_t wall_ns = 0;
  byte_buffer bytes;
  [[nodiscard]] frame_view view() const { return frame_view(bytes.data()); }
  [[nodiscard]] signing_time now() const { return signing_time_at(wall_ns); }
};

class mavlink_signing_recording : public testing::Test {
protected:
  void SetUp() override {
    mcap::file_source file;
    ASSERT_TRUE(file.open(std::filesystem::path(GODWIT_TEST_DATA) / "captures/ardurover_signing_serial1.tlog"));
    tlog_reader reader(file);
    for (auto record = reader.next(); record && *record; record = reader.next()) {
      const auto bytes = (*record)->frame.bytes();
      frames_.push_back({static_cast<std::int64_t>((*record)->timestamp_us * 1000), {bytes.begin(), bytes.end()}});
    }
    ASSERT_EQ(frames_.size(), 557U);
  }

  [[nodiscard]] secret_key key() const {
    for (const auto& each : frames_)
      if (each.view().id() == setup_signing::message_id) {
        const auto message = decode<setup_signing>(each.view());
        return secret_key(std::as_bytes(std::span(message.secret_key)));
      }
    ADD_FAILURE() << "no SETUP_SIGNING";
    return counting_key();
  }
  [[nodiscard]] double seconds(const recorded_frame& each) const {
    return static_cast<double>(each.wall_ns - frames_.front().wall_ns) / 1e9;
  }

  std::vector<recorded_frame> frames_;
};

TEST_F(mavlink_signing_recording, all_hashes_of_the_vehicle_are_right_and_only_those_made_with_the_wrong_key_are_not) {
  frame_hasher hasher(key());
  std::map<std::uint8_t, int> right;
  std::vector<double> wrong_s;
  for (const auto& each : frames_) {
    if (!each.view().is_signed())
      continue;
    if (hasher.is_right(each.view()))
      ++right[each.view().system()];
    else
      wrong_s.push_back(seconds(each));
  }
  EXPECT_EQ(right, (std::map<std::uint8_t, int>{{1, 361}, {255, 24}}));
  ASSERT_EQ(wrong_s.size(), 2U); // "wrong key" begins at 12.05, "right key again" at 13.1
  EXPECT_GT(wrong_s.front(), 12.0);
  EXPECT_LT(wrong_s.back(), 13.1);
}

// The vehicle signs 57 to 59 s ahead, which is within our bound. After the frame from the future at 13.35 its own clock
// is 10 minutes ahead: what it then says is refused as soon as that is more than we believe.
TEST_F(mavlink_signing_recording, the_vehicle_is_accepted_until_its_clock_is_more_than_10_minutes_ahead) {
  replay_table streams;
  verifier in(key(), streams);
  int refused_before = 0;
  int accepted_after = 0;
  for (const auto& each : frames_) {
    if (each.view().system() != 1 || !each.view().is_signed())
      continue;
    const verdict found = in.judge(each.view(), each.now());
    refused_before += seconds(each) < 13.35 && found != verdict::accepted_signed ? 1 : 0;
    accepted_after += seconds(each) > 13.4 && found == verdict::accepted_signed ? 1 : 0;
  }
  EXPECT_EQ(refused_before, 0);
  EXPECT_EQ(accepted_after, 21);
  EXPECT_EQ(in.counts().of(verdict::accepted_signed) + in.counts().of(verdict::too_new), 361U);
  EXPECT_GT(in.counts().of(verdict::accepted_signed), 250U);
  EXPECT_GT(in.counts().of(verdict::too_new), 30U);
}

TEST_F(mavlink_signing_recording, no_frame_of_the_vehicle_is_taken_a_second_time) {
  replay_table streams;
  verifier in(key(), streams);
  for (const auto& each : frames_)
    static_cast<void>(in.judge(each.view(), each.now()));
  const auto accepted = in.counts().of(verdict::accepted_signed);
  for (const auto& each : frames_)
    static_cast<void>(in.judge(each.view(), each.now()));
  EXPECT_EQ(in.counts().of(verdict::accepted_signed), accepted);
}

// What we would have made of the ground station, beside what the vehicle did.
TEST_F(mavlink_signing_recording,
       wrong_keys_and_unsigned_frames_are_refused_as_by_the_vehicle_and_the_future_by_us_alone) {
  replay_table streams;
  verifier in(key(), streams);
  std::map<verdict, std::vector<double>> at_s;
  for (const auto& each : frames_)
    if (each.view().system() == 255 && seconds(each) > 5.1) // from then on the station signs
      at_s[in.judge(each.view(), each.now())].push_back(seconds(each));
  // The vehicle did not answer at 12.05 (wrong key) and 14.68 (unsigned) either.
  EXPECT_EQ(at_s[verdict::bad_signature].size(), 2U);
  for (const double s : at_s[verdict::unsigned_refused])
    EXPECT_TRUE(s > 14.6) << s;
  // The station took over the vehicle's time at its first answer, and its timestamps rise until 13.28; those at the
  // edge of 10 minutes are taken, too.
  EXPECT_EQ(at_s[verdict::accepted_signed].size(), 19U);
  EXPECT_LT(at_s[verdict::accepted_signed].back(), 13.6);
  // Here the vehicle answered, and let its clock be moved; for us it is too far ahead, with whatever link id.
  EXPECT_EQ(at_s[verdict::too_new].size(), 5U);
  EXPECT_GT(at_s[verdict::too_new].front(), 13.35);
  EXPECT_TRUE(at_s[verdict::replayed].empty());
}

// The probes as the events name them, made with the key of the recording for a clock that runs as the vehicle's did.
TEST_F(mavlink_signing_recording, replays_old_and_future_timestamps_and_new_links_are_judged_by_the_rules) {
  replay_table streams;
  verifier in(key(), streams);
  const signing_time now = frames_.front().now();
  const auto judge = [&](signing_time time, std::uint8_t link) {
    frame_hasher hasher(key());
    auto frame = golden_heartbeat(signing::on);
    frame.append_signature(store({link_id{link}, time, hasher.hash_of(frame.span(), link_id{link}, time)}));
    return in.judge(frame.view(), now);
  };
  const auto minutes = [](std::uint64_t n) { return n * 60 * signing_units_per_s; };
  EXPECT_EQ(judge(now, 0), verdict::accepted_signed);
  EXPECT_EQ(judge(now, 0), verdict::replayed);
  EXPECT_EQ(judge(earlier(now, minutes(10)), 0), verdict::replayed);
  EXPECT_EQ(judge(later(now, minutes(11)), 0), verdict::too_new);
  EXPECT_EQ(judge(later(now, 1), 0), verdict::accepted_signed); // so the future has locked nobody out
  EXPECT_EQ(judge(now, 77), verdict::accepted_signed);
  EXPECT_EQ(judge(earlier(now, minutes(2)), 78), verdict::too_old);
  EXPECT_EQ(judge(earlier(now, minutes(1) / 2), 79), verdict::accepted_signed);
}

} // namespace recording_test
} // namespace godwit::io::mavlink::test
