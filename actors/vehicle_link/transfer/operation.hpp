// One transfer, of whichever kind: the events that it takes. The client has one at a time.
//
// All that arrives has been found to be for us and for our mission type. An operation that has put an outcome into its
// step takes no further event. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>

#include "actors/vehicle_link/transfer/parties.hpp"
#include "actors/vehicle_link/transfer/step.hpp"

namespace godwit::vehicle_link::transfer {

class operation {
public:
  operation() = default;
  operation(const operation&) = delete;
  operation& operator=(const operation&) = delete;
  virtual ~operation() = default;

  virtual void start(step& out, std::int64_t now_ns) = 0;
  virtual void on_request(step& /*out*/, std::uint16_t /*item*/, std::int64_t /*now_ns*/) {}
  virtual void on_count(step& /*out*/, const mavlink::mission_count& /*m*/, std::int64_t /*now_ns*/) {}
  virtual void on_item(step& /*out*/, const mavlink::mission_item_int& /*m*/, std::int64_t /*now_ns*/) {}
  virtual void on_ack(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) = 0;
  // The vehicle says which plan it holds, and of how many items where it tells that.
  virtual void on_plan_id(step& /*out*/, std::uint32_t /*plan_id*/, std::optional<int> /*count*/,
                          std::int64_t /*now_ns*/) {}
  virtual void on_time(step& out, std::int64_t now_ns) = 0;
  virtual void cancel(step& out, std::int64_t now_ns) = 0;

  [[nodiscard]] virtual std::int64_t next_deadline_ns() const = 0;
  // MISSION_ACK(OPERATION_CANCELLED) may have been lost, and the vehicle may still ask.
  [[nodiscard]] virtual bool wants_cancel_repeated() const { return false; }
};

} // namespace godwit::vehicle_link::transfer
