// What is known of who acts on the vehicle and of the plan on it, besides its modes: what an order is decided on.
//
// Volatile: a new incarnation knows nothing, and so proves and looks anew. Times: monotonic nanoseconds. Thread: plain
// values. Source: docs/decisions/authority.md.
#pragma once

#include <algorithm>
#include <cstdint>

#include "messages/vehicle_link/evidence.hpp"

namespace godwit::executor {

// A proof is what the vehicle itself has said of its plan: its id (PX4), all its items (ArduPilot), or the answer to an
// upload of ours. Signs of somebody else's plan undo it.
class vehicle_plan {
public:
  void doubt(std::int64_t now_ns) { doubted_ns_ = std::max(doubted_ns_, now_ns); }
  void prove(std::int64_t begun_ns, std::int64_t proved_ns) {
    begun_ns_ = begun_ns;
    proved_ns_ = proved_ns;
  }
  void forget() { proved_ns_ = begun_ns_ = 0; } // the vehicle holds something else from now on, or may

  // No doubt has come since the proof was begun.
  [[nodiscard]] bool is_proved() const { return proved_ns_ != 0 && begun_ns_ > doubted_ns_; }
  [[nodiscard]] bool is_proved_since(std::int64_t ns) const { return is_proved() && proved_ns_ >= ns; }
  [[nodiscard]] bool is_doubted() const { return doubted_ns_ != 0 && begun_ns_ <= doubted_ns_; }
  [[nodiscard]] std::int64_t doubted_ns() const { return doubted_ns_; }

private:
  std::int64_t begun_ns_ = 0;
  std::int64_t proved_ns_ = 0; // 0: not proved
  std::int64_t doubted_ns_ = 0;
};

struct evidence {
  std::int64_t foreign_ns = 0;   // of the newest act of somebody else
  std::int64_t commanded_ns = 0; // of the newest command of somebody else that the vehicle obeys
  vehicle_plan plan;
};

} // namespace godwit::executor
