// The commands `upload`, `download` and `clear`: a plan by hand, from a file to a vehicle and back.
//
// The vehicle's heartbeat is waited for, then the plan is moved by the same client that godwit flies with. On a
// terminal a bar on stderr says how far it is. What became of it is one sentence, or with `json` one object, on the
// output. Ctrl-C cancels: the vehicle is told. Errors: sentences on stderr; it fails unless the vehicle accepted.
// Thread: one, beside the link's own.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "actors/vehicle_link/settings.hpp"
#include "io/link/uri.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "messages/vehicle_link/transfer.hpp"
#include "programs/common/exit_code.hpp"
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

} // namespace godwit::trace_tool
