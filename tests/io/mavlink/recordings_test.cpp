// The scanner and the codec on what real autopilots sent (tests/data/captures).
#include <gtest/gtest.h>

#include <map>

#include "tests/io/mavlink/mavlink_fixture.hpp"

namespace godwit::io::mavlink {
namespace recordings_test {

using counts = std::map<std::string, int, std::less<>>;

struct outcome {
  int frames = 0;
  int known = 0;
  counts by_name; // of the known
  scan_counters counters;
  std::vector<sender_counters> senders;
};

// PIECE(n) is the size of the n-th piece that is fed.
template <class Piece>
outcome decode_all(const std::string& name, Piece piece) {
  const auto bytes = test_data("captures/" + name);
  outcome result;
  scanner frames;
  std::size_t at = 0;
  for (std::size_t n = 0; at < bytes.size(); ++n) {
    const auto size = std::min<std::size_t>(piece(n), bytes.size() - at);
    frames.feed(byte_view(bytes).subspan(at, size), [&](const frame_view& frame) {
      ++result.frames;
      result.known +=
          visit(frame,
                [&]<message M>(const M& each) {
                  ++result.by_name[std::string(type_name<M>())];
                  // Written again it is the same frame: the senders cut off the same zeros as we do.
                  EXPECT_EQ(to_hex(encode(each, frame.from(), frame.sequence()).span()), to_hex(frame.bytes()));
                })
              ? 1
              : 0;
    });
    at += size;
  }
  result.counters = frames.counters();
  result.senders.assign(frames.senders().all().begin(), frames.senders().all().end());
  return result;
}

outcome decode_all(const std::string& name) {
  return decode_all(name, [](std::size_t) { return SIZE_MAX; });
}

void expect_nothing_wrong(const outcome& seen) {
  EXPECT_EQ(seen.counters.bad_crc, 0U);
  EXPECT_EQ(seen.counters.unknown_flag, 0U);
  EXPECT_EQ(seen.counters.v1_frames, 0U);
  EXPECT_EQ(seen.counters.garbage_bytes, 0U);
  ASSERT_EQ(seen.senders.size(), 1U);
  EXPECT_EQ(seen.senders.front().who, (sender{1, 1}));
}

TEST(recordings, px4_mission_gives_every_frame_and_the_counts_of_each_message) {
  const auto seen = decode_all("px4_quad_mission.rx.bin");
  expect_nothing_wrong(seen);
  EXPECT_EQ(seen.frames + static_cast<int>(seen.counters.unknown_id), 28684);
  EXPECT_EQ(seen.known, 8871);
  EXPECT_EQ(seen.by_name, (counts{{"ATTITUDE", 3824},
                                  {"AUTOPILOT_VERSION", 1},
                                  {"BATTERY_STATUS", 38},
                                  {"COMMAND_ACK", 10},
                                  {"COMMAND_LONG", 2},
                                  {"ESTIMATOR_STATUS", 38},
                                  {"EXTENDED_SYS_STATE", 77},
                                  {"GLOBAL_POSITION_INT", 3825},
                                  {"GPS_RAW_INT", 383},
                                  {"HEARTBEAT", 77},
                                  {"HOME_POSITION", 39},
                                  {"MISSION_ACK", 4},
                                  {"MISSION_COUNT", 3},
                                  {"MISSION_CURRENT", 77},
                                  {"MISSION_ITEM_INT", 6},
                                  {"MISSION_ITEM_REACHED", 47},
                                  {"MISSION_REQUEST_INT", 10},
                                  {"PARAM_VALUE", 12},
                                  {"PING", 7},
                                  {"PROTOCOL_VERSION", 1},
                                  {"STATUSTEXT", 7},
                                  {"SYS_STATUS", 77},
                                  {"VFR_HUD", 306}}));
  EXPECT_EQ(seen.counters.of(attitude::message_id).received, 3824U);
}

TEST(recordings, rover_mission_gives_every_frame_and_the_counts_of_each_message) {
  const auto seen = decode_all("ardurover_mission.rx.bin");
  expect_nothing_wrong(seen);
  EXPECT_EQ(seen.frames + static_cast<int>(seen.counters.unknown_id), 7110);
  EXPECT_EQ(seen.known, 2738);
  EXPECT_EQ(seen.by_name, (counts{{"ATTITUDE", 278},
                                  {"AUTOPILOT_VERSION", 1},
                                  {"BATTERY_STATUS", 278},
                                  {"COMMAND_ACK", 11},
                                  {"EKF_STATUS_REPORT", 277},
                                  {"GLOBAL_POSITION_INT", 278},
                                  {"GPS_RAW_INT", 278},
                                  {"HEARTBEAT", 73},
                                  {"HOME_POSITION", 1},
                                  {"MISSION_ACK", 5},
                                  {"MISSION_COUNT", 4},
                                  {"MISSION_CURRENT", 349},
                                  {"MISSION_ITEM_INT", 5},
                                  {"MISSION_ITEM_REACHED", 4},
                                  {"MISSION_REQUEST", 9},
                                  {"PARAM_VALUE", 19},
                                  {"STATUSTEXT", 27},
                                  {"SYSTEM_TIME", 278},
                                  {"SYS_STATUS", 278},
                                  {"TIMESYNC", 7},
                                  {"VFR_HUD", 278}}));
}

TEST(recordings, rover_probes_give_every_frame) {
  const auto seen = decode_all("ardurover_probes.rx.bin");
  expect_nothing_wrong(seen);
  EXPECT_EQ(seen.frames + static_cast<int>(seen.counters.unknown_id), 6987);
  EXPECT_EQ(seen.known, 3450);
}

TEST(recordings, give_the_same_byte_by_byte_and_in_random_pieces) {
  const auto whole = decode_all("ardurover_mission.rx.bin");
  std::mt19937_64 random(5);
  for (const auto& pieces : {decode_all("ardurover_mission.rx.bin", [](std::size_t) { return 1; }),
                             decode_all("ardurover_mission.rx.bin", [&](std::size_t) { return 1 + random() % 700; })}) {
    EXPECT_EQ(pieces.frames, whole.frames);
    EXPECT_EQ(pieces.by_name, whole.by_name);
    EXPECT_EQ(pieces.counters.garbage_bytes, 0U);
  }
}

} // namespace recordings_test
} // namespace godwit::io::mavlink
