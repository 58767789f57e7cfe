// What the autopilot says in words, as lines of the log: "the vehicle reports: PreArm: Compass not calibrated". So
// people read it where they read everything else: in the journal of systemd, on the page of operators, in a bundle.
//
// Autopilots repeat what holds on, and can be made to say any number of things. The same text is announced once in
// repeat_ns, at most max_lines in window_ns, and how many were left out is announced after that. Texts for developers
// of the autopilot (MAV_SEVERITY_DEBUG) are left out. Nothing is done because of a text. Pure; thread: one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "actors/domain/vehicle_text/text_assembler.hpp"
#include "actors/executor/effects.hpp"

namespace godwit::executor {

class vehicle_messages {
public:
  static constexpr std::int64_t repeat_ns = 60'000'000'000;
  static constexpr std::int64_t window_ns = 10'000'000'000;
  static constexpr std::size_t max_lines = 20;      // in a window; a start of PX4 says some ten things
  static constexpr std::size_t max_remembered = 32; // texts that are not repeated

  // Return the texts that are complete by then, also those that are told to nobody.
  [[nodiscard]] std::vector<flight::vehicle_message> take(effects& out, const io::mavlink::statustext& piece,
                                                          std::int64_t now_ns);
  [[nodiscard]] std::vector<flight::vehicle_message> look(effects& out, std::int64_t now_ns); // to be asked often

private:
  struct told_text {
    std::string text;
    std::int64_t at_ns = 0;
  };

  void begin_window(effects& out, std::int64_t now_ns);
  void tell(effects& out, const flight::vehicle_message& message, std::int64_t now_ns);
  [[nodiscard]] bool is_repeated(const std::string& text, std::int64_t now_ns);

  flight::text_assembler pieces_;
  std::deque<told_text> told_;
  std::int64_t window_began_ns_ = 0;
  std::size_t lines_ = 0;    // in this window
  std::size_t left_out_ = 0; // in this window
};

} // namespace godwit::executor
