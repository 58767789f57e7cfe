// Every decision of vehicle_link: what to send, whom to answer, what to tell, when to look again.
//
//   bytes ──> channel ──frames──> vehicle_watch (which vehicle, is it alive, did it restart)
//                          ├────> pending_commands, current_setter, look_keeper (answers to whoever asked)
//                          ├────> foreign_watch (does somebody else act on it?)
//                          ├────> transfer::client (plan up and down)
//                          ├────> stream_keeper (does what we need come?)
//                          └────> observations for listeners, answers to TIMESYNC and PING
//
// All state is volatile but the reserved signing time and the vehicle of a flight that is open: after a crash the
// vehicle is asked again, and who waited for an answer has been told that the outcome is not known. Each function takes
// the time of its event and returns what is to be done, in order. Call on_time no later than next_deadline_ns. Pure: no
// socket, no clock, no actor. Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "actors/vehicle_link/current_setter.hpp"
#include "actors/vehicle_link/effects.hpp"
#include "actors/vehicle_link/first_call.hpp"
#include "actors/vehicle_link/foreign_watch.hpp"
#include "actors/vehicle_link/heard_watch.hpp"
#include "actors/vehicle_link/heartbeat_gate.hpp"
#include "actors/vehicle_link/identity_watch.hpp"
#include "actors/vehicle_link/look_keeper.hpp"
#include "actors/vehicle_link/loss_watch.hpp"
#include "actors/vehicle_link/order_check.hpp"
#include "actors/vehicle_link/pending_commands.hpp"
#include "actors/vehicle_link/settings.hpp"
#include "actors/vehicle_link/state.hpp"
#include "actors/vehicle_link/stream_keeper.hpp"
#include "actors/vehicle_link/transfer/client.hpp"
#include "actors/vehicle_link/vehicle_watch.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "runtime/condition.hpp"
#include "runtime/supervision/messages.hpp"

namespace godwit::vehicle_link {

using mavlink::signing_settings;

// A peer is said to speak MAVLink 1 only when it was heard for so long and never spoke MAVLink 2.
inline constexpr std::int64_t v1_only_after_ms = 3'000;
// A rejected signature impairs health for so long.
inline constexpr std::int64_t alert_lasts_ms = 10'000;
inline constexpr std::int64_t alert_period_ms = 1'000;
// ArduPilot signs a minute ahead of true time, and two after two starts in a row. More is told to people.
inline constexpr std::int64_t usual_signing_lead_s = 90;

// What only a transfer is about.
template <class M>
concept transfer_messages = requires(transfer::client& to, const M& message) {
  to.on(message, std::int64_t{});
}
&&!told_messages::contains(M::message_id);

class core {
public:
  // KEPT: the vehicle of a flight that is open.
  core(settings configured, const signing_settings& signing, mavlink::signing_time ceiling,
       const std::optional<vehicle_name>& kept = {});

  [[nodiscard]] effects on_link(const io::link::link_status& status, instant now);
  [[nodiscard]] effects on_bytes(io::link::peer_id peer, bool is_datagram, mavlink::byte_view bytes, instant now);
  [[nodiscard]] effects on_time(instant now);

  [[nodiscard]] effects on_command(std::uint64_t request_id, const send_command& what, instant now);
  [[nodiscard]] effects on_set_mode(const set_mode& what, instant now);
  [[nodiscard]] effects on_set_current(std::uint64_t request_id, const set_current_item& what, instant now);
  [[nodiscard]] std::pair<effects, signing_answer> on_set_up_signing(const set_up_signing& what, instant now);
  [[nodiscard]] effects on_upload(std::uint64_t request_id, const upload_plan& what, instant now);
  [[nodiscard]] effects on_download(std::uint64_t request_id, const download_plan& what, instant now);
  [[nodiscard]] effects on_clear(std::uint64_t request_id, const clear_plan& what, instant now);
  [[nodiscard]] effects on_cancel_transfer(instant now);
  [[nodiscard]] effects on_look(std::uint64_t request_id, instant now);
  [[nodiscard]] effects on_watch_closely(const watch_closely& what, instant now);
  // Of a ground station, to the vehicle; whoever tells it has let it pass.
  [[nodiscard]] effects on_relayed(const relayed_frame& what, instant now);
  void on_child_alive(const runtime::child_alive& what, instant now);
  // Whom the journal has to keep from now on; none: as before.
  [[nodiscard]] std::pair<effects, std::optional<vehicle_kept>> on_keep_vehicle(const keep_vehicle& what, instant now);

  [[nodiscard]] std::optional<mavlink::signing_time> wanted_reservation(instant now) {
    return channel_.wanted_reservation(now.wall_ns);
  }
  void on_reserved(mavlink::signing_time ceiling) { channel_.reserved(ceiling); }

  [[nodiscard]] std::int64_t next_deadline_ns() const;
  [[nodiscard]] connection describe(instant now) const;
  [[nodiscard]] runtime::condition health(instant now);

private:
  class decision_context; // what one event leads to, while it is handled

