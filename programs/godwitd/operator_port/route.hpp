// What the port answers at which path. Each part of its API brings a list of routes; operator_port joins them.
//
//   std::vector<route> routes{{"GET", "/healthz", 0, [](server_request asked, responder answer) { ... }}};
//
// A handler is called in the thread of the port, must not block, and answers at once or later; Host, Origin, method and
// sizes have been looked at by then, and the security headers are added after it. Thread: plain values.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "io/http/server/responder.hpp"

namespace godwit::operator_port {

using io::http::responder;
using io::http::server_request;
using io::http::server_response;

// From this computer itself all can be looked at. From elsewhere looking needs a session or a token, and what is `open`
// looks after that itself, or is nothing but the page.
enum class access { looking, open };

struct route {
  std::string_view method; // GET answers HEAD as well
  std::string_view path;   // without the query; a segment {} stands for any one: "/api/v1/operators/{}"
  std::size_t max_body_bytes = 0;
  std::function<void(server_request asked, responder answer)> handle;
  access who = access::looking;
};

using route_list = std::vector<route>;

} // namespace godwit::operator_port
