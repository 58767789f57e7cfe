// Who opens the page later sees what was logged before.
#include "programs/godwitd/operator_port/view_api.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "actors/telemetry_stream/core.hpp"
#include "tests/io/http/server/server_fixture.hpp"

namespace log_api_test {

using namespace godwit;
using namespace godwit::operator_port;
using io::http::test::get;
using io::http::test::raw_client;
using io::http::test::running_server;
using nlohmann::json;

class logged : public testing::Test {
protected:
  void say(const std::string& sentence) {
    api->add(all.publish(telemetry_stream::topic::log, telemetry_stream::json_of({true, "executor", sentence}), 5,
                         ++now_ns));
  }
  json lines() {
    const auto routes = api->routes();
    running_server server(
        [&](server_request asked, responder answer) { routes.at(0).handle(std::move(asked), std::move(answer)); });
    raw_client client(server);
    client.write(get("/api/v1/log"));
    return json::parse(client.read().body()).at("lines");
  }

  std::int64_t now_ns = 1;
  telemetry_stream::hub all{42};
  std::shared_ptr<log_api> api = std::make_shared<log_api>();
};

TEST_F(logged, lines_stand_there_as_the_stream_said_them_the_oldest_first) {
  EXPECT_TRUE(lines().empty());
  say("first");
  all.publish(telemetry_stream::topic::clock, R"({"beat":1})", 6, ++now_ns);
  say("second");
  const auto said = lines();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0].at("data").at("sentence"), "first");
  EXPECT_EQ(said[1].at("data").at("sentence"), "second");
  EXPECT_LT(said[0].at("number"), said[1].at("number"));
}

TEST_F(logged, of_too_many_the_oldest_go) {
  for (std::size_t i = 0; i < log_api::max_lines + 3; ++i)
    say(std::to_string(i));
  const auto said = lines();
  ASSERT_EQ(said.size(), log_api::max_lines);
  EXPECT_EQ(said.front().at("data").at("sentence"), "3");
}

} // namespace log_api_test
