// Frames of a vehicle, and what a core sent in answer: for tests that speak with vehicle_link without a link.
#pragma once

#include <optional>
#include <vector>

#include "actors/vehicle_link/core.hpp"

namespace godwit::vehicle_link::test {

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t s = 1'000 * ms;
inline constexpr std::int64_t wall_start_ns = 1'800'000'000 * s; // 2027

[[nodiscard]] inline instant at(std::int64_t monotonic_ns) { return {monotonic_ns, wall_start_ns + monotonic_ns}; }

// Speaks as the autopilot of system 1 and gives its bytes to a core.
class vehicle_voice {
public:
  template <class M>
  [[nodiscard]] effects say(core& to, const M& message, std::int64_t now_ns, mavlink::sender as = {1, 1}) {
    return to.on_bytes(io::link::only_peer, true, mavlink::encode(message, as, sequence_++).span(), at(now_ns));
  }

  [[nodiscard]] effects beat(core& to, std::int64_t now_ns,
                             mavlink::mav_autopilot autopilot = mavlink::mav_autopilot::px4) {
    return say(to,
               mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::quadrotor),
                                  .autopilot = mavlink::number(autopilot)},
               now_ns);
  }

private:
  std::uint8_t sequence_ = 0;
};

// The messages of type M among the frames that were sent.
template <class M>
[[nodiscard]] std::vector<M> sent_of(const effects& done) {
  std::vector<M> result;
  for (const auto& each : done)
    if (const auto* out = std::get_if<transmission>(&each); out && out->frame.view().id() == M::message_id)
      result.push_back(mavlink::decode<M>(out->frame.view()));
  return result;
}

template <class T>
[[nodiscard]] std::vector<T> announced(const effects& done) {
  std::vector<T> result;
  for (const auto& each : done)
    if (const auto* what = std::get_if<announcement>(&each); what && std::holds_alternative<T>(*what))
      result.push_back(std::get<T>(*what));
  return result;
}

template <class M>
[[nodiscard]] std::vector<M> observed(const effects& done) {
  std::vector<M> result;
  for (const auto& each : done)
    if (const auto* what = std::get_if<observation>(&each); what && std::holds_alternative<M>(*what))
      result.push_back(std::get<M>(*what));
  return result;
}

[[nodiscard]] inline std::vector<resolved_command> resolved(const effects& done) {
  std::vector<resolved_command> result;
  for (const auto& each : done)
    if (const auto* what = std::get_if<resolved_command>(&each))
      result.push_back(*what);
  return result;
}

[[nodiscard]] inline io::link::link_status link_up() { return {io::link::link_phase::up, {}, 0}; }

// Settings without streams: the tests of commands are not about them.
[[nodiscard]] inline settings quiet() {
  settings result;
  result.streams.clear();
  return result;
}

} // namespace godwit::vehicle_link::test
