#include "programs/godwitd/open_line.hpp"

#include <gtest/gtest.h>

namespace godwit::daemon {
namespace open_line_test {

io::link::uri line(std::string_view text) { return io::link::parse_uri(text).value(); }

TEST(open_line, a_line_into_a_network_without_a_key_is_said) {
  for (const auto* const each : {"udpin://:14550", "udpin://0.0.0.0:14550", "udpout://192.168.1.7:14550",
                                 "tcpin://[::]:5760", "tcp://autopilot.local:5760"}) {
    const auto said = open_line_warning(line(each), false, "--signing-key");
    EXPECT_NE(said.find("has no key"), std::string::npos) << each;
    EXPECT_NE(said.find("--signing-key"), std::string::npos) << each;
  }
}

TEST(open_line, nothing_is_said_of_wires_loopback_and_signed_lines) {
  EXPECT_EQ(open_line_warning(line("serial:///dev/ttyS1:57600"), false, "-"), "");
  EXPECT_EQ(open_line_warning(line("udpin://127.0.0.1:14550"), false, "-"), "");
  EXPECT_EQ(open_line_warning(line("tcp://localhost:5760"), false, "-"), "");
  EXPECT_EQ(open_line_warning(line("udpin://[::1]:14550"), false, "-"), "");
  EXPECT_EQ(open_line_warning(line("udpin://:14550"), true, "-"), "");
}

TEST(open_line, where_a_sender_can_be_made_up_one_heartbeat_is_not_believed) {
  EXPECT_EQ(heartbeats_to_begin(line("udpin://127.0.0.1:14550"), false), 4);
  EXPECT_EQ(heartbeats_to_begin(line("udpout://127.0.0.1:14550"), false), 4);
  EXPECT_EQ(heartbeats_to_begin(line("udpin://127.0.0.1:14550"), true), 1);
  EXPECT_EQ(heartbeats_to_begin(line("serial:///dev/ttyS1:57600"), false), 1);
  EXPECT_EQ(heartbeats_to_begin(line("tcp://127.0.0.1:5760"), false), 1);
}

} // namespace open_line_test
} // namespace godwit::daemon
