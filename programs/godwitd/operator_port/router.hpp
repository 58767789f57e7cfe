// Who answers a request, or why nobody does.
//
//   421 the Host is not ours   403 the Origin is not the same   404 no such path   405 no such method there
//   401 who asks from another computer is not known
//
// Thread: pure, but for counts(), which is that of the port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/http/server/responder.hpp"

namespace godwit::operator_port {

// What the port answers at which path. Each part of its API brings a list of routes; operator_port joins them.
//
//   std::vector<route> routes{{"GET", "/healthz", 0, [](server_request asked, responder answer) { ... }}};
//
// A handler is called in the thread of the port, must not block, and answers at once or later; Host, Origin, method and
// sizes have been looked at by then, and the security headers are added after it. Thread: plain values.
using io::http::responder;
using io::http::server_request;
using io::http::server_response;

// From this computer itself all can be looked at. From elsewhere looking needs a session or a token, and what is `open`
// looks after that itself, or is nothing but the page.
enum class access { looking, open };

struct route {
  std::string_view method; // GET answers HEAD as well
  std::string_view path; // without the query; a segment {} stands for any one: "/api/v1/operators/{}", a * for the rest
  std::size_t max_body_bytes = 0;
  std::function<void(server_request asked, responder answer)> handle;
  access who = access::looking;
};

using route_list = std::vector<route>;

struct refusal_counts {
  std::uint64_t other_host = 0;
  std::uint64_t other_origin = 0;
  std::uint64_t no_such_path = 0;
  std::uint64_t no_such_method = 0;
  std::uint64_t not_let_in = 0; // nobody could look after who asks
};

// Finds out whether who asks may look, and refuses it or calls THEN, in the thread of the port.
using gate = std::function<void(const server_request& asked, responder answer, std::function<void(responder)> then)>;

class router {
public:
  // HOSTS: further names of this computer.
  router(route_list routes, std::vector<std::string> hosts, bool is_secure)
      : routes_(std::move(routes)), hosts_(std::move(hosts)), is_secure_(is_secure) {}

  // THEN is called for each request from a page of another site, which is refused.
  void on_other_origin(std::function<void(const std::string& from)> then) { other_origin_ = std::move(then); }
  // Without it nobody may look from another computer.
  void guard(gate by) { gate_ = std::move(by); }
  void answer(server_request asked, responder answer);
  [[nodiscard]] std::size_t max_body_bytes(std::string_view method, std::string_view target) const;
  [[nodiscard]] const refusal_counts& counts() const { return counts_; }

private:
  [[nodiscard]] const route* find(std::string_view method, std::string_view target) const;
  [[nodiscard]] std::string methods_at(std::string_view target) const; // "GET, HEAD"; empty: there is no such path
  [[nodiscard]] server_response refusal_of(const server_request& asked);
  void let_in(const route& to, server_request asked, responder answer);

  route_list routes_;
  std::vector<std::string> hosts_;
  bool is_secure_;
  refusal_counts counts_;
  std::function<void(const std::string& from)> other_origin_;
  gate gate_;
};

[[nodiscard]] std::string_view path_of(std::string_view target);

} // namespace godwit::operator_port
