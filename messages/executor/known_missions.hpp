// Which missions the executor knows, for people: the one that is flown or prepared, what waits for its turn, what was
// refused, and those that were flown before. Told when it has changed, and asked for by who begins. Thread: plain
// values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::executor {

enum class mission_origin {
  service, // the missions service
  file,    // the one of --mission
  upload,  // of an operator, through the operator's port
  station, // a ground station
  unknown  // of one that was flown before nobody keeps it
};

GODWIT_ENUM_NAMES(mission_origin, service, file, upload, station, unknown);

enum class mission_place {
  prepared,  // on the ground: the next start flies it
  in_flight, // it is flown
  waiting,   // it, or this revision of it, comes next
  ended,     // complete or aborted
  left,      // another one took its place before its end
  refused    // it is not flown
};

GODWIT_ENUM_NAMES(mission_place, prepared, in_flight, waiting, ended, left, refused);

struct known_mission {
  std::string mission_id;               // empty: it has none, because nobody could read it
  std::optional<std::int32_t> revision; // none: not known
  mission_origin origin = mission_origin::unknown;
  mission_place place = mission_place::prepared;
  std::string outcome;                     // of one that has ended: complete, aborted
  std::string last_report_at;              // UTC, RFC 3339; empty: nothing was reported of it
  std::optional<std::uint32_t> items;      // none: they are not kept
  std::optional<std::uint32_t> items_done; // of these
  std::string reason;                      // sentence for people: why it waits, was refused, does not go on
  GODWIT_FIELDS(known_mission, "executor.known_mission", mission_id, revision, origin, place, outcome, last_report_at,
                items, items_done, reason);
  friend bool operator==(const known_mission&, const known_mission&) = default;
};

// Of those that were flown before the newest are told.
inline constexpr std::size_t max_earlier_missions = 4;

struct get_missions {
  static constexpr auto fields = io::table("executor.get_missions");
};

struct known_missions {
  std::vector<known_mission> list; // what is flown or prepared, what waits, what was refused, then the newest first
  GODWIT_FIELDS(known_missions, "executor.known_missions", list);
  friend bool operator==(const known_missions&, const known_missions&) = default;
};

} // namespace godwit::executor
