// What one event of a transfer leads to. Thread: plain values.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "actors/vehicle_link/transfer/outcome.hpp"
#include "io/mavlink/messages/mission_transfer.hpp"

namespace godwit::vehicle_link::transfer {

using outgoing =
    std::variant<io::mavlink::mission_count, io::mavlink::mission_item_int, io::mavlink::mission_ack,
                 io::mavlink::mission_request_list, io::mavlink::mission_request_int, io::mavlink::mission_clear_all>;

struct step {
  std::vector<outgoing> messages;   // to be sent in this order
  std::optional<progress> advanced; // news for people
  std::optional<outcome> finished;  // the transfer is over; the last step of it
};

} // namespace godwit::vehicle_link::transfer
