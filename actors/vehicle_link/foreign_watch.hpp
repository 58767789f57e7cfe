// Notices on the vehicle's line that somebody else commands it, or brings it a plan
// (messages/vehicle_link/evidence.hpp).
//
// What counts: a COMMAND_ACK, ACCEPTED or IN_PROGRESS, of a command by which somebody has the vehicle, to another
// addressee; one without an addressee for a command that is not ours. A MISSION_ACK or a request for items to somebody
// else; MISSION_COUNT, MISSION_CLEAR_ALL, MISSION_WRITE_PARTIAL_LIST and MISSION_SET_CURRENT of somebody else to the
// vehicle. What ground_port has forwarded for a station is its own: it judges the answer. Pure. Thread: one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages.hpp"
#include "messages/vehicle_link/evidence.hpp"

namespace godwit::vehicle_link {

class foreign_watch {
public:
  static constexpr std::size_t max_forwarded = 32;
  static constexpr std::int64_t forwarded_counts_ns = 5'000'000'000; // a slow vehicle answers, and answers twice

  // By ground_port, for a station.
  void on_forwarded(const relayed_frame& what, std::int64_t now_ns);

  // IS_OURS: it is addressed to us, or to nobody and is about a command of ours.
  [[nodiscard]] std::optional<foreign_act> on_ack(const io::mavlink::command_ack& m, bool is_ours, std::int64_t now_ns);
  // Of the vehicle, about its mission, to somebody else.
  [[nodiscard]] std::optional<foreign_act> on_plan_answer(std::uint8_t system, std::uint8_t component,
                                                          std::int64_t now_ns);
  // FRAME is of somebody who is neither the vehicle nor this process; VEHICLE: the system that it has to be for.
  [[nodiscard]] std::optional<foreign_act> on_frame(const io::mavlink::frame_view& frame, std::uint8_t vehicle,
                                                    std::int64_t now_ns);

private:
  struct forwarded {
    std::uint8_t system = 0;
    std::uint8_t component = 0;
    std::uint16_t command = 0; // MAV_CMD, or the message id of SET_MODE
    std::int64_t at_ns = 0;
  };

  [[nodiscard]] bool is_forwarded(const io::mavlink::command_ack& m, std::int64_t now_ns) const;
  [[nodiscard]] foreign_act act(foreign_kind kind, std::uint16_t command, io::mavlink::sender who, std::int64_t now_ns);

  std::deque<forwarded> forwarded_;
  std::int64_t last_ns_ = 0;
};

} // namespace godwit::vehicle_link
