// How far a mission got, as the service is told (config/schemas/progress_report.schema.json and progress.schema.json).
// Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::mission {

enum class progress_kind {
  started,
  reached,
  passed, // an item that acts or waits: the vehicle has gone on from it, which does not say that the act was of use
  skipped,
  complete,
  aborted
};

constexpr auto enum_names(progress_kind) {
  return io::names<progress_kind>({{progress_kind::started, "started"},
                                   {progress_kind::reached, "reached"},
                                   {progress_kind::passed, "passed"},
                                   {progress_kind::skipped, "skipped"},
                                   {progress_kind::complete, "complete"},
                                   {progress_kind::aborted, "aborted"}});
}

// It is the last word about an item: nothing more comes of it.
[[nodiscard]] constexpr bool settles_item(progress_kind kind) {
  return kind == progress_kind::reached || kind == progress_kind::passed || kind == progress_kind::skipped;
}

struct progress_report {
  std::string mission_id; // UUID
  std::int32_t revision = 1;
  std::uint32_t generation = 0; // which plan on the vehicle
  std::uint32_t report_no = 0;  // 1, 2, 3, ... in each mission, without a gap
  progress_kind kind = progress_kind::started;
  std::optional<std::string> item_id;      // absent: about the mission as a whole
  std::optional<std::uint32_t> item_index; // from 0 on; absent as item_id
  std::string at;                          // UTC, RFC 3339
  bool inferred = false;                   // concluded from what came later

  static constexpr auto fields = io::table(
      "mission.progress_report", io::field("mission_id", &progress_report::mission_id),
      io::field("revision", &progress_report::revision), io::field("generation", &progress_report::generation),
      io::field("report_no", &progress_report::report_no), io::field("kind", &progress_report::kind),
      io::field("item_id", &progress_report::item_id), io::field("item_index", &progress_report::item_index),
      io::field("at", &progress_report::at), io::field("inferred", &progress_report::inferred));
  friend bool operator==(const progress_report&, const progress_report&) = default;
};

// What is posted: reports of one mission in order.
struct progress_batch {
  std::string idempotency_key; // UUID
  std::vector<progress_report> reports;

  static constexpr auto fields =
      io::table("mission.progress", io::field("idempotency_key", &progress_batch::idempotency_key),
                io::field("reports", &progress_batch::reports));
  friend bool operator==(const progress_batch&, const progress_batch&) = default;
};

} // namespace godwit::mission
