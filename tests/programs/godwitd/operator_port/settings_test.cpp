#include "programs/godwitd/operator_port/settings.hpp"

#include <gtest/gtest.h>

namespace {

using namespace godwit::operator_port;

TEST(operator_port_settings, an_address_of_this_computer_itself_and_a_port) {
  EXPECT_EQ(read_listen("127.0.0.1:8088")->host, "127.0.0.1");
  EXPECT_EQ(read_listen("127.0.0.1:8088")->port, 8088);
  EXPECT_EQ(read_listen("[::1]:0")->host, "::1");
  EXPECT_EQ(read_listen("localhost:80")->host, "localhost");
  for (const auto* wrong :
       {"", "8088", ":8088", "127.0.0.1", "127.0.0.1:", "127.0.0.1:99999", "127.0.0.1:80x", "::1:80"})
    EXPECT_FALSE(read_listen(wrong)) << wrong;
}

TEST(operator_port_settings, beyond_this_computer_it_does_not_listen_without_tls_and_accounts) {
  for (const auto* open : {"0.0.0.0:8088", "[::]:8088", "192.168.1.5:8088", "drone.local:8088"}) {
    const auto read = read_listen(open);
    ASSERT_FALSE(read) << open;
    EXPECT_NE(read.error().find("neither TLS nor accounts"), std::string::npos) << read.error();
    EXPECT_NE(read.error().find("127.0.0.1"), std::string::npos) << "what to do";
  }
}

TEST(operator_port_settings, further_names_stand_between_spaces_without_ports) {
  EXPECT_EQ(read_hosts("drone.local  [fe80::1]"), (std::vector<std::string>{"drone.local", "[fe80::1]"}));
  EXPECT_TRUE(read_hosts("")->empty());
  EXPECT_FALSE(read_hosts("drone.local:8088"));
  EXPECT_FALSE(read_hosts("a b c d e f g h i j k l m n o p q"));
}

} // namespace
