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
  passed, // an item that acts or waits: the vehicle has gone on from it; whether the act succeeded says its outcome
  skipped,
  complete,
  aborted
};

GODWIT_ENUM_NAMES(progress_kind, started, reached, passed, skipped, complete, aborted);

// It is the last word about an item: nothing more comes of it.
[[nodiscard]] constexpr bool settles_item(progress_kind kind) {
  return kind == progress_kind::reached || kind == progress_kind::passed || kind == progress_kind::skipped;
}

// What became of an act, as the vehicle or its camera reports it.
enum class act_outcome {
  confirmed, // it is done
  failed     // it is not: the load is still on board, the picture was not taken
};

GODWIT_ENUM_NAMES(act_outcome, confirmed, failed);

// Pictures taken on the way to an item, or by it. Numbers as the autopilot or the camera counts them.
struct picture_count {
  std::uint32_t taken = 0;
  std::optional<std::int32_t> first = {}; // absent: none was taken
  std::optional<std::int32_t> last = {};
  std::optional<std::uint32_t> planned = {}; // by the trigger's distance; absent: no trigger was on
  GODWIT_FIELDS(picture_count, "mission.picture_count", taken, first, last, planned);
  friend bool operator==(const picture_count&, const picture_count&) = default;
};

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
  // Both are sent to services of version 2.1 on.
  std::optional<act_outcome> outcome = {}; // absent: nobody reported what became of it
  std::optional<picture_count> pictures = {};

  GODWIT_FIELDS(progress_report, "mission.progress_report", mission_id, revision, generation, report_no, kind, item_id,
                item_index, at, inferred, outcome, pictures);
  friend bool operator==(const progress_report&, const progress_report&) = default;
};

// What is posted: reports of one mission in order.
struct progress_batch {
  std::string idempotency_key; // UUID
  std::vector<progress_report> reports;

  GODWIT_FIELDS(progress_batch, "mission.progress", idempotency_key, reports);
  friend bool operator==(const progress_batch&, const progress_batch&) = default;
};

} // namespace godwit::mission
