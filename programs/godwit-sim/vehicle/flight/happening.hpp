// What happens on the way, for who tells the ground about it. Thread: values.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace godwit::sim {

struct took_off {};
struct landed {};   // touched the ground
struct arrived {};  // a `go`, a `climb` or a rover's `come_back` is done
struct item_begun { // the current item is a new one
  int sequence = 0;
};
struct item_reached { // a NAV item is done; before the next one begins
  int sequence = 0;
};
struct item_skipped { // it is of no use here: an unknown DO command, a NAV command that this craft can not do
  int sequence = 0;
  std::string reason; // for a STATUSTEXT
};
struct mission_completed {};
using happening = std::variant<took_off, landed, arrived, item_begun, item_reached, item_skipped, mission_completed>;
using happenings = std::vector<happening>;

} // namespace godwit::sim
