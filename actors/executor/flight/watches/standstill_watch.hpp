// Notices a vehicle that is armed, in its mission mode, and does not move although its plan has it move.
//
// An autopilot whose plan was cut short, or that waits for something that it does not say, stands there with its motors
// on: whoever walks up to it must not think that it is done. People are told once for each place; nothing is sent
// because of it. An item that waits by itself has its time, and one that waits for ever says nothing. Pure. Thread: one
// at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/executor/flight/flight_context.hpp"

namespace godwit::executor {

class standstill_watch {
public:
  static constexpr std::int64_t patience_ns = 60'000'000'000;
  static constexpr double stands_within_m = 3;

  explicit standstill_watch(const flight_context& flight) : flight_(flight) {}

  // To be asked often. Adds what people are told.
  void look(effects& out, instant now);

private:
  struct standing {
    mission::position at;
    std::int64_t since_ns = 0; // monotonic
    std::uint16_t sequence = 0;
    bool is_told = false;
  };

  // None: it may stand where it is.
  [[nodiscard]] std::optional<mission::position> place_to_leave(instant now) const;
  [[nodiscard]] std::int64_t may_wait_ns(std::uint16_t sequence) const;

  const flight_context& flight_;
  std::optional<standing> standing_;
};

} // namespace godwit::executor
