// Whether anybody sees the ground. Thread: plain values.
#pragma once

#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::scan_controller {

// Told each half second by who looks, while a mission with scanning is flown; whoever says nothing does not see.
struct view {
  bool is_seeing = false;
  std::string reason; // why not: a sentence for people
  GODWIT_FIELDS(view, "scan_controller.view", is_seeing, reason);
};

} // namespace godwit::scan_controller
