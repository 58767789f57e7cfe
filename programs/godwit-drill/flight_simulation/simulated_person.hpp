// A person beside the vehicle with a station of their own: on godwit's line to it, or on another one. Godwit knows of
// what they do from the vehicle alone. What they send arrives at once, and nothing of it is lost.
//
//   simulated_person pilot({254, 190}, [&](auto frame) { vehicle.on_frame(view_of(frame), now_ns, radio); });
//   pilot.change_mode(px4, 0x0304'0000, mode_form::do_set_mode_armed);   // as MAVSDK holds a vehicle that flies
//
// receive() has to get each frame that the vehicle sends on the person's line, and keeps those that concern a person;
// answer() reads them, outside of the vehicle's turn, and gives the items that are asked for. Bound of what is kept:
// what a vehicle says in one turn. Thread: one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-sim/vehicle/personality.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"

namespace godwit::drill {

// In which form a station sends a mode, and with which base mode. QGroundControl copies that of the heartbeat into
// SET_MODE: 157 (armed, in an automatic mode) or 209 (armed, by hand), 29 of a vehicle that stands disarmed. MAVSDK
// sends DO_SET_MODE with 129 while the vehicle is armed, and 1 while it is not. Seen: recordings of QGroundControl;
// MAVSDK 3.17.2.
enum class mode_form {
  set_mode,
  set_mode_disarmed,
  set_mode_armed,
  set_mode_armed_by_hand,
  do_set_mode,
  do_set_mode_armed,
  do_set_mode_armed_by_hand
};

constexpr auto enum_names(mode_form) {
  return io::names<mode_form>({{mode_form::set_mode, "SET_MODE 1"},
                               {mode_form::set_mode_disarmed, "SET_MODE 29"},
                               {mode_form::set_mode_armed, "SET_MODE 157"},
                               {mode_form::set_mode_armed_by_hand, "SET_MODE 209"},
                               {mode_form::do_set_mode, "DO_SET_MODE 1"},
                               {mode_form::do_set_mode_armed, "DO_SET_MODE 129"},
                               {mode_form::do_set_mode_armed_by_hand, "DO_SET_MODE 209"}});
}

inline constexpr std::array all_mode_forms{mode_form::set_mode,
                                           mode_form::set_mode_disarmed,
                                           mode_form::set_mode_armed,
                                           mode_form::set_mode_armed_by_hand,
                                           mode_form::do_set_mode,
                                           mode_form::do_set_mode_armed,
                                           mode_form::do_set_mode_armed_by_hand};

class simulated_person {
public:
  using frame_sink = std::function<void(std::span<const std::byte>)>;
  using plan = std::vector<io::mavlink::mission_item_int>;

  simulated_person(io::mavlink::sender self, frame_sink send) : self_(self), send_(std::move(send)) {}

  [[nodiscard]] io::mavlink::sender self() const { return self_; }
  // One whole frame.
  void receive(std::span<const std::byte> bytes);
  // True: something had come.
  bool answer();

  // -- what they do; to the autopilot 1/1
  void send_heartbeat(); // of a ground station
  void change_mode(sim::personality who, std::uint32_t custom_mode, mode_form how);
  void arm();
  void disarm(bool is_forced = false);
  // ITEMS as the vehicle keeps them: an ArduPilot's item 0 is its home.
  void upload(plan items);
  // By MISSION_SET_CURRENT, or by the command DO_SET_MISSION_CURRENT, which PX4 does not know.
  void choose_item(std::uint16_t sequence, bool by_message);
  void set_home(const sim::position& where);
  void command(io::mavlink::mav_cmd what, float param1 = 0, float param2 = 0, float param3 = 0, float param7 = 0);
  template <class M>
  void send(const M& what) {
    send_(io::mavlink::encode(what, self_, sequence_++).span());
  }

  // -- what the vehicle answered
  // MAV_RESULT of the newest answer to WHAT since it was sent; none: none came on this line.
  [[nodiscard]] std::optional<std::uint8_t> result_of(io::mavlink::mav_cmd what) const;
  // MAV_MISSION_RESULT of the upload; none: it goes on.
  [[nodiscard]] std::optional<std::uint8_t> plan_answer() const { return plan_answer_; }
  // True once after each upload that the vehicle has accepted.
  [[nodiscard]] bool take_brought_plan() { return std::exchange(has_brought_plan_, false); }

private:
  void hear(const io::mavlink::frame_view& frame);
  void give(std::uint16_t sequence);

  io::mavlink::sender self_;
  frame_sink send_;
  std::vector<std::vector<std::byte>> inbox_;
  std::uint8_t sequence_ = 0;
  plan upload_;
  std::optional<std::uint8_t> plan_answer_;
  bool has_brought_plan_ = false;
  std::map<std::uint16_t, std::uint8_t> results_; // by command
};

} // namespace godwit::drill
