// What the core of vehicle_link wants done, in this order. Thread: plain values.
#pragma once

#include <variant>
#include <vector>

#include "actors/line/transmission.hpp"
#include "actors/vehicle_link/message_allowlist.hpp"
#include "actors/vehicle_link/pending_commands.hpp"
#include "io/link/status.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "messages/vehicle_link/connection.hpp"
#include "messages/vehicle_link/evidence.hpp"
#include "messages/vehicle_link/transfer.hpp"

namespace godwit::vehicle_link {

using mavlink::instant;

using line::transmission;

// The transfer that an actor asked for is over.
struct resolved_transfer {
  std::uint64_t request_id = 0;
  transfer::outcome outcome;
};

// For whoever listens to the vehicle.
using announcement = std::variant<connection_changed, vehicle_restarted, signing_alert, line_findings,
                                  transfer::progress, relayed_frame, foreign_act, picture_taken>;

// Who asked for a look at the vehicle has it, or not.
struct resolved_look {
  std::uint64_t request_id = 0;
  looked what;
};

using effect =
    std::variant<transmission, resolved_command, resolved_transfer, resolved_look, observation, announcement>;
using effects = std::vector<effect>;

} // namespace godwit::vehicle_link
