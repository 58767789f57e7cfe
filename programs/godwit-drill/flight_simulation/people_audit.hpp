// What godwit owes to people beside the vehicle, held against what goes over the lines of a flight:
//
//   taken      once a person has changed the mode or disarmed, and a heartbeat could show it, no order of godwit that
//              moves the vehicle goes out until an operator lets godwit go on
//   foreign    no order that flies the plan goes out while the vehicle holds one that somebody else has brought
//   disarm     who has armed it by hand is not disarmed, until an operator lets godwit go on
//   again      an ARM or a start that the vehicle has accepted is never sent again, but on a person's word
//   answer     what a station is acknowledged as ACCEPTED the vehicle does
//   swallowed  a station's hold, return, landing or mode of a pilot is done in flight, also without an answer:
//              by godwit, or by the vehicle, to which it is passed on
//
// An act counts while the vehicle is as the person left it: what overrides it in the time in which nobody could have
// known of it is a race, and ends it. The mode that godwit's own order asks for before that is shown counts only from
// the vehicle's acknowledgement to the person on, where that comes to godwit: what the vehicle shows is what godwit has
// asked for, and nothing else tells the two apart. Bounds: findings (max_findings); answers that are judged later
// (max_waiting; the oldest is judged at once). Thread: one. Source: MAVLink command protocol; flights with real
// autopilots.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/mavlink/frame.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::drill {

inline constexpr io::mavlink::sender godwit_id{1, 191};

// The mode that a command or SET_MODE asks for, as HEARTBEAT.custom_mode.
[[nodiscard]] std::optional<std::uint32_t> custom_mode_in(const io::mavlink::frame_view& frame, sim::personality who);

// An order of godwit that moves the vehicle, or makes it move when it is armed.
enum class moving_order { none, arm, mission_mode, guided_mode, start, take_off, reposition, choose_item };
[[nodiscard]] moving_order moving_order_in(const io::mavlink::frame_view& frame, sim::personality who);

class people_audit {
public:
  static constexpr std::size_t max_findings = 20;
  static constexpr std::size_t max_waiting = 32;
  // A heartbeat each second, and the time that it is under way.
  static constexpr std::int64_t shown_within_ns = 1'300'000'000;
  // From the arrival of what shows it to the last order that was decided before.
  static constexpr std::int64_t heeded_within_ns = 300'000'000;
  // A plan that was proved so long ago may be flown.
  static constexpr std::int64_t proof_lasts_ns = 2'500'000'000;
  // Copies of an order go out until its acknowledgement comes.
  static constexpr std::int64_t copies_within_ns = 700'000'000;
  // What was accepted is done.
  static constexpr std::int64_t done_within_ns = 2'000'000'000;

  using picture = std::function<sim::vehicle_picture()>;

  // NOW_SEEN: of the vehicle. Times are those of the flight.
  people_audit(sim::personality who, picture now_seen) : who_(who), now_seen_(std::move(now_seen)) {}

  // -- what happens
  // Godwit has sent it towards the vehicle. RELAYED frames have another sender and are a station's.
  void on_sent(const io::mavlink::frame_view& frame, std::int64_t now_ns);
  // The vehicle has sent it on godwit's line.
  void on_answered(const io::mavlink::frame_view& frame, std::int64_t now_ns);
  // It has come to godwit.
  void on_delivered(const io::mavlink::frame_view& frame, std::int64_t now_ns);
  // A frame has come to the vehicle, and made AFTER of BEFORE.
  void on_handled(const io::mavlink::frame_view& frame, bool is_persons, const sim::vehicle_picture& before,
                  const sim::vehicle_picture& after, std::int64_t now_ns);
  // The vehicle has taken a plan of somebody else; godwit's own is seen in on_answered().
  void on_foreign_plan(std::int64_t now_ns) { foreign_since_ns_ = now_ns; }
  // An operator lets godwit go on, or starts it.
  void on_release();
  // He wants something else of it: what was accepted before is another order, also where a copy of that is answered
  // later. Who has taken the vehicle keeps it.
  void on_word() {
    accepted_ns_.clear();
    sent_ns_.clear();
  }
  // At godwit's port.
  void on_station_sent(const io::mavlink::frame_view& frame, std::int64_t now_ns);
  void on_station_heard(const io::mavlink::frame_view& frame, std::int64_t now_ns);
  void on_time(std::int64_t now_ns);

  [[nodiscard]] const std::vector<std::string>& findings() const { return findings_; }

private:
  struct held_act {
    std::int64_t at_ns = 0;
    std::optional<std::int64_t> shown_ns; // its evidence has come to godwit
    std::string mode;                     // as the person left it
    bool is_disarm = false;
    bool is_as_godwits = false;              // godwit's own order asked for the same, before anything showed it
    std::optional<std::int64_t> answered_ns; // the vehicle's acknowledgement to the person has come to godwit
    std::string words;
  };
  // Of a station; judged when its time is over.
  struct wanted_state {
    std::int64_t since_ns = 0;
    std::int64_t judged_ns = 0;
    std::uint16_t command = 0;
    std::optional<std::uint32_t> mode;
    std::optional<bool> is_armed;
    bool is_answered = false;
    bool needs_answer = true; // SET_MODE has none
    bool is_done = false;
    std::string words;
  };

  [[nodiscard]] bool is_in_force() const;
  [[nodiscard]] bool is_known(const held_act& act, std::int64_t now_ns) const;
  void on_acknowledged(const io::mavlink::command_ack& m, std::int64_t now_ns);
  void judge_order(moving_order order, const io::mavlink::frame_view& frame, std::int64_t now_ns);
  void judge_again(const io::mavlink::frame_view& frame, std::int64_t now_ns);
  void observe_wanted();
  void judge_wanted(const wanted_state& each);
  void find(const std::string& finding, std::int64_t now_ns);

  sim::personality who_;
  picture now_seen_;
  std::optional<held_act> act_;
  std::optional<std::int64_t> armed_ns_; // by a person, and it is since
  std::optional<std::int64_t> foreign_since_ns_;
  std::map<std::uint16_t, std::int64_t> accepted_ns_; // ARM and starts of godwit, since the last word of a person
  std::map<std::uint16_t, std::int64_t> sent_ns_;     // and when such a one was sent last
  std::deque<wanted_state> wanted_;
  std::vector<std::string> findings_;
};

} // namespace godwit::drill
