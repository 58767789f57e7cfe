#include "programs/godwit-trace/link_session.hpp"

#include <gtest/gtest.h>

namespace godwit::trace_tool {
namespace link_hints_test {

using namespace std::chrono_literals;
using io::mavlink::scan_counters;

link_hints hints_for(const char* uri, bool has_heartbeat = false) { return {*io::link::parse_uri(uri), has_heartbeat}; }

TEST(link_hints, silence_is_told_once_and_not_before_five_seconds) {
  auto hints = hints_for("udpin://0.0.0.0:14550");
  EXPECT_EQ(hints.due(4'999ms, {}), std::nullopt);
  const auto hint = hints.due(5s, {});
  ASSERT_TRUE(hint);
  EXPECT_NE(hint->find("nothing was heard for 5 s"), std::string::npos);
  EXPECT_NE(hint->find("port 14550"), std::string::npos);
  EXPECT_EQ(hints.due(60s, {}), std::nullopt);
}

TEST(link_hints, each_kind_of_link_has_its_own_advice) {
  EXPECT_NE(hints_for("udpout://10.0.0.2:14580", true).due(5s, {})->find("10.0.0.2:14580"), std::string::npos);
  EXPECT_NE(hints_for("tcp://127.0.0.1:5760").due(5s, {})->find("try --heartbeat"), std::string::npos);
  EXPECT_EQ(hints_for("tcp://127.0.0.1:5760", true).due(5s, {})->find("--heartbeat"), std::string::npos);
  EXPECT_NE(hints_for("serial:///dev/ttyACM0:57600").due(5s, {})->find("/dev/ttyACM0"), std::string::npos);
}

TEST(link_hints, bytes_without_a_frame_make_the_baud_rate_suspect) {
  scan_counters noise;
  noise.bytes = 400;
  const auto hint = hints_for("serial:///dev/ttyACM0:57600").due(5s, noise);
  ASSERT_TRUE(hint);
  EXPECT_NE(hint->find("400 bytes came"), std::string::npos);
  EXPECT_NE(hint->find("Is 57600 the baud rate"), std::string::npos);
  EXPECT_EQ(hints_for("udpin://:1").due(5s, noise)->find("baud"), std::string::npos);
}

TEST(link_hints, mavlink_1_is_named_with_the_remedy_of_both_autopilots) {
  auto hints = hints_for("udpin://:14550");
  scan_counters old;
  old.bytes = 34;
  old.v1_frames = 2;
  EXPECT_EQ(hints.due(1s, old), std::nullopt) << "the first frames of a link may be";
  const auto hint = hints.due(2s, old);
  ASSERT_TRUE(hint);
  EXPECT_NE(hint->find("SERIALn_PROTOCOL = 2"), std::string::npos);
  EXPECT_NE(hint->find("MAV_PROTO_VER = 2"), std::string::npos);
  EXPECT_EQ(hints.due(60s, old), std::nullopt);
}

TEST(link_hints, where_frames_are_heard_nothing_is_said) {
  scan_counters good;
  good.bytes = 500;
  good.frames = 1;
  good.v1_frames = 20;
  EXPECT_EQ(hints_for("udpin://:14550").due(60s, good), std::nullopt);
}

} // namespace link_hints_test
} // namespace godwit::trace_tool
