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

  GODWIT_FIELDS(assignment, "mission.assignment", assignment_id, base_revision, revision, replace_after_item_id, items);
  friend bool operator==(const assignment&, const assignment&) = default;
};

struct assignment_list {
  std::vector<assignment> assignments; // oldest first

  GODWIT_FIELDS(assignment_list, "mission.assignment_list", assignments);
  friend bool operator==(const assignment_list&, const assignment_list&) = default;
};

enum class assignment_outcome { accepted, rejected };

GODWIT_ENUM_NAMES(assignment_outcome, accepted, rejected);

struct assignment_response {
  std::string idempotency_key; // UUID
  assignment_outcome outcome = assignment_outcome::accepted;
  std::optional<std::string> reason;            // there when it was rejected
  std::optional<progress_report> last_progress; // the last one that still counts in the revision before
  std::uint32_t generation = 0;                 // the plan on the vehicle after this answer

  GODWIT_FIELDS(assignment_response, "mission.assignment_response", idempotency_key, outcome, reason, last_progress,
                generation);
  friend bool operator==(const assignment_response&, const assignment_response&) = default;
};

struct waypoint_insert {
  std::string idempotency_key;
  std::int32_t base_revision = 1;
  std::optional<std::string> after_item_id; // absent: in front of all items
  item waypoint = mission::waypoint{};      // of this kind

  GODWIT_FIELDS(waypoint_insert, "mission.waypoint_insert", idempotency_key, base_revision, after_item_id, waypoint);
  friend bool operator==(const waypoint_insert&, const waypoint_insert&) = default;
};

struct tail {
  std::string idempotency_key;
  std::int32_t base_revision = 1;
  std::optional<std::string> after_item_id; // absent: all items are replaced
  std::vector<item> items;
  std::string reason; // for people

  GODWIT_FIELDS(tail, "mission.tail", idempotency_key, base_revision, after_item_id, items, reason);
  friend bool operator==(const tail&, const tail&) = default;
};

} // namespace godwit::mission
