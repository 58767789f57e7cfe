#include "io/mqtt/broker_uri.hpp"

#include <gtest/gtest.h>

namespace godwit::io::mqtt {
namespace broker_uri_test {

TEST(broker_uri, a_broker_has_tls_and_a_host_and_a_port_that_may_be_left_out) {
  EXPECT_EQ(parse_broker_uri("mqtts://fleet.example.org")->text(), "mqtts://fleet.example.org:8883");
  EXPECT_EQ(parse_broker_uri("mqtts://10.0.0.1:443")->text(), "mqtts://10.0.0.1:443");
  EXPECT_EQ(parse_broker_uri("mqtts://[2001:db8::1]:8884")->text(), "mqtts://[2001:db8::1]:8884");
  EXPECT_EQ(parse_broker_uri("mqtts://[2001:db8::1]")->host, "2001:db8::1");
}

TEST(broker_uri, in_clear_it_is_on_this_computer) {
  for (const auto* text : {"mqtt://127.0.0.1", "mqtt://127.3.4.5:1883", "mqtt://localhost", "mqtt://[::1]:1883"})
    EXPECT_TRUE(parse_broker_uri(text)) << text;
  for (const auto* text : {"mqtt://fleet.example.org", "mqtt://10.0.0.1:1883", "mqtt://127.evil.example",
                           "mqtt://[::2]", "mqtt://localhost.example.org"}) {
    const auto parsed = parse_broker_uri(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_NE(parsed.error().find("mqtts://"), std::string::npos) << parsed.error();
  }
}

TEST(broker_uri, what_is_no_address_is_refused_with_what_one_is) {
  for (const auto* text :
       {"", "fleet.example.org", "http://fleet.example.org", "mqtts://", "mqtts://a b", "mqtts://h:0",
        "mqtts://h:65536", "mqtts://h:12x", "mqtts://h:", "mqtts://2001:db8::1", "mqtts://h/topic"})
    EXPECT_FALSE(parse_broker_uri(text)) << text;
  EXPECT_FALSE(parse_broker_uri("mqtts://" + std::string(max_uri_length, 'a')));
}

TEST(broker_uri, a_password_does_not_stand_in_the_address) {
  const auto parsed = parse_broker_uri("mqtts://anna:secret@fleet.example.org");
  ASSERT_FALSE(parsed);
  EXPECT_NE(parsed.error().find("telemetry.password_file"), std::string::npos);
  EXPECT_EQ(parsed.error().find("secret"), std::string::npos);
}

} // namespace broker_uri_test
} // namespace godwit::io::mqtt
