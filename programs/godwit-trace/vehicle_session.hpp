// A link to a vehicle for a program that has no actors: the same decisions as in godwit's own vehicle_link, driven by
// one loop.
//
//   vehicle_session session(settings, signing);
//   session.open(where);
//   while (...) for (const auto& each : session.next(until_ns, stop)) ...;   // answers and news, frames are sent
//
// Errors: open, as io::link::open_link. Thread: one, beside the link's own. Source: actors/vehicle_link/core.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "actors/vehicle_link/core.hpp"
#include "io/link/link.hpp"
#include "io/link/rx_queue.hpp"

namespace godwit::trace_tool {

class vehicle_session {
public:
  vehicle_session(const vehicle_link::settings& configured, const vehicle_link::signing_settings& signing);
  vehicle_session(const vehicle_session&) = delete;
  vehicle_session& operator=(const vehicle_session&) = delete;
  ~vehicle_session();

  [[nodiscard]] tl::expected<void, std::string> open(const io::link::uri& where);

  // Waits until something happens, UNTIL_NS has come, or the descriptor STOP becomes readable; handles it, and gives
  // what there is to tell.
  [[nodiscard]] vehicle_link::effects next(std::int64_t until_ns, int stop);

  // Sends the frames among EFFECTS, and gives the rest.
  [[nodiscard]] vehicle_link::effects carry_out(vehicle_link::effects wanted);

  [[nodiscard]] static vehicle_link::instant now();
  [[nodiscard]] vehicle_link::core& core() { return core_; }
  // The newest word of the link, such as why it is down.
  [[nodiscard]] const io::link::link_status& link_status() const { return status_; }

private:
  void wait(std::int64_t until_ns, int stop) const;
  void wake() const;
  [[nodiscard]] vehicle_link::effects take(const io::link::link_status& what);
  [[nodiscard]] vehicle_link::effects take(const io::link::arrival& what);

  vehicle_link::core core_;
  io::link::rx_queue incoming_;
  io::link::link_status status_;
  int descriptor_; // readable when something has come in
  std::unique_ptr<io::link::link> link_;
};

} // namespace godwit::trace_tool
