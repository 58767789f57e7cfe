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

constexpr auto enum_names(mission_origin) {
  return io::names<mission_origin>({{mission_origin::service, "service"},
                                    {mission_origin::file, "file"},
                                    {mission_origin::upload, "upload"},
                                    {mission_origin::station, "station"},
                                    {mission_origin::unknown, "unknown"}});
}

enum class mission_place {
  prepared,  // on the ground: the next start flies it
  in_flight, // it is flown
  waiting,   // it, or this revision of it, comes next
  ended,     // complete or aborted
  left,      // another one took its place before its end
  refused    // it is not flown
};

constexpr auto enum_names(mission_place) {
  return io::names<mission_place>({{mission_place::prepared, "prepared"},
                                   {mission_place::in_flight, "in_flight"},
                                   {mission_place::waiting, "waiting"},
                                   {mission_place::ended, "ended"},
                                   {mission_place::left, "left"},
                                   {mission_place::refused, "refused"}});
}

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
  static constexpr auto fields =
      io::table("executor.known_mission", io::field("mission_id", &known_mission::mission_id),
                io::field("revision", &known_mission::revision), io::field("origin", &known_mission::origin),
                io::field("place", &known_mission::place), io::field("outcome", &known_mission::outcome),
                io::field("last_report_at", &known_mission::last_report_at), io::field("items", &known_mission::items),
                io::field("items_done", &known_mission::items_done), io::field("reason", &known_mission::reason));
  friend bool operator==(const known_mission&, const known_mission&) = default;
};

// Of those that were flown before the newest are told.
inline constexpr std::size_t max_earlier_missions = 4;

struct get_missions {
  static constexpr auto fields = io::table("executor.get_missions");
};

struct known_missions {
  std::vector<known_mission> list; // what is flown or prepared, what waits, what was refused, then the newest first
  static constexpr auto fields = io::table("executor.known_missions", io::field("list", &known_missions::list));
  friend bool operator==(const known_missions&, const known_missions&) = default;
};

} // namespace godwit::executor
