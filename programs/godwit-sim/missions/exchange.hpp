// A request and its answer, as they are without the wire. Thread: plain values.
#pragma once

#include <string>
#include <string_view>

#include "io/http/server/message.hpp"

namespace godwit::sim::missions {

inline constexpr std::string_view json_type = "application/json";
using io::http::problem_type;

struct request {
  std::string method;        // "GET"
  std::string target;        // path and query, as they came
  std::string authorization; // the whole header; empty: none
  std::string content_type;  // of the body
  std::string body;
};

using answer = io::http::server_response;

} // namespace godwit::sim::missions
