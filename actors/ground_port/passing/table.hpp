// What of a ground station's goes on to the vehicle: one table of messages and one of commands.
//
//   list       what becomes of it
//   passes     it goes on as it came: reading, corrections, cameras, gimbals
//   owned      godwit's: plans, the current item, start, pause, go to. It answers itself, and nothing goes on
//   person     the vehicle is that person's before it goes on (messages/executor/station_act.hpp)
//   disarmed   goes on to a vehicle that stands disarmed, which is checked anew after it; else it is refused
//   setting    only where the settings name it (ground.also_passes)
//
// What is on no list is refused: nobody has looked at what it does. The lists hold whatever component is meant: an
// ArduPilot obeys what is meant for a component that it has never heard. Thread: constants. Source: MAVLink common.xml
// and ardupilotmega.xml; who obeys what: docs/decisions/links.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/mavlink/frame.hpp"
#include "messages/executor/station_act.hpp"

namespace godwit::ground_port::passing {

enum class pass_list { passes, owned, person, disarmed, setting };

inline constexpr int no_target = -1;

struct message_row {
  std::uint32_t id = 0;
  pass_list on = pass_list::passes;
  int target_at = no_target;                            // where its payload names the system that is meant
  bool names_component = true;                          // in the byte after
  executor::act_kind kind = executor::act_kind::stream; // of a person's
  std::string_view name;
};

struct command_row {
  std::uint16_t command = 0;
  pass_list on = pass_list::passes;
  executor::act_kind kind = executor::act_kind::command; // of a person's
  std::string_view name;                                 // for people, and for the setting
};

// Null: it is on no list.
[[nodiscard]] const message_row* find_message(std::uint32_t id);
[[nodiscard]] const command_row* find_command(std::uint16_t command);

// Whom FRAME is meant for; 0: all. Bytes that were cut off are 0.
[[nodiscard]] io::mavlink::sender target_of(const message_row& row, const io::mavlink::frame_view& frame);

// A name that is on the list of what the settings decide.
[[nodiscard]] bool is_for_setting(std::string_view name);

} // namespace godwit::ground_port::passing