  [[nodiscard]] mavlink::sender ourselves() const;
  [[nodiscard]] bool is_for_us(std::uint8_t target_system, std::uint8_t target_component) const;

  // Where the vehicle is; everywhere, when that is not known.
  [[nodiscard]] io::link::peer_id way_out() const;
  [[nodiscard]] bool is_late_mode(const mavlink::frame_view& frame, instant now);
  void take_frame(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame);
  void take(decision_context& t, const mavlink::heartbeat& m);
  void take(decision_context& t, const mavlink::current_mode& m);
  void take(decision_context& t, const mavlink::command_ack& m);
  void take(decision_context& t, const mavlink::mission_current& m);
  void take(decision_context& t, const mavlink::gimbal_device_attitude_status& m);
  void take(decision_context& t, const mavlink::camera_feedback& m);
  void take(decision_context& t, const mavlink::camera_image_captured& m);
  void take(decision_context& t, const mavlink::timesync& m);
  void take(decision_context& t, const mavlink::ping& m);
  template <mavlink::message M>
  requires transfer_messages<M>
  void take(decision_context& t, const M& message);
  template <mavlink::message M>
  void take(decision_context& t, const M& message);
  [[nodiscard]] bool relay(decision_context& t, const mavlink::frame_view& frame);
  void note_boot_time(decision_context& t, std::uint32_t boot_ms);
  void note_restart(decision_context& t, const std::optional<vehicle_restarted>& restarted);
  // Under the vehicle's name, and no autopilot's.
  [[nodiscard]] bool is_other_program(const mavlink::frame_view& frame) const;
  void note_twin(std::int64_t now_ns);

  void change_phase(decision_context& t, std::optional<connection_changed> change);
  void announce_heard(decision_context& t);
  [[nodiscard]] unusable_frames unusable() const;
  [[nodiscard]] std::string why_no_vehicle(std::int64_t now_ns) const; // with what is heard in its place
  void begin_with(decision_context& t, mavlink::sender vehicle);
  void announce_line(decision_context& t);
  [[nodiscard]] line_findings line(std::int64_t now_ns) const;
  void restart_conversation(decision_context& t);
  void give(decision_context& t, asker who, const send_command& what);
  void announce_current(decision_context& t);
  void send_out(decision_context& t, const send_command& what);
  void resolve(decision_context& t, const resolved_command& done);
  void ask_for_streams(decision_context& t);
  [[nodiscard]] std::string why_no_key() const; // is given to the vehicle now; empty: it may be
  void tell_foreign(decision_context& t, const std::optional<foreign_act>& what);
  void answer_look(decision_context& t, const std::optional<resolved_look>& done);
  void ask_for_heartbeat(decision_context& t);
  void send_copies(decision_context& t);
  void raise_alert(decision_context& t);
  [[nodiscard]] std::string refused_sentence() const;
  [[nodiscard]] io::mavlink::channel_report report_of_vehicle() const;
  [[nodiscard]] std::optional<command_outcome> refusal(const send_command& what, instant now);
  template <class Begin>
  [[nodiscard]] effects begin_transfer(std::uint64_t request_id, mavlink::mav_mission_type type,
                                       const std::optional<seen_state>& only_while, instant now, Begin begin);
  void go_on(decision_context& t, transfer::step next);
  [[nodiscard]] bool speaks_v1_only(std::int64_t now_ns) const;

  settings settings_;
  mavlink::channel channel_;
  vehicle_watch watch_;
  heard_watch heard_;
  pending_commands commands_;
  current_setter current_;
  stream_keeper streams_;
  heartbeat_gate gate_;
  first_call call_;
  loss_watch losses_;
  identity_watch identity_;
  std::string twin_;                          // as it was found first; empty: there is one vehicle under its name
  std::optional<mavlink::sender> partner_;    // whom all that follows is about: the vehicle, once it is known
  std::optional<transfer::client> transfers_; // with it
  std::uint64_t transfer_request_ = 0;        // who asked for the one under way

  bool has_camera_feedback_ = false;       // of the vehicle
  std::optional<line_findings> told_line_; // to listeners
  std::string link_reason_;
  std::uint64_t reconnects_ = 0;
  std::optional<std::int64_t> mode_number_; // of the newest frame that tells one
  std::uint64_t late_heartbeats_ = 0;
  std::uint64_t other_programs_ = 0; // heartbeats of them
  std::uint64_t under_its_name_ = 0; // frames of the vehicle's name from another peer
  order_check orders_;
  foreign_watch foreign_;
  look_keeper looks_;
  std::int64_t next_beat_ns_ = 0;
  bool heartbeat_held_back_ = false;
  std::uint64_t not_accepted_ = 0;
  std::uint64_t relayed_to_vehicle_ = 0;
  std::uint64_t relayed_to_stations_ = 0;
  std::uint64_t relays_dropped_ = 0; // no vehicle is there, or an id that is not known
  std::optional<std::int64_t> first_v1_ns_;
  std::uint64_t alerted_rejections_ = 0;
  std::optional<std::int64_t> last_alert_ns_;
};

} // namespace godwit::vehicle_link
