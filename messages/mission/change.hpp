// What changes a mission in flight: the service assigns new items, the vehicle inserts a waypoint or asks for a new
// end.
//
// Schemas: assignment, assignment_response, waypoint_insert and tail in config/schemas. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/item.hpp"
#include "messages/mission/item_fields.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::mission {

// From the service: these items instead of all that come after one of the mission.
struct assignment {
  std::string assignment_id; // UUID
  std::int32_t base_revision = 1;
  std::int32_t revision = 1;                        // above base_revision
  std::optional<std::string> replace_after_item_id; // absent: all items are replaced
  std::vector<item> items;

  static constexpr auto fields = io::table(
      "mission.assignment", io::field("assignment_id", &assignment::assignment_id),
      io::field("base_revision", &assignment::base_revision), io::field("revision", &assignment::revision),
      io::field("replace_after_item_id", &assignment::replace_after_item_id), io::field("items", &assignment::items));
  friend bool operator==(const assignment&, const assignment&) = default;
};

struct assignment_list {
  std::vector<assignment> assignments; // oldest first

  static constexpr auto fields =
      io::table("mission.assignment_list", io::field("assignments", &assignment_list::assignments));
  friend bool operator==(const assignment_list&, const assignment_list&) = default;
};

enum class assignment_outcome { accepted, rejected };

constexpr auto enum_names(assignment_outcome) {
  return io::names<assignment_outcome>(
      {{assignment_outcome::accepted, "accepted"}, {assignment_outcome::rejected, "rejected"}});
}

struct assignment_response {
  std::string idempotency_key; // UUID
  assignment_outcome outcome = assignment_outcome::accepted;
  std::optional<std::string> reason;            // there when it was rejected
  std::optional<progress_report> last_progress; // the last one that still counts in the revision before
  std::uint32_t generation = 0;                 // the plan on the vehicle after this answer

  static constexpr auto fields =
      io::table("mission.assignment_response", io::field("idempotency_key", &assignment_response::idempotency_key),
                io::field("outcome", &assignment_response::outcome), io::field("reason", &assignment_response::reason),
                io::field("last_progress", &assignment_response::last_progress),
                io::field("generation", &assignment_response::generation));
  friend bool operator==(const assignment_response&, const assignment_response&) = default;
};

struct waypoint_insert {
  std::string idempotency_key;
  std::int32_t base_revision = 1;
  std::optional<std::string> after_item_id; // absent: in front of all items
  item waypoint = mission::waypoint{};      // of this kind

  static constexpr auto fields = io::table(
      "mission.waypoint_insert", io::field("idempotency_key", &waypoint_insert::idempotency_key),
      io::field("base_revision", &waypoint_insert::base_revision),
      io::field("after_item_id", &waypoint_insert::after_item_id), io::field("waypoint", &waypoint_insert::waypoint));
  friend bool operator==(const waypoint_insert&, const waypoint_insert&) = default;
};

struct tail {
  std::string idempotency_key;
  std::int32_t base_revision = 1;
  std::optional<std::string> after_item_id; // absent: all items are replaced
  std::vector<item> items;
  std::string reason; // for people

  static constexpr auto fields =
      io::table("mission.tail", io::field("idempotency_key", &tail::idempotency_key),
                io::field("base_revision", &tail::base_revision), io::field("after_item_id", &tail::after_item_id),
                io::field("items", &tail::items), io::field("reason", &tail::reason));
  friend bool operator==(const tail&, const tail&) = default;
};

} // namespace godwit::mission
