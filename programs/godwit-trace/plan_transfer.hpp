// The commands `upload`, `download` and `clear`: a plan by hand, from a file to a vehicle and back.
//
// The vehicle's heartbeat is waited for, then the plan is moved by the same client that godwit flies with. On a
// terminal a bar on stderr says how far it is. What became of it is one sentence, or with `json` one object, on the
// output. Ctrl-C cancels: the vehicle is told. Errors: sentences on stderr; it fails unless the vehicle accepted.
// Thread: one, beside the link's own.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "actors/vehicle_link/core.hpp"
#include "actors/vehicle_link/settings.hpp"
#include "io/link/link.hpp"
#include "io/link/rx_queue.hpp"
#include "io/link/uri.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "messages/vehicle_link/transfer.hpp"
#include "programs/common/command.hpp"
#include "programs/godwit-trace/output.hpp"

namespace godwit::trace_tool {

using programs::exit_code;

using plan_request = std::variant<vehicle_link::upload_plan, vehicle_link::download_plan, vehicle_link::clear_plan>;

struct plan_transfer_options {
  io::link::uri where;
  plan_request what;
  std::string save_to; // download: this plan file
  bool json = false;
  std::chrono::milliseconds wait_for_vehicle{15'000};
  vehicle_link::settings link;
  io::mavlink::signing_settings signing;
};

// STOP is a descriptor that is polled and not read.
[[nodiscard]] exit_code run_plan_transfer(const plan_transfer_options& options, console& to, int stop);

// A bar on stderr that says how far a transfer is: redrawn on a terminal, nothing elsewhere. Thread: one.
class transfer_progress {
public:
  static constexpr int width = 40; // of the bar, in characters

  // Draws only if the words go to a terminal.
  explicit transfer_progress(console& to);
  void show(const vehicle_link::transfer::progress& how_far);
  void finish(); // takes the bar away

private:
  console& to_;
  bool is_drawn_ = false;
  bool draws_;
};

// A link to a vehicle for a program that has no actors: the same decisions as in godwit's own vehicle_link, driven by
// one loop.
//
//   vehicle_session session(settings, signing);
//   session.open(where);
//   while (...) for (const auto& each : session.next(until_ns, stop)) ...;   // answers and news, frames are sent
//
// Errors: open, as io::link::open_link. Thread: one, beside the link's own. Source: actors/vehicle_link/core.hpp.
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
