// What is to go wrong with a missions service, in the words of the command line and of the control port:
//
//   WHAT [on CALL] [from N] [times N]
//
//   lose on post-progress times 1     the next one is stored, and its answer never comes
//   status 503 retry-after 2 from 3   all calls from the third one on
//
// CALL is the name of an endpoint; without it all calls are meant. N counts the calls that are meant, from 1; without
// `times` it goes on until the faults are taken off. WHAT is one of the structs below.
//
// Errors: a sentence that names the word and the allowed form. Thread: values.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <tl/expected.hpp>

#include "io/fields/field_table.hpp"

namespace godwit::sim::missions {

// The calls of the contract, by the names that faults and figures use. Thread: values.
enum class endpoint {
  get_mission,
  delete_mission,
  get_map_objects,
  post_map_objects,
  get_ignored,
  post_ignored,
  post_picture,
  post_waypoints,
  post_tail,
  get_progress,
  post_progress,
  get_assignments,
  post_response,
  get_next,
  none, // no call of the contract
};

constexpr auto enum_names(endpoint) {
  return io::names<endpoint>({{endpoint::get_mission, "get-mission"},
                              {endpoint::delete_mission, "delete-mission"},
                              {endpoint::get_map_objects, "get-mapobjects"},
                              {endpoint::post_map_objects, "post-mapobjects"},
                              {endpoint::get_ignored, "get-ignored"},
                              {endpoint::post_ignored, "post-ignored"},
                              {endpoint::post_picture, "post-picture"},
                              {endpoint::post_waypoints, "post-waypoints"},
                              {endpoint::post_tail, "post-tail"},
                              {endpoint::get_progress, "get-progress"},
                              {endpoint::post_progress, "post-progress"},
                              {endpoint::get_assignments, "get-assignments"},
                              {endpoint::post_response, "post-response"},
                              {endpoint::get_next, "get-next"},
                              {endpoint::none, "none"}});
}

namespace fault {

// Nobody listens, and the connections that there are end; for some time, or until the faults are taken off.
struct refuse {
  std::optional<std::chrono::nanoseconds> time;
  bool operator==(const refuse&) const = default;
};
// New connections get the certificate of another host; those that there are end.
struct wrong_host {
  bool operator==(const wrong_host&) const = default;
};
// The connection is reset before the request is looked at: nothing has changed.
struct drop {
  bool operator==(const drop&) const = default;
};
// Another answer with a problem document. Nothing has changed, unless it was `committed`.
struct status {
  unsigned code = 503;
  std::optional<std::uint64_t> retry_after_s;
  bool is_committed = false;
  bool operator==(const status&) const = default;
};
// The change is stored, and the connection is reset before the answer.
struct lose {
  bool operator==(const lose&) const = default;
};
// The answer comes so much later.
struct delay {
  std::chrono::nanoseconds time{0};
  bool operator==(const delay&) const = default;
};
// The answer comes in so many bytes a second.
struct slow {
  std::uint64_t bytes_per_s = 1;
  bool operator==(const slow&) const = default;
};
// The connection is reset in the middle of the body.
struct reset {
  bool operator==(const reset&) const = default;
};
// The answer says that it is something else.
struct content_type {
  std::string text;
  bool operator==(const content_type&) const = default;
};
// The body ends in its middle, and the length says that this is all.
struct truncate {
  bool operator==(const truncate&) const = default;
};
// The body has 1 GiB: after what there is, spaces.
struct huge {
  bool operator==(const huge&) const = default;
};
// JSON, but with a property that the schema does not allow.
struct schema {
  bool operator==(const schema&) const = default;
};
// The next major version of the contract.
struct version {
  bool operator==(const version&) const = default;
};

using any = std::variant<refuse, wrong_host, drop, status, lose, delay, slow, reset, content_type, truncate, huge,
                         schema, version>;

} // namespace fault

inline constexpr std::chrono::seconds longest_fault_time{3600};

struct fault_rule {
  fault::any what;
  std::optional<endpoint> where; // none: every call
  std::uint64_t from = 1;
  std::optional<std::uint64_t> times; // none: for good
  bool operator==(const fault_rule&) const = default;
};

[[nodiscard]] tl::expected<fault_rule, std::string> parse_fault_rule(std::string_view text);

} // namespace godwit::sim::missions
