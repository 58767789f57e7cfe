// What a person says of a point of interest. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::scan_controller {

enum class decision { confirm, decline };

GODWIT_ENUM_NAMES(decision, confirm, decline);

// Of a point that is shown. Whoever passes it on has authenticated the person. Answered with decide_answer when it is
// on the disk; said again, it is answered as the first time.
struct decide_point {
  std::uint64_t number = 0;
  decision says = decision::decline;
  std::string by;
  GODWIT_FIELDS(decide_point, "scan_controller.decide_point", number, says, by);
};

struct decide_answer {
  bool is_taken = false;
  std::string reason; // sentence for people; empty when taken
  GODWIT_FIELDS(decide_answer, "scan_controller.decide_answer", is_taken, reason);
};

} // namespace godwit::scan_controller
