// What people have said through stations, and the executor has not answered for: only then does it go on.
//
//   (none) ──put()──> asked ──resolve()──> whoever called it passes it on, or refuses it
//
// A repetition of a command that is asked for already is not asked again. Of a stream the newest takes the place of the
// one that waits: the executor is asked as often as it answers. What comes over the bound is dropped and counted. Not
// kept over a crash: the station says it again. Pure. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/ground_port/vehicle_role/order.hpp"
#include "messages/executor/station_act.hpp"
#include "messages/vehicle_link/relay.hpp"

namespace godwit::ground_port::passing {

struct waiting_act {
  executor::station_act act;
  vehicle_link::relayed_frame frame;
  std::optional<vehicle_role::order> order = {}; // of a command: what is answered when it does not go on
  std::uint64_t request = 0;
};

class act_queue {
public:
  static constexpr std::size_t max_waiting = 32;

  // Requests are numbered from FIRST on: an answer to an act of an earlier life is none to one of this.
  explicit act_queue(std::uint64_t first = 1) : next_request_(first), first_request_(first) {}

  // The number of the request to the executor; nothing: it is not to be asked.
  [[nodiscard]] std::optional<std::uint64_t> put(waiting_act what);
  [[nodiscard]] std::optional<waiting_act> resolve(std::uint64_t request);

  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] std::uint64_t replaced() const { return replaced_; } // of streams
  [[nodiscard]] std::uint64_t asked() const { return next_request_ - first_request_; }

private:
  std::vector<waiting_act> waiting_;
  std::uint64_t next_request_;
  std::uint64_t first_request_;
  std::uint64_t dropped_ = 0;
  std::uint64_t replaced_ = 0;
};

} // namespace godwit::ground_port::passing
