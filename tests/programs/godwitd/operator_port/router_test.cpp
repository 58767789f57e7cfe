#include "programs/godwitd/operator_port/router.hpp"

#include <gtest/gtest.h>

#include "tests/io/http/server/server_fixture.hpp"

namespace router_test {

using namespace godwit;
using namespace godwit::operator_port;
using io::http::test::raw_client;
using io::http::test::running_server;

void say(std::string text, responder answer) { answer.send({.content_type = "text/plain", .body = std::move(text)}); }

route_list routes() {
  return {
      {"GET", "/look", 0, [](server_request, responder answer) { say("looked", std::move(answer)); }},
      {"POST", "/do", 5, [](server_request asked, responder answer) { say(asked.body, std::move(answer)); }},
      {"DELETE", "/people/{}", 0, [](server_request asked, responder answer) { say(asked.target, std::move(answer)); }},
      {"GET", "/page", 0, [](server_request, responder answer) { say("a page", std::move(answer)); }, access::open}};
}

struct served {
  std::string from; // where requests come from; empty: this computer
  router who{routes(), {"drone.local"}, false};
  running_server server{[this](server_request asked, responder answer) {
                          if (!from.empty())
                            asked.from = from;
                          who.answer(std::move(asked), std::move(answer));
                        },
                        {},
                        {.max_body_bytes = [this](std::string_view method, std::string_view target) {
                          return who.max_body_bytes(method, target);
                        }}};
  raw_client::answer ask(const std::string& line, const std::string& headers = "Host: localhost\r\n",
                         const std::string& body = {}) {
    raw_client client(server);
    client.write(line + " HTTP/1.1\r\n" + headers +
                 (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" + body);
    return client.read(line.starts_with("HEAD"));
  }
};

TEST(operator_port_router, a_request_goes_to_the_route_of_its_method_and_path) {
  served all;
  EXPECT_EQ(all.ask("GET /look").body(), "looked");
  EXPECT_EQ(all.ask("GET /look?for=it").body(), "looked");
  EXPECT_EQ(all.ask("HEAD /look").result_int(), 200U);
  EXPECT_EQ(all.ask("POST /do", "Host: localhost\r\n", "12345").body(), "12345");
  EXPECT_EQ(all.ask("DELETE /people/anna").body(), "/people/anna");
}

TEST(operator_port_router, what_is_not_there_is_said_with_what_is) {
  served all;
  for (const auto* nothing : {"GET /", "GET /looks", "GET /look/", "GET //look", "DELETE /people", "DELETE /people/",
                              "DELETE /people/anna/x", "GET /LOOK"})
    EXPECT_EQ(all.ask(nothing).result_int(), 404U) << nothing;
  const auto wrong = all.ask("POST /look");
  EXPECT_EQ(wrong.result_int(), 405U);
  EXPECT_EQ(wrong["Allow"], "GET, HEAD");
}

TEST(operator_port_router, a_name_that_is_not_ours_is_answered_nothing_from_here) {
  served all;
  EXPECT_EQ(all.ask("GET /look", "Host: drone.local:8088\r\n").result_int(), 200U);
  for (const auto* strange : {"Host: evil.example\r\n", "", "Host: \r\n"})
    EXPECT_EQ(all.ask("GET /look", strange).result_int(), 421U) << strange;
  EXPECT_EQ(all.who.counts().other_host, 3U);
}

TEST(operator_port_router, a_page_of_another_site_may_ask_nothing) {
  served all;
  EXPECT_EQ(all.ask("GET /look", "Host: localhost:80\r\nOrigin: http://localhost:80\r\n").result_int(), 200U);
  EXPECT_EQ(all.ask("GET /look", "Host: localhost:80\r\nOrigin: http://evil.example\r\n").result_int(), 403U);
  EXPECT_EQ(all.ask("GET /look", "Host: localhost:80\r\nOrigin: null\r\n").result_int(), 403U);
  EXPECT_EQ(all.who.counts().other_origin, 2U);
}

TEST(operator_port_router, from_another_computer_nobody_looks_who_is_not_let_in) {
  served all;
  all.from = "192.168.7.9";
  EXPECT_EQ(all.ask("GET /look").result_int(), 401U) << "nobody looks after it";
  EXPECT_EQ(all.who.counts().not_let_in, 1U);
  EXPECT_EQ(all.ask("GET /page").body(), "a page");
  all.who.guard([](const server_request& asked, responder answer, const std::function<void(responder)>& then) {
    if (asked.find("Authorization") == "Bearer good")
      then(std::move(answer));
    else
      say("no", std::move(answer));
  });
  EXPECT_EQ(all.ask("GET /look").body(), "no");
  EXPECT_EQ(all.ask("GET /look", "Host: localhost\r\nAuthorization: Bearer good\r\n").body(), "looked");
  all.from = "127.0.0.1";
  EXPECT_EQ(all.ask("GET /look").body(), "looked");
}

TEST(operator_port_router, a_body_is_as_long_as_its_route_bears) {
  served all;
  EXPECT_EQ(all.ask("POST /do", "Host: localhost\r\n", "123456").result_int(), 413U);
  EXPECT_EQ(all.ask("POST /nowhere", "Host: localhost\r\n", "1").result_int(), 413U);
}

} // namespace router_test
