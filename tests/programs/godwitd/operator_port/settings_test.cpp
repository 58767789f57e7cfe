#include "programs/godwitd/operator_port/settings.hpp"

#include <gtest/gtest.h>

namespace operator_port_settings_test {

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

TEST(operator_port_settings, beyond_this_computer_it_speaks_tls) {
  for (const auto* open : {"0.0.0.0:8088", "[::]:8088", "192.168.1.5:8088", "drone.local:8088"}) {
    const auto read = read_listen(open);
    ASSERT_TRUE(read) << open;
    EXPECT_FALSE(read->is_local) << open;
    EXPECT_TRUE(read->uses_tls) << open;
  }
  EXPECT_TRUE(read_listen("[::1]:8088")->is_local);
  EXPECT_FALSE(read_listen("127.0.0.7:8088")->uses_tls);
}

TEST(operator_port_settings, beyond_this_computer_it_needs_an_account_and_both_remedies_are_said) {
  const auto open = *read_listen("0.0.0.0:8443");
  EXPECT_FALSE(objection_to(open, true));
  const auto said = objection_to(open, false).value_or("");
  EXPECT_NE(said.find("godwitd operator add"), std::string::npos) << said;
  EXPECT_NE(said.find("127.0.0.1"), std::string::npos) << said;
  EXPECT_FALSE(objection_to(*read_listen("127.0.0.1:8088"), false));
}

TEST(operator_port_settings, further_names_stand_between_spaces_without_ports) {
  EXPECT_EQ(read_hosts("drone.local  [fe80::1]"), (std::vector<std::string>{"drone.local", "[fe80::1]"}));
  EXPECT_TRUE(read_hosts("")->empty());
  EXPECT_FALSE(read_hosts("drone.local:8088"));
  EXPECT_FALSE(read_hosts("a b c d e f g h i j k l m n o p q"));
}

} // namespace operator_port_settings_test
