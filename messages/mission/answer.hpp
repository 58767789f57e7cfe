// What the service answers that is no mission: what became of a batch, and what went wrong (RFC 9457). Thread: plain
// values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/mission/progress.hpp"

namespace godwit::mission {

struct receipt {
  std::uint32_t stored = 0;   // rows that were not there before
  std::uint32_t repeated = 0; // rows that were there already

  GODWIT_FIELDS(receipt, "mission.receipt", stored, repeated);
  friend bool operator==(const receipt&, const receipt&) = default;
};

// How far the service was told of a mission.
struct progress_status {
  std::uint32_t last_report_no = 0;             // 0: there is no report of it
  std::optional<progress_report> last_report{}; // that one; absent: there is none, or the service does not give it back

  GODWIT_FIELDS(progress_status, "mission.progress_status", last_report_no, last_report);
  friend bool operator==(const progress_status&, const progress_status&) = default;
};

// Which mission a vehicle is to fly next.
struct next_mission {
  std::string vehicle_id; // that was asked for
  std::string mission_id;

  GODWIT_FIELDS(next_mission, "mission.next_mission", vehicle_id, mission_id);
  friend bool operator==(const next_mission&, const next_mission&) = default;
};

struct wrong_place {
  std::string pointer; // JSON pointer (RFC 6901) into the body that was sent
  std::string detail;

  GODWIT_FIELDS(wrong_place, "mission.wrong_place", pointer, detail);
  friend bool operator==(const wrong_place&, const wrong_place&) = default;
};

struct problem {
  std::optional<std::string> type;
  std::string title;
  std::int32_t status = 0; // as the HTTP status
  std::optional<std::string> detail;
  std::optional<std::string> instance;
  std::vector<wrong_place> errors;

  GODWIT_FIELDS(problem, "mission.problem", type, title, status, detail, instance, errors);
  friend bool operator==(const problem&, const problem&) = default;
};

} // namespace godwit::mission
