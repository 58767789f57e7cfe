// Which call of the contract a request is, and what its target says.
//
// Errors: a status and a sentence: 404 for a path that there is not, 405 with what is allowed there, 400 for a query
// that the call does not know. Thread: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "programs/godwit-sim/missions/fault.hpp"

namespace godwit::sim::missions {

inline constexpr std::uint64_t default_page_rows = 1000;
inline constexpr std::uint64_t max_page_rows = 2000;
inline constexpr std::uint64_t default_wait_s = 30;
inline constexpr std::uint64_t max_wait_s = 60;

struct route {
  endpoint where = endpoint::none;
  std::string path;          // without the query
  std::string mission_id;    // empty: of get_next
  std::string assignment_id; // of post_response
  std::string next;          // of pages; empty: the first one
  std::uint64_t limit = default_page_rows;
  std::optional<std::string> since = {}; // of the objects: a mark, or empty
  std::int64_t after = 0;                // revision; of get_assignments
  std::uint64_t wait_s = default_wait_s;
  std::string vehicle_id = {}; // of get_next
};

struct route_error {
  unsigned status = 404;
  std::string sentence;
  std::string allow; // with 405: "GET, POST"
  endpoint where = endpoint::none;
};

[[nodiscard]] tl::expected<route, route_error> route_of(std::string_view method, std::string_view target);

// What the body of a request may have, as far as its verb and path say: more is a 413.
[[nodiscard]] std::size_t max_body_bytes(std::string_view method, std::string_view target);

} // namespace godwit::sim::missions
