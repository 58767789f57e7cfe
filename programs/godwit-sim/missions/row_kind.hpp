// What vehicles deliver, and how its rows are called apart. Thread: values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::sim::missions {

enum class row_kind {
  observation,  // observation_id
  ignored_item, // ignored_id
  progress,     // report_no
  change,       // an insert or a tail: its idempotency key
  response,     // to an assignment: assignment_id
};

GODWIT_ENUM_NAMES(row_kind, observation, ignored_item, progress, change, response);

struct stored_row {
  std::string id;
  std::string text;             // JSON
  std::uint64_t deliveries = 1; // in requests with different keys; the row itself is there once
};

} // namespace godwit::sim::missions
