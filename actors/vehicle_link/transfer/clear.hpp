// Takes the plan from the vehicle, and looks whether it is gone.
//
//                      ACK accepted
//   start ──> clearing ───────────> resolving ──no items──> accepted
//                │ ^                   └─items left─┐
//                │ └────────────────────────────────┘ once more, at most max_clear_attempts
//                └──> refused, timed_out (from resolving too), cancelled
//
// The ACK carries nothing to tell it from a late one of another transfer, so it is not believed alone: the vehicle is
// asked how many items it holds. ArduPilot may count its home. A refusal is believed when nothing else follows it for a
// round trip. An upload of no items is the same with MISSION_COUNT 0. MISSION_ACK is no answer to all types at once
// that could be looked after, so they are cleared one by one. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/vehicle_link/transfer/operation.hpp"
#include "actors/vehicle_link/transfer/plan_reader.hpp"

namespace godwit::vehicle_link::transfer {

inline constexpr int max_clear_attempts = 3;

enum class clear_with { mission_clear_all, mission_count_0 };

class clear final : public operation {
public:
  // LINE outlives it.
  clear(clear_with how, const parties& who, const peer_profile& peer, round_trip& line)
      : how_(how), who_(who), peer_(peer), line_(line) {}

  void start(step& out, std::int64_t now_ns) override;
  void on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) override;
  void on_ack(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) override;
  void on_time(step& out, std::int64_t now_ns) override;
  void cancel(step& out, std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t next_deadline_ns() const override;

private:
  void ask(step& out, std::int64_t now_ns);
  void ask_again(step& out, std::int64_t now_ns);
  void refuse(step& out, std::uint8_t result, std::int64_t now_ns);
  void look_at_reader(step& out, std::int64_t now_ns);
  void finish(step& out, outcome what, std::int64_t now_ns) const;
  [[nodiscard]] outcome failed(verdict how, std::string reason) const;
  [[nodiscard]] std::int64_t gives_up_ns() const {
    return attempted_ns_ + (busy_ == 0 ? 1 : patience_with_busy) * peer_.patience_ns;
  }

  clear_with how_;
  parties who_;
  peer_profile peer_;
  round_trip& line_;
  std::optional<plan_reader> reader_; // while resolving
  std::int64_t started_ns_ = 0;
  std::int64_t attempted_ns_ = 0;
  std::int64_t asked_ns_ = 0;
  int asked_times_ = 0; // of this attempt
  int attempts_ = 1;
  std::uint8_t refusal_ = 0;     // not yet believed
  std::uint8_t busy_ = 0;        // what a vehicle that is busy has said
  bool has_closed_ours_ = false; // since it was asked last
};

} // namespace godwit::vehicle_link::transfer
