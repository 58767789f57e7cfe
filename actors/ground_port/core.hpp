// Every decision of ground_port: the vehicle's role towards ground stations, played by godwit.
//
//   bytes ──> channel ──frames of stations──> station_table (who is there, is the operator)
//                          ├────> mission_server (plans up and down)
//                          ├────> commands: start_dedup, command_dedup, start item, messages and their rates
//                          ├────> parameters, TIMESYNC, PING
//                          └────> the vehicle (core_passing.cpp)
//   what the vehicle says ──> forward_gate ──> stations
//   what the executor says ──> MISSION_CURRENT, MISSION_ITEM_REACHED, STATUSTEXT
//
// A change that a station must be able to rely on (a plan, a start, a start item) becomes a durable event first; what
// the station is told waits for on_durable. Until then it is neither acknowledged, nor shown, nor given out. Of a
// station's messages those go on to the vehicle that are on a list (passing/table.hpp), and what a person means only
// when the executor has said so: from then on the vehicle is that person's. Each function takes the time of its event
// and returns what is to be done, in order. Call on_time no later than next_deadline_ns. Pure: no socket, no clock, no
// actor. Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/ground_port/command_dedup.hpp"
#include "actors/ground_port/command_reading.hpp"
#include "actors/ground_port/effects.hpp"
#include "actors/ground_port/forward_gate.hpp"
#include "actors/ground_port/mission_server/server.hpp"
#include "actors/ground_port/passing/act_queue.hpp"
#include "actors/ground_port/passing/forwarded_commands.hpp"
#include "actors/ground_port/passing/stick_watch.hpp"
#include "actors/ground_port/passing/table.hpp"
#include "actors/ground_port/plan_views.hpp"
#include "actors/ground_port/settings.hpp"
#include "actors/ground_port/state.hpp"
#include "actors/ground_port/station_table.hpp"
#include "actors/ground_port/text_queue.hpp"
#include "actors/ground_port/vehicle_role/current_report.hpp"
#include "actors/ground_port/vehicle_role/order.hpp"
#include "actors/ground_port/vehicle_role/param_table.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "messages/ground_port/mission.hpp"
#include "messages/ground_port/types.hpp"
#include "messages/operator/types.hpp"
#include "messages/operator_bridge/control.hpp"
#include "runtime/condition.hpp"

