// Texts of an autopilot from their pieces: a STATUSTEXT has 50 characters, and longer ones come in several, with one id
// and numbers from 0. The first piece that is not full ends the text.
//
//   take(piece) ──> the texts that are complete by it: none, this one, and one before it that was cut off
//   take_late() ──> one whose next piece did not come within piece_patience_ns, with "..." where it is cut
//
// One text is open at a time: autopilots send the pieces of a text one after the other. Pure; times are monotonic
// nanoseconds. Thread: one owner. Source: STATUSTEXT (253) of MAVLink's common.xml, fields id and chunk_seq.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/mavlink/messages/heartbeat.hpp"

namespace godwit::flight {

struct vehicle_message {
  std::uint8_t severity = 0; // MAV_SEVERITY
  std::string text;
  friend bool operator==(const vehicle_message&, const vehicle_message&) = default;
};

class text_assembler {
public:
  static constexpr std::int64_t piece_patience_ns = 1'000'000'000;
  static constexpr std::uint8_t max_pieces = 8; // what is longer is cut there

  [[nodiscard]] std::vector<vehicle_message> take(const io::mavlink::statustext& piece, std::int64_t now_ns);
  [[nodiscard]] std::optional<vehicle_message> take_late(std::int64_t now_ns);

private:
  struct open_text {
    vehicle_message message;
    std::uint16_t id = 0;
    std::uint8_t next_piece = 0;
    std::int64_t since_ns = 0; // its newest piece
  };

  [[nodiscard]] vehicle_message cut_off();

  std::optional<open_text> open_;
};

} // namespace godwit::flight
