#include "actors/ground_port/forward_gate.hpp"

#include <limits>

#include "io/time_units.hpp"

namespace godwit::ground_port {

namespace {

constexpr std::int64_t max_interval_us = std::numeric_limits<std::int32_t>::max(); // what MAVLink can tell

std::uint32_t id_of(const telemetry& m) {
  return std::visit([]<class M>(const M&) { return M::message_id; }, m);
}

} // namespace

forward_gate::forward_gate(const std::vector<forward_rate>& rates) {
  for (const auto& each : rates)
    if (forwarded_messages::contains(each.message) && each.message != mavlink::heartbeat::message_id) {
      auto& lane = lanes_[forwarded_messages::place_of(each.message)];
      lane.default_interval_ns = lane.interval_ns = each.least_interval_ms * ns_per_ms;
    }
}

bool forward_gate::take(const telemetry& m, std::int64_t now_ns) {
  auto& lane = lanes_[forwarded_messages::place_of(id_of(m))];
  lane.newest = m;
  if (lane.interval_ns < 0) // asked for, so not counted
    return false;
  // A tenth less is let through: else a stream at just this rate would lose every second one to jitter.
  if (lane.due_ns && now_ns < *lane.due_ns - lane.interval_ns / 10) {
    ++held_back_;
    return false;
  }
  // One that comes late does not delay those after it, unless it is late by a whole interval.
  const bool is_in_time = lane.due_ns && now_ns < *lane.due_ns + lane.interval_ns;
  lane.due_ns = (is_in_time ? *lane.due_ns : now_ns) + lane.interval_ns;
  return true;
}

const std::optional<telemetry>& forward_gate::newest(std::uint32_t id) const {
  return lanes_[forwarded_messages::place_of(id)].newest;
}

bool forward_gate::set_interval(std::uint32_t id, std::int64_t interval_us) {
  if (!forwarded_messages::contains(id) || id == mavlink::heartbeat::message_id || interval_us < -1 ||
      interval_us > max_interval_us)
    return false;
  auto& lane = lanes_[forwarded_messages::place_of(id)];
  lane.interval_ns = interval_us == 0 ? lane.default_interval_ns : interval_us * ns_per_us;
  lane.due_ns.reset();
  return true;
}

} // namespace godwit::ground_port
