#include "programs/godwitd/operator_port/host_check.hpp"

#include <gtest/gtest.h>

namespace host_check_test {

using namespace godwit::operator_port;

TEST(host_check, a_name_is_what_stands_before_the_port) {
  EXPECT_EQ(host_name("drone.local:8088"), "drone.local");
  EXPECT_EQ(host_name("drone.local"), "drone.local");
  EXPECT_EQ(host_name("[::1]:8088"), "[::1]");
  EXPECT_EQ(host_name("[::1]"), "[::1]");
  for (const auto* wrong : {"", "a:", "a:b", "a:80:90", "[::1", "[::1]x", "a:123456", "::1"})
    EXPECT_EQ(host_name(wrong), "") << wrong;
  EXPECT_EQ(host_name(std::string(300, 'a')), "");
}

TEST(host_check, this_computer_and_the_names_of_the_settings_are_ours_and_no_others) {
  const std::vector<std::string> others{"drone.local"};
  for (const auto* ours : {"localhost", "LOCALHOST:1", "127.0.0.1:8088", "[::1]:9", "Drone.Local:8088"})
    EXPECT_TRUE(is_ours(ours, "", others)) << ours;
  EXPECT_TRUE(is_ours("192.168.7.7:8443", "192.168.7.7", others));
  EXPECT_TRUE(is_ours("[fd00::7]:8443", "fd00::7", others));
  for (const auto* strange : {"", "evil.example", "drone.local.evil.example", "127.0.0.1.evil.example:8088",
                              "localhost.", "127.0.0.2", "user@localhost", " localhost"})
    EXPECT_FALSE(is_ours(strange, "192.168.7.7", others)) << strange;
}

TEST(host_check, a_page_of_the_same_host_and_port_may_ask_and_who_is_no_page) {
  EXPECT_TRUE(is_same_origin("", "localhost:8088", false));
  EXPECT_TRUE(is_same_origin("http://localhost:8088", "localhost:8088", false));
  EXPECT_TRUE(is_same_origin("https://localhost:8088", "localhost:8088", true));
  for (const auto* strange : {"http://localhost", "http://localhost:8089", "https://localhost:8088", "null",
                              "http://evil.example", "http://localhost:8088.evil.example", "localhost:8088"})
    EXPECT_FALSE(is_same_origin(strange, "localhost:8088", false)) << strange;
}

} // namespace host_check_test
