// What a person says of a point of interest. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::scan_controller {

enum class decision { confirm, decline };

constexpr auto enum_names(decision) {
  return io::names<decision>({{decision::confirm, "confirm"}, {decision::decline, "decline"}});
}

// Of a point that is shown. Whoever passes it on has authenticated the person. Answered with decide_answer when it is
// on the disk; said again, it is answered as the first time.
struct decide_point {
  std::uint64_t number = 0;
  decision says = decision::decline;
  std::string by;
  static constexpr auto fields = io::table("scan_controller.decide_point", io::field("number", &decide_point::number),
                                           io::field("says", &decide_point::says), io::field("by", &decide_point::by));
};

struct decide_answer {
  bool is_taken = false;
  std::string reason; // sentence for people; empty when taken
  static constexpr auto fields =
      io::table("scan_controller.decide_answer", io::field("is_taken", &decide_answer::is_taken),
                io::field("reason", &decide_answer::reason));
};

} // namespace godwit::scan_controller