namespace godwit::ground_port {

using mavlink::instant;
using mavlink::signing_settings;

// Plans and start items that wait for the disk. At the bound stations are not heard about plans, and repeat themselves.
inline constexpr std::size_t max_waiting_for_disk = 16;
// The executor has said by then what became of a plan; a station waits for about as long.
inline constexpr std::int64_t judged_within_ns = 1'000'000'000;
// The same of a plan that goes to a vehicle in flight: longer than the executor tries it.
inline constexpr std::int64_t brought_within_ns = 30'000'000'000;
// The same of a clear, which goes to the vehicle and comes back from it, more than once where frames are lost.
inline constexpr std::int64_t cleared_within_ns = 5'000'000'000;
// What is to be told when they are on the disk.
inline constexpr std::size_t max_held_messages = 64;
// An answer that a crash has delayed for longer is not sent: the station has given up by then, and could take it for
// the answer to something else.
inline constexpr std::int64_t answer_is_worth_ns = 2'000'000'000;
// A port that passes no commands on says so to each station at most this often.
inline constexpr std::int64_t command_notice_period_ns = 60'000'000'000;
// So often a station is told that something is not passed on.
inline constexpr std::int64_t passing_notice_period_ns = 5'000'000'000;
// What stations only read and steer cameras with, beside what people do: parameters, logs and files, all asked for in
// small frames. A vehicle's own line is narrower than the second; it bounds a component that has gone wild.
inline constexpr passing::budget::rate to_vehicle_most{500, 100'000};
inline constexpr passing::budget::rate to_stations_most{5'000, 1'000'000};
inline constexpr std::uint32_t file_transfer_id = 110; // FILE_TRANSFER_PROTOCOL
// The autopilot counts as present on this port so long after its last frame.
inline constexpr std::int64_t autopilot_is_here_ns = 10'000'000'000;
// From an autopilot's silence on this port until godwit stands in for it again.
inline constexpr std::int64_t stands_in_again_after_ns = 60'000'000'000;
// Holds that godwit brings about for stations: one for each of them, by a command and by SET_MODE.
inline constexpr std::size_t max_begun_acts = 32;
inline constexpr std::int64_t alert_lasts_ns = 10'000'000'000;

class core {
public:
  core(settings configured, const signing_settings& signing, const state& restored, bool has_executor, instant now);

  [[nodiscard]] effects on_link(const io::link::link_status& status, instant now);
  [[nodiscard]] effects on_bytes(io::link::peer_id peer, bool is_datagram, mavlink::byte_view bytes, instant now);
  [[nodiscard]] effects on_time(instant now);

  [[nodiscard]] effects on_telemetry(const telemetry& m, instant now);
  // What the vehicle's components say besides, as it came.
  [[nodiscard]] effects on_relayed(const vehicle_link::relayed_frame& m, instant now);

  [[nodiscard]] effects on_progress(const mission_progress& m, instant now);
  [[nodiscard]] effects on_item_reached(const item_reached& m, instant now);
  [[nodiscard]] effects on_status_text(const status_text& m, instant now);
  [[nodiscard]] effects on_plan_judged(const plan_judged& m, instant now);
  [[nodiscard]] effects on_set_mission(const set_mission& m, instant now);
  [[nodiscard]] effects on_start_answer(const executor::start_answer& m, instant now);
  [[nodiscard]] effects on_current_answer(std::uint64_t request, const executor::current_answer& m, instant now);
  // The executor did not answer. REASON is a sentence for people.
  [[nodiscard]] effects on_current_failed(std::uint64_t request, const std::string& reason, instant now);
  [[nodiscard]] effects on_word_answer(std::uint64_t request, const operators::answer& m, instant now);
  [[nodiscard]] effects on_word_failed(std::uint64_t request, const std::string& reason, instant now);

  [[nodiscard]] effects on_act_answer(std::uint64_t request, const executor::act_answer& m, instant now);
  [[nodiscard]] effects on_act_resolved(const executor::act_resolved& m, instant now);
  [[nodiscard]] effects on_act_failed(std::uint64_t request, const std::string& reason, instant now);

  [[nodiscard]] effects on_control(const operator_bridge::control_news& m, instant now);
  [[nodiscard]] bool knows_control() const { return rules_.knows_control(); }

  // On the disk now, in this life or an earlier one.
  [[nodiscard]] effects on_durable(const plan_resolved& m, instant now);
  [[nodiscard]] effects on_durable(const start_resolved& m, instant now);
  [[nodiscard]] effects on_durable(const start_item_resolved& m, instant now);
  void on_reserved(mavlink::signing_time ceiling) { channel_.reserved(ceiling); }
  [[nodiscard]] std::optional<mavlink::signing_time> wanted_reservation(instant now) {
    return channel_.wanted_reservation(now.wall_ns);
  }

  [[nodiscard]] std::int64_t next_deadline_ns() const;
  [[nodiscard]] port_description describe(instant now) const;
  [[nodiscard]] runtime::condition health(instant now);

private:
  class decision_context; // what one event leads to, while it is handled

  // As whom we speak, and as whom the vehicle's messages go on.
  [[nodiscard]] mavlink::sender ourselves() const;
  [[nodiscard]] mavlink::sender autopilot() const;
  [[nodiscard]] bool is_standing_in() const;
  [[nodiscard]] bool is_autopilot_here(std::int64_t now_ns) const;
  [[nodiscard]] bool is_for_us(std::uint8_t target_system, std::uint8_t target_component) const;

  void take_frame(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame);
  void take_own_system(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame);
  void stand_down(decision_context& t, bool is_down);
  void take(decision_context& t, station& from, const mavlink::heartbeat& m);
  void take(decision_context& t, station& from, const mavlink::mission_set_current& m);
  void take(decision_context& t, station& from, const mavlink::command_long& m);
  void take(decision_context& t, station& from, const mavlink::command_int& m);
  void take(decision_context& t, station& from, const mavlink::param_request_list& m);
  void take(decision_context& t, station& from, const mavlink::param_request_read& m);
  void take(decision_context& t, station& from, const mavlink::param_set& m);
  void take(decision_context& t, station& from, const mavlink::timesync& m);
  void take(decision_context& t, station& from, const mavlink::ping& m);

  // core_commands.cpp
  template <class M>
  void take_command(decision_context& t, station& from, const M& m);
  void obey(decision_context& t, const vehicle_role::order& what, bool is_for_all_systems);
  void answer(decision_context& t, const vehicle_role::order& what, mavlink::mav_result result);
  [[nodiscard]] mavlink::sender asked_one(std::uint8_t component) const;
  void refuse(decision_context& t, const vehicle_role::order& what, mavlink::mav_result result,
              const std::string& text);
  void start(decision_context& t, const vehicle_role::order& what);
  void give_message(decision_context& t, const vehicle_role::order& what, std::optional<std::uint32_t> id);
  [[nodiscard]] bool send_message(decision_context& t, io::link::peer_id to, std::uint32_t id);
  [[nodiscard]] bool set_interval(std::uint32_t id, float interval_us, std::int64_t now_ns);
  void note_foreign_command(decision_context& t, station& from);

  // core_passing.cpp
  [[nodiscard]] bool is_passing(std::int64_t now_ns) const;
  [[nodiscard]] bool is_allowed(std::string_view name) const;
  [[nodiscard]] bool route(decision_context& t, station& from,
                           const mavlink::frame_view& frame); // true: it is dealt with
  void route_listed(decision_context& t, station& from, const passing::message_row& row,
                    const mavlink::frame_view& frame);
  [[nodiscard]] bool are_sticks_at_rest(const station& from, const passing::message_row& row,
                                        const mavlink::frame_view& frame, std::int64_t now_ns);
  void route_command(decision_context& t, station& from, const vehicle_role::order& what,
                     const mavlink::frame_view& frame, bool is_for_all);
  void route_file(decision_context& t, station& from, const mavlink::frame_view& frame);
  void route_owned(decision_context& t, station& from, const vehicle_role::order& what,
                   const mavlink::frame_view& frame, bool is_for_all);
  [[nodiscard]] vehicle_role::order order_of_mode(mavlink::sender who) const;
  void route_mode(decision_context& t, const vehicle_role::order& what, std::uint32_t custom_mode,
                  std::uint32_t base_mode, const mavlink::frame_view& frame);
  void start_or_resume(decision_context& t, vehicle_role::order what, const std::string& name);
  void ask_to_go_on(decision_context& t, const vehicle_role::order& what, const std::string& name);
  [[nodiscard]] bool answers_itself(const vehicle_role::order& what) const;
  [[nodiscard]] bool is_known(std::uint32_t id) const;
  [[nodiscard]] static vehicle_link::relayed_frame needed_rate(mavlink::request_data_stream m, mavlink::sender who);
  [[nodiscard]] static executor::station by(mavlink::sender who);
  void pass(decision_context& t, vehicle_link::relayed_frame what);
  void pass_reading(decision_context& t, vehicle_link::relayed_frame what); // within the budget
  void ask(decision_context& t, passing::waiting_act what);
  void act_on_answer(decision_context& t, passing::waiting_act asked, const executor::act_answer& m);
  void begin_act(decision_context& t, passing::waiting_act asked);
  void forward(decision_context& t, passing::waiting_act what);
  void on_acknowledgement(decision_context& t, const vehicle_link::relayed_frame& m);
  void pass_unanswered(decision_context& t, const passing::waiting_act& what, const std::string& reason);
  void refuse_act(decision_context& t, const passing::waiting_act& what, const std::string& reason);
  void refuse_passing(decision_context& t, station& from, const std::string& why);
  void refuse_file(decision_context& t, const vehicle_link::relayed_frame& asked);
  void read_back(decision_context& t, const vehicle_link::relayed_frame& asked);
  [[nodiscard]] io::link::peer_id way_of(const vehicle_link::relayed_frame& m) const;

  // core_current.cpp
  [[nodiscard]] bool route_item(decision_context& t, const mavlink::frame_view& frame);
  void answer_item(decision_context& t, const vehicle_role::order& what, mavlink::mav_result result);
  void note_forwarded_item(mavlink::sender by, std::int64_t now_ns);
  [[nodiscard]] bool is_answer_to_item(const vehicle_link::relayed_frame& m, std::int64_t now_ns);

  // core_operators.cpp
  [[nodiscard]] std::optional<double> home_altitude_m() const; // above mean sea level
  [[nodiscard]] std::optional<mission::position> here() const; // where the vehicle is; the altitude above home
  [[nodiscard]] told_by_vehicle told_to(mavlink::sender who, std::int64_t now_ns) const;
  void say_word(decision_context& t, const vehicle_role::order& what);
  void say_word_of(decision_context& t, const vehicle_role::order& what, operators::command_kind which);
  void begin_word(decision_context& t, const vehicle_role::order& what, const operators::command& command);
  void end_word(decision_context& t, std::uint64_t request, mavlink::mav_result result, const std::string& reason);
  void tell_audit(decision_context& t, mavlink::sender who, std::string what, std::string outcome, std::string reason);
  void audit_act(decision_context& t, const passing::waiting_act& what, const std::string& outcome, std::string reason);
  [[nodiscard]] std::optional<station_rules::objection> object_to(decision_context& t, mavlink::sender who,
                                                                  const std::string& what);
  // True: it has its answer.
  [[nodiscard]] bool is_refused(decision_context& t, const vehicle_role::order& what, const std::string& name);
  struct plan_request { // an upload, of a part too, or a clear
    std::uint8_t target_system = 0;
    std::uint8_t target_component = 0;
    std::uint8_t mission_type = 0;
    bool clears = false;
    bool is_part = false;
  };
  [[nodiscard]] bool is_refused(decision_context& t, const station& from, const plan_request& what);
  [[nodiscard]] std::string why_no_part(mavlink::sender who, std::uint8_t mission_type) const;
  // A download changes nothing.
  template <class M>
  [[nodiscard]] bool is_refused(decision_context& t, const station& from, const M& m) {
    constexpr bool clears = M::message_id == mavlink::mission_clear_all::message_id;
    constexpr bool is_part = M::message_id == mavlink::mission_write_partial_list::message_id;
    if constexpr (clears || is_part || M::message_id == mavlink::mission_count::message_id)
      return is_refused(t, from, plan_request{m.target_system, m.target_component, m.mission_type, clears, is_part});
    else
      return false;
  }

  // core_mission.cpp
  struct held;            // waits for the disk
  struct awaited_verdict; // of the executor
  struct set_current_request {
    std::optional<vehicle_role::order> by_command; // none: by MISSION_SET_CURRENT
    mavlink::sender from;
    std::uint16_t index = 0;
  };
  void go_on(decision_context& t, mission_server::reaction next);
  void note_change(decision_context& t, const mission_server::plan_change& change,
                   std::optional<mavlink::mission_ack> ack);
  void tell(decision_context& t, const mission_server::reaction& what);
  void note_download(const mission_server::reaction& what);
  void tell_judged(decision_context& t);
  [[nodiscard]] held held_for(mission_server::reaction&& next) const;
  [[nodiscard]] bool repeats_clear(const mission_server::reaction& next) const;
  void tell_verdict(decision_context& t, held& what);
  void take_back(decision_context& t, const awaited_verdict& refused);
  void answer_late(decision_context& t, const plan_resolved& m);
  void choose_current(decision_context& t, const set_current_request& set_current);
  void refuse_current(decision_context& t, const set_current_request& set_current, mavlink::mav_result result,
                      const std::string& text);
  void end_set_current(decision_context& t, mavlink::mav_result result, const std::string& text);
  // Where shown_ and resolved_ have what belongs to TYPE.
  [[nodiscard]] static std::size_t place_of(mavlink::mav_mission_type type) {
    return static_cast<std::size_t>(mavlink::number(type));
  }
  [[nodiscard]] bool is_running() const;
  [[nodiscard]] bool is_in_flight() const; // as the executor tells it
  [[nodiscard]] mavlink::mission_current current() const;
  void show_plans();
  void note_on_disk();
  void make_server();
  [[nodiscard]] bool is_of_this_life(std::uint64_t ticket) const {
    return ticket >= first_ticket_ && ticket < next_ticket_;
  }
  [[nodiscard]] bool is_busy_with_disk() const { return waiting_for_disk_ >= max_waiting_for_disk; }

  void beat(decision_context& t);
  void finish(decision_context& t);

  settings settings_;
  bool has_executor_;
  mavlink::channel channel_;
  std::optional<mission_server::server> server_;
  station_table stations_;
  station_rules rules_;
  forward_gate gate_;
  text_queue texts_;
  start_dedup starts_;
  plan_views views_;
  command_dedup words_;
  passing::act_queue acts_;
  std::vector<passing::waiting_act> begun_acts_; // that godwit does, and the station is answered for later
  passing::forwarded_commands forwarded_;
  passing::forwarded_commands forwarded_items_; // that an ArduPilot flies to at once
  passing::act_series audited_acts_;
  passing::stick_watch sticks_;
  bool is_hold_asked_ = false; // through a station, and not shown by the progress yet
  struct held_from {           // where the vehicle was when a station asked for a hold
    mavlink::sender by;
    double altitude_m = 0; // above home
    std::int64_t at_ns = 0;
  };
  std::optional<held_from> held_from_;
  passing::budget to_vehicle_{to_vehicle_most};
  passing::budget to_stations_{to_stations_most};
  vehicle_role::current_report report_;
  vehicle_role::param_table params_;

  // What is on the disk, and so may be shown.
  struct shown {
    std::uint32_t id = 0;
    std::size_t items = 0;
  };
  std::array<shown, mission_server::plan_types> shown_;
  std::array<std::vector<mavlink::mission_item_int>, mission_server::plan_types> resolved_; // what a refusal leaves
  struct awaited_verdict { // of the executor, about one plan
    mavlink::mav_mission_type type = mavlink::mav_mission_type::mission;
    std::uint32_t plan_id = 0; // 0: of a clear
    std::optional<plan_verdict> verdict = {};
    bool is_brought = false; // to a vehicle in flight, and the verdict follows
  };
  struct held {
    std::uint64_t ticket = 0;
    mission_server::reaction reaction;
    std::vector<awaited_verdict> verdicts = {}; // the station hears the worst of them
    std::vector<mission_server::status_text> texts_if_taken = {};
    bool is_clear = false;
    std::optional<std::int64_t> on_disk_ns = {};
    [[nodiscard]] bool is_judged() const;
    [[nodiscard]] std::optional<plan_verdict> worst() const; // none: one of them is missing
    [[nodiscard]] std::int64_t judged_by_ns() const;         // of what is on the disk
  };
  std::deque<held> held_;
  std::optional<plan_judged> unawaited_verdict_; // the last one: the answer that it is for may be owed by a crash
  std::uint64_t first_ticket_;
  std::uint64_t next_ticket_;
  std::size_t waiting_for_disk_ = 0;

  std::optional<mission_progress> progress_;
  std::optional<item_reached> told_reached_;       // the last one
  std::optional<std::uint16_t> start_item_;        // as shown
  std::optional<std::uint16_t> noted_start_item_;  // as it will be when nothing waits for the disk any more
  std::optional<set_current_request> set_current_; // the executor was asked
  std::uint64_t set_current_id_ = 0;

  bool link_is_up_ = false;
  std::string link_reason_ = "not opened";
  bool is_armed_ = false;
  flight::mode_owner owner_; // as long as the vehicle was not heard: of no kind
  flight::flight_mode mode_;
  bool is_mode_known_ = true; // what has gone on to the vehicle may have changed it since it was heard
  bool stood_down_ = false;   // from standing in: the autopilot itself was heard
  std::optional<std::int64_t> autopilot_heard_ns_; // once it is believed
  io::link::peer_id autopilot_peer_ = io::link::every_peer;
  domain::confirmation_table autopilot_beats_;
  std::int64_t next_beat_ns_;
  std::uint64_t alerted_rejections_ = 0;
  std::optional<std::int64_t> last_alert_ns_;

  struct counters {
    std::uint64_t not_accepted = 0;    // good frames that are not on the list of what we take
    std::uint64_t not_for_us = 0;      // for another component or system
    std::uint64_t from_own_system = 0; // of the vehicle's other components: no stations
    std::uint64_t commands_for_autopilot = 0;
    std::uint64_t commands_unsupported = 0;
    std::uint64_t commands_refused = 0;
    std::uint64_t forwarded = 0;
    std::uint64_t passed_to_vehicle = 0;
    std::uint64_t passed_to_stations = 0;
    std::uint64_t not_passed_to_stations = 0; // over the budget, or this port does not pass on
    std::uint64_t passing_refused = 0;
    std::uint64_t acts_unanswered = 0;  // of the executor
    std::uint64_t not_sent = 0;         // while the link was down
    std::uint64_t waiting_for_disk = 0; // messages of stations that were not taken at the bound
    std::uint64_t held_dropped = 0;
    std::uint64_t plans_refused = 0; // by the executor
  };
  counters counts_;
};

} // namespace godwit::ground_port
