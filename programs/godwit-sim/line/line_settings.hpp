// How bad a line is, as it stands on the command line:
//
//   loss=0.1,dup=0.01,reorder=0.05,late=0.01,delay=15ms,jitter=5ms,biterrors=1e-5
//   out.loss=0.3,in.cut                  one way only: out from the vehicle, in towards it
//   none                                 a good line
//
// Probabilities are of each frame, each way; biterrors are of each bit. What is not named is good. A later word
// overrides an earlier one. Errors: a sentence that names the word and the allowed form. Thread: values.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

namespace godwit::sim {

struct line_settings {
  double loss = 0;        // 0 to 1
  double duplication = 0; // 0 to 1
  double reorder = 0;     // 0 to 1: held back, so that later frames overtake it
  double late = 0;        // 0 to 1: held back for so long that what it says is no longer true
  double bit_errors = 0;  // 0 to 1
  std::chrono::nanoseconds delay{0};
  std::chrono::nanoseconds jitter{0}; // at random up to this, on top of the delay; frames stay in order
  bool is_cut = false;                // nothing comes through

  bool operator==(const line_settings&) const = default;
};

struct line_faults {
  line_settings in;  // towards the vehicle
  line_settings out; // from the vehicle
  bool operator==(const line_faults&) const = default;
};

inline constexpr std::chrono::seconds max_line_delay{60};

[[nodiscard]] tl::expected<line_faults, std::string> parse_line_faults(std::string_view text);

// The canonical form, which parse_line_faults reads back as an equal value.
[[nodiscard]] std::string text_of(const line_faults& faults);

} // namespace godwit::sim
