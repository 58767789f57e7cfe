// What is to go wrong with a vehicle, in the words of the command line and of the control port:
//
//   faults loss=0.1,delay=15ms    how the line is from now on (line/line_settings.hpp); none: good
//   cut   cut 5s                  the line, until it is restored, or for some time
//   restore                       ends every cut
//   reboot                        the autopilot
//   gps lost   gps back
//   way blocked   way free
//   battery 20                    percent
//   camera cut   camera back      it is there, and sends nothing
//   say PreArm: low voltage       a STATUSTEXT of the autopilot, of 250 bytes at most
//   refuse MISSION_START=DENIED   the command is answered so from now on; a number will do for either
//   refuse 300 2                  so often; DENIED when no answer is named
//   accept MISSION_START          no longer
//
// Times are real ones, also when the world runs faster. Errors: a sentence that names the word and the allowed form.
// Thread: values.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <tl/expected.hpp>

#include "programs/godwit-sim/line/line_settings.hpp"

namespace godwit::sim {

namespace fault {

struct set_line {
  line_faults faults;
  bool operator==(const set_line&) const = default;
};
struct cut {
  std::optional<std::chrono::nanoseconds> time; // none: until it is restored
  bool operator==(const cut&) const = default;
};
struct restore {
  bool operator==(const restore&) const = default;
};
struct reboot {
  bool operator==(const reboot&) const = default;
};
struct gps {
  bool is_lost = false;
  bool operator==(const gps&) const = default;
};
struct way {
  bool is_blocked = false;
  bool operator==(const way&) const = default;
};
struct battery {
  double percent = 0; // 0 to 100
  bool operator==(const battery&) const = default;
};
struct camera {
  bool is_cut = false;
  bool operator==(const camera&) const = default;
};
struct say {
  std::string words;
  bool operator==(const say&) const = default;
};
struct refuse {
  std::uint16_t command = 0;
  std::uint8_t result = 0; // MAV_RESULT
  int times = -1;          // -1: from now on; 0: no longer
  bool operator==(const refuse&) const = default;
};
using any = std::variant<set_line, cut, restore, reboot, gps, way, battery, camera, say, refuse>;

} // namespace fault

[[nodiscard]] tl::expected<fault::any, std::string> parse_fault(std::string_view text);

// What follows the word `refuse`.
[[nodiscard]] tl::expected<fault::refuse, std::string> parse_refusal(std::string_view text);

// One that comes by itself: TIME=WHAT, as in "30s=gps lost". The time is since the start of the program.
struct timed_fault {
  std::chrono::nanoseconds after{0};
  fault::any what;
};
[[nodiscard]] tl::expected<timed_fault, std::string> parse_timed_fault(std::string_view text);

// For people: "the line is cut for 5s".
[[nodiscard]] std::string sentence_of(const fault::any& what);

} // namespace godwit::sim
