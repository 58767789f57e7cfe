#include "programs/godwit-sim/host/control_port.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/link/io_thread.hpp"
#include "tests/io/link/far_ends.hpp"
#include "tests/io/link/watcher.hpp"
#include "tests/programs/godwit-sim/host/control_client.hpp"

namespace godwit::sim {
namespace control_port_test {

using json = nlohmann::json;
using io::link::testing::tcp_caller;

// Answers each request with itself.
struct control_port_test : ::testing::Test {
  control_port_test() {
    const auto opened = port.open(parse_control_place("127.0.0.1:0").value(), thread);
    EXPECT_TRUE(opened);
    EXPECT_TRUE(io::link::testing::eventually([this] {
      thread->run_inside([this] { number = io::link::parse_uri(port.description())->port; });
      return number != 0;
    }));
  }

  std::shared_ptr<io::link::io_thread> thread = io::link::start_io_thread();
  std::uint16_t number = 0;
  control_port port{[](const json& request) { return json{{"ok", true}, {"heard", request}}; }, {}};
};

TEST(control_place, only_this_computer_may_be_listened_on) {
  for (const char* text : {"127.0.0.1:14600", "localhost:0", "[::1]:14600", "127.1.2.3:1"})
    EXPECT_TRUE(parse_control_place(text)) << text;
  for (const char* text : {"", "14600", ":14600", "0.0.0.0:14600", "192.168.1.1:14600", "[::]:14600", "example.org:1",
                           "127.0.0.1:", "127.0.0.1:99999"}) {
    const auto read = parse_control_place(text);
    ASSERT_FALSE(read) << text;
    EXPECT_NE(read.error().find("127.0.0.1:14600"), std::string::npos) << read.error();
  }
}

TEST_F(control_port_test, each_line_is_answered_with_a_line_and_its_id) {
  control_client client(number);
  EXPECT_EQ(client.ask({{"do", "x"}, {"id", 7}}), (json{{"ok", true}, {"heard", {{"do", "x"}, {"id", 7}}}, {"id", 7}}));
  EXPECT_EQ(client.ask({{"do", "y"}})["heard"]["do"], "y");
}

TEST_F(control_port_test, requests_may_come_torn_and_several_at_once) {
  control_client client(number);
  client.write("{\"do\":");
  client.write("\"a\"}\n{\"do\":\"b\"}\n{\"do\":\"c\"");
  client.write("}\n");
  for (const char* each : {"a", "b", "c"})
    EXPECT_EQ(client.next_answer()["heard"]["do"], each);
}

TEST_F(control_port_test, a_client_that_speaks_something_else_is_answered_and_not_heard_again) {
  control_client browser(number);
  browser.write("POST / HTTP/1.1\r\n\r\n{\"do\":\"quit\"}\n");
  const auto answer = browser.next_answer();
  EXPECT_EQ(answer["ok"], false);
  EXPECT_NE(answer["error"].get<std::string>().find("JSON object"), std::string::npos);
  browser.write("{\"do\":\"quit\"}\n");
  control_client other(number);
  EXPECT_EQ(other.ask({{"do", "x"}})["ok"], true) << "others are heard";
  EXPECT_FALSE(browser.has_answer());
}

TEST_F(control_port_test, a_line_without_an_end_is_bounded) {
  control_client client(number);
  client.write(std::string(control_port::max_line_bytes + 1, ' '));
  EXPECT_NE(client.next_answer()["error"].get<std::string>().find("65536 bytes"), std::string::npos);
}

TEST_F(control_port_test, a_ninth_client_is_turned_away) {
  std::vector<std::unique_ptr<control_client>> clients;
  for (std::size_t n = 0; n < control_port::max_clients; ++n) {
    clients.push_back(std::make_unique<control_client>(number));
    EXPECT_EQ(clients.back()->ask({{"do", "x"}})["ok"], true);
  }
  EXPECT_TRUE(tcp_caller(number).is_hung_up());
}

} // namespace control_port_test
} // namespace godwit::sim
