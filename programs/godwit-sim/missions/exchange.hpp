// A request and its answer, as they are without the wire. Thread: plain values.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace godwit::sim::missions {

inline constexpr std::string_view json_type = "application/json";
inline constexpr std::string_view problem_type = "application/problem+json";

struct request {
  std::string verb;          // "GET"
  std::string target;        // path and query, as they came
  std::string authorization; // the whole header; empty: none
  std::string content_type;  // of the body
  std::string body;
};

struct answer {
  unsigned status = 200;
  std::string content_type{json_type};
  std::string body;                                         // none with 204
  std::vector<std::pair<std::string, std::string>> headers; // further ones
};

} // namespace godwit::sim::missions
