#include "actors/vehicle_link/core.hpp"

#include <algorithm>
#include <span>
#include <type_traits>
#include <utility>

#include "actors/vehicle_link/core_context.hpp"
#include "actors/vehicle_link/relay_gate.hpp"
#include "io/mavlink/frame_meaning.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

// 0 and 0: it does not say.
std::optional<mission::vertex> place_of(std::int32_t latitude, std::int32_t longitude) {
  using io::mavlink::units_a_degree;
  return latitude == 0 && longitude == 0
             ? std::nullopt
             : std::optional(mission::vertex{latitude / units_a_degree, longitude / units_a_degree});
}

// Before a vehicle is known: nearly every vehicle is system 1, and a heartbeat has to come from somewhere.
constexpr std::uint8_t usual_system = 1;

} // namespace

core::core(settings configured, const signing_settings& signing, mavlink::signing_time ceiling,
           const std::optional<vehicle_name>& kept)
    : settings_(std::move(configured)), channel_(signing, ceiling), watch_(settings_.watch), heard_(settings_.watch),
      streams_(settings_.streams), gate_(settings_.deciders, settings_.alive_lasts_ms) {
  (void)watch_.keep(kept); // the line is not open yet
}

mavlink::sender core::ourselves() const {
  if (settings_.as.system != 0)
    return {settings_.as.system, settings_.as.component};
  const auto waited_for = watch_.kept() ? watch_.kept()->system : usual_system;
  return {watch_.vehicle() ? watch_.vehicle()->system : waited_for, settings_.as.component};
}

bool core::is_for_us(std::uint8_t target_system, std::uint8_t target_component) const {
  const auto us = ourselves();
  return (target_system == 0 || target_system == us.system) &&
         (target_component == 0 || target_component == us.component);
}

io::link::peer_id core::way_out() const { return watch_.vehicle() ? watch_.vehicle()->peer : io::link::every_peer; }

// -- the link -------------------------------------------------------------------------------------

effects core::on_link(const io::link::link_status& status, instant now) {
  decision_context t(*this, now);
  const bool up = status.phase == io::link::link_phase::up;
  reconnects_ = status.reconnects;
  link_reason_ = status.reason;
  if (!up) {
    call_.end();
  } else if (watch_.phase() == connection_phase::down) {
    next_beat_ns_ = now.monotonic_ns; // a peer that speaks only to whom it has heard must not wait for us
    call_.begin(now.monotonic_ns);
  }
  change_phase(t, watch_.on_transport(up, status.reason));
  return std::move(t.done);
}

effects core::on_bytes(io::link::peer_id peer, bool is_datagram, mavlink::byte_view bytes, instant now) {
  decision_context t(*this, now);
  channel_.unpack(peer, is_datagram, bytes, now, [&](const auto& frame) { take_frame(t, peer, frame); });
  if (channel_.v1_frames() != 0 && !first_v1_ns_)
    first_v1_ns_ = now.monotonic_ns;
  raise_alert(t);
  announce_line(t);
  announce_heard(t);
  return std::move(t.done);
}

void core::take_frame(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame) {
  const auto from = frame.from();
  if (watch_.phase() != connection_phase::connected && from != ourselves())
    heard_.on_frame(frame, t.now.monotonic_ns);
  if (is_other_program(frame)) {
    ++other_programs_;
    identity_.on_other_program(t.now.monotonic_ns);
    return;
  }
  if (frame.id() == mavlink::heartbeat::message_id) {
    change_phase(t, watch_.on_heartbeat(mavlink::decode<mavlink::heartbeat>(frame), from.system, from.component,
                                        t.now.monotonic_ns, peer));
  }
  const bool is_vehicle = watch_.is_vehicle(from.system, from.component, peer);
  const bool is_forged = !is_vehicle && watch_.has_its_name(from.system, from.component);
  if (is_forged)
    ++under_its_name_;
  if (is_vehicle) {
    channel_.follow(frame); // it refuses what is signed long after its own time
    identity_.on_sequence(frame.sequence(), t.now.monotonic_ns);
  }
  if (is_vehicle && is_late_mode(frame, t.now)) {
    ++late_heartbeats_; // a mode from before would be taken for somebody's
    return;
  }
  if (frame.id() == mavlink::radio_status::message_id) {
    t.done.emplace_back(observation(mavlink::decode<mavlink::radio_status>(frame)));
    return;
  }
  if (watch_.vehicle() && from.system != watch_.vehicle()->system && from != ourselves())
    tell_foreign(t, foreign_.on_frame(frame, watch_.vehicle()->system, t.now.monotonic_ns));
  const bool is_relayed = !is_forged && relay(t, frame);
  const bool may_be_payload = frame.id() == mavlink::gimbal_device_attitude_status::message_id ||
                              frame.id() == mavlink::camera_image_captured::message_id ||
                              frame.id() == mavlink::adsb_vehicle::message_id;
  const bool is_payload = may_be_payload && watch_.vehicle() && from.system == watch_.vehicle()->system && !is_forged;
  const auto take_message = [&](const auto& message) { take(t, message); };
  if (!(is_vehicle || is_payload) ||
      !(told_messages::visit(frame, take_message) || used_messages::visit(frame, take_message))) {
    if (!is_relayed)
      ++not_accepted_;
    return;
  }
  streams_.on_message(frame.id());
}

// A script on the companion computer that has taken the autopilot's ids would else be its mode, and disarmed.
bool core::is_other_program(const mavlink::frame_view& frame) const {
  if (frame.id() != mavlink::heartbeat::message_id || !watch_.has_its_name(frame.from().system, frame.from().component))
    return false;
  const auto beat = mavlink::decode<mavlink::heartbeat>(frame);
  return beat.autopilot == mavlink::number(mavlink::mav_autopilot::invalid) ||
         beat.type == mavlink::number(mavlink::mav_type::gcs);
}

// The sentence stays as it is: the figures in it change with each frame.
void core::note_twin(std::int64_t now_ns) {
  auto found = partner_ ? identity_.twin(*partner_, now_ns) : std::string();
  if (found.empty() != twin_.empty())
    twin_ = std::move(found);
}

// True: it goes on to the ground stations.
bool core::relay(decision_context& t, const mavlink::frame_view& frame) {
  if (!settings_.relays || !watch_.vehicle() || frame.from().system != watch_.vehicle()->system ||
      frame.from() == ourselves() || !goes_to_stations(frame, {watch_.vehicle()->system, watch_.vehicle()->component}))
    return false;
  ++relayed_to_stations_;
  t.announce(as_said(frame));
  return true;
}

// Whoever speaks with the vehicle's own system id is no station, and gets nowhere.
effects core::on_relayed(const relayed_frame& what, instant now) {
  decision_context t(*this, now);
  const auto payload = std::as_bytes(std::span(what.payload));
  const mavlink::sender who{what.system, what.component};
  const bool is_station = watch_.vehicle() && what.system != watch_.vehicle()->system;
  auto frame = is_station && watch_.phase() != connection_phase::down
                   ? channel_.pack_as_said(what.message, payload, who, now.wall_ns)
                   : std::nullopt;
  if (frame) {
    ++relayed_to_vehicle_;
    foreign_.on_forwarded(what, now.monotonic_ns);
    t.done.emplace_back(transmission{way_out(), *frame});
  } else {
    ++relays_dropped_;
  }
  return std::move(t.done);
}

// HEARTBEAT and CURRENT_MODE have one order: of the two as well the later one says where the vehicle is.
bool core::is_late_mode(const mavlink::frame_view& frame, instant now) {
  const auto number = watch_.number_of(frame.sequence(), now.monotonic_ns);
  if (frame.id() != mavlink::heartbeat::message_id && frame.id() != mavlink::current_mode::message_id)
    return false;
  const bool is_late = mode_number_ && number <= *mode_number_;
  if (!is_late)
    mode_number_ = number;
  return is_late;
}

template <mavlink::message M>
requires transfer_messages<M>
void core::take(decision_context& t, const M& message) {
  constexpr bool tells_upload = std::is_same_v<M, mavlink::mission_ack> ||
                                std::is_same_v<M, mavlink::mission_request> ||
                                std::is_same_v<M, mavlink::mission_request_int>;
  if constexpr (tells_upload)
    if (!is_for_us(message.target_system, message.target_component) &&
        message.mission_type == mavlink::number(mavlink::mav_mission_type::mission))
      tell_foreign(t, foreign_.on_plan_answer(message.target_system, message.target_component, t.now.monotonic_ns));
  if (transfers_)
    go_on(t, transfers_->on(message, t.now.monotonic_ns));
}

void core::tell_foreign(decision_context& t, const std::optional<foreign_act>& what) {
  if (!what)
    return;
  orders_.heard_foreign(what->at_ns);
  t.announce(*what);
}

template <mavlink::message M>
void core::take(decision_context& t, const M& message) {
  if constexpr (requires { message.time_boot_ms; })
    note_boot_time(t, message.time_boot_ms);
  if constexpr (M::message_id == mavlink::global_position_int::message_id)
    identity_.on_place({message.lat / mavlink::units_a_degree, message.lon / mavlink::units_a_degree},
                       t.now.monotonic_ns);
  if constexpr (told_messages::contains(M::message_id))
    t.done.emplace_back(observation(message));
}

void core::take(decision_context& t, const mavlink::heartbeat& m) {
  note_restart(t, watch_.on_state(m)); // before its mode, which would be taken for a pilot's
  orders_.heard(m.custom_mode, io::mavlink::is_armed(m));
  t.done.emplace_back(observation(m));
  answer_look(t, looks_.on_heartbeat(t.now.monotonic_ns));
}

// Its clock may be that of the gimbal, and tells nothing of a start of the autopilot.
void core::take(decision_context& t, const mavlink::gimbal_device_attitude_status& m) {
  t.done.emplace_back(observation(m));
}

void core::take(decision_context& t, const mavlink::camera_feedback& m) {
  has_camera_feedback_ = true;
  t.announce(picture_taken{m.img_idx, true, place_of(m.lat, m.lng)});
}

// Its clock may be that of the camera. Where an ArduPilot reports the pictures of its camera, that would report each
// once more, with a number of its own.
void core::take(decision_context& t, const mavlink::camera_image_captured& m) {
  if (!has_camera_feedback_)
    t.announce(picture_taken{m.image_index, m.capture_result == 1, place_of(m.lat, m.lon)});
}

void core::take(decision_context& t, const mavlink::current_mode& m) {
  orders_.heard_mode(m.custom_mode);
  t.done.emplace_back(observation(m));
}

void core::take(decision_context& t, const mavlink::command_ack& m) {
  // An older sender leaves the target at 0. What is meant for another station is no answer to us.
  const bool is_for_nobody = m.target_system == 0 && m.target_component == 0;
  const bool is_ours = is_for_us(m.target_system, m.target_component) &&
                       (!is_for_nobody || commands_.is_own(m.command, t.now.monotonic_ns));
  tell_foreign(t, foreign_.on_ack(m, is_ours, t.now.monotonic_ns));
  if (!is_for_us(m.target_system, m.target_component))
    return;
  if (const auto done = commands_.acknowledge(m, watch_.vehicle()->component, t.now.monotonic_ns))
    resolve(t, *done);
}

void core::take(decision_context& t, const mavlink::mission_current& m) {
  if (const auto outcome = current_.on_mission_current(m.seq))
    t.done.emplace_back(resolved_command{{asker_kind::outside, current_.request_id()}, *outcome});
  t.done.emplace_back(observation(m));
  if (transfers_)
    go_on(t, transfers_->on(m, t.now.monotonic_ns));
}

void core::take(decision_context& t, const mavlink::timesync& m) {
  if (m.tc1 == 0 && is_for_us(m.target_system, m.target_component))
    t.send(mavlink::timesync{.tc1 = t.now.monotonic_ns,
                             .ts1 = m.ts1,
                             .target_system = watch_.vehicle()->system,
                             .target_component = watch_.vehicle()->component});
}

void core::take(decision_context& t, const mavlink::ping& m) {
  if (m.target_system == 0 && m.target_component == 0) // a question; an answer names whom it is for
    t.send(mavlink::ping{.time_usec = m.time_usec,
                         .seq = m.seq,
                         .target_system = watch_.vehicle()->system,
                         .target_component = watch_.vehicle()->component});
}

void core::note_boot_time(decision_context& t, std::uint32_t boot_ms) {
  identity_.on_boot_time(boot_ms, t.now.monotonic_ns);
  note_restart(t, watch_.on_boot_time(boot_ms, t.now.monotonic_ns));
}

void core::note_restart(decision_context& t, const std::optional<vehicle_restarted>& restarted) {
  if (!restarted)
    return;
  for (const auto& each :
       commands_.end_all(command_verdict::vehicle_restarted,
                         "the autopilot restarted before it answered; whether it acted is not known"))
    resolve(t, each);
  t.announce(*restarted);
  restart_conversation(t);
}

void core::change_phase(decision_context& t, std::optional<connection_changed> change) {
  if (!change)
    return;
  t.announce(*change);
  heard_.restart(unusable(), t.now.monotonic_ns);
  if (change->phase != connection_phase::connected) {
    streams_.end();
    answer_look(t, looks_.give_up("the vehicle is not heard"));
    return;
  }
  call_.end();
  if (const mavlink::sender name{watch_.vehicle()->system, watch_.vehicle()->component}; partner_ != name)
    begin_with(t, name);
  restart_conversation(t);
}

// What was begun with another one is over: nothing of it goes on with this one, and nothing goes out to that one.
void core::begin_with(decision_context& t, mavlink::sender vehicle) {
  const std::string why = "another vehicle is on the line in its place; whether it acted is not known";
  if (std::exchange(partner_, vehicle)) {
    for (const auto& each : commands_.end_all(command_verdict::vehicle_restarted, why))
      resolve(t, each);
    if (current_.is_busy())
      t.done.emplace_back(resolved_command{{asker_kind::outside, current_.request_id()}, current_.end_outdated(why)});
    if (transfers_ && !transfers_->is_idle())
      if (auto ended = transfers_->cancel(t.now.monotonic_ns).finished)
        t.done.emplace_back(resolved_transfer{transfer_request_, std::move(*ended)});
    orders_.forget_seen();
    mode_number_.reset();
    identity_ = {};
  }
  transfers_.emplace(ourselves(), vehicle,
                     transfer::profile_for(static_cast<mavlink::mav_autopilot>(watch_.vehicle()->autopilot)),
                     t.now.monotonic_ns);
}

line_findings core::line(std::int64_t now_ns) const {
  line_findings result;
  if (const auto& vehicle = watch_.vehicle())
    result.vehicle = vehicle_name{vehicle->system, vehicle->component};
  result.others = watch_.others(now_ns);
  result.is_chosen = settings_.watch.system != 0;
  result.twin = twin_;
  return result;
}

void core::announce_line(decision_context& t) {
  note_twin(t.now.monotonic_ns);
  auto now = line(t.now.monotonic_ns);
  if (told_line_ == now)
    return;
  told_line_ = now;
  t.announce(std::move(now));
}

// With a lost vehicle it begins when that is heard again: its streams would be overdue until then.
void core::restart_conversation(decision_context& t) {
  if (watch_.phase() != connection_phase::connected)
    return;
  streams_.begin(t.now.monotonic_ns, static_cast<mavlink::mav_autopilot>(watch_.vehicle()->autopilot));
  ask_for_streams(t);
}

void core::raise_alert(decision_context& t) {
  const bool is_due = !last_alert_ns_ || t.now.monotonic_ns - *last_alert_ns_ >= alert_period_ms * ns_per_ms;
  if (channel_.rejected() == alerted_rejections_ || !is_due)
    return;
  alerted_rejections_ = channel_.rejected();
  last_alert_ns_ = t.now.monotonic_ns;
  t.announce(signing_alert{alerted_rejections_, channel_.last_rejection()});
  if (watch_.on_refused(refused_sentence()))
    t.announce(connection_changed{watch_.phase(), why_no_vehicle(t.now.monotonic_ns)});
}

// -- time -----------------------------------------------------------------------------------------

effects core::on_time(instant now) {
  decision_context t(*this, now);
  channel_.on_silence(now, [&](auto peer, const auto& frame) { take_frame(t, peer, frame); });
  change_phase(t, watch_.on_time(now.monotonic_ns));
  send_copies(t);
  for (const auto& each : commands_.expire(now.monotonic_ns))
    resolve(t, each);
  answer_look(t, looks_.on_time(now.monotonic_ns));
  ask_for_heartbeat(t);
  if (const auto outcome = current_.on_time(now.monotonic_ns))
    t.done.emplace_back(resolved_command{{asker_kind::outside, current_.request_id()}, *outcome});
  if (current_.wants_repetition(now.monotonic_ns) && watch_.vehicle())
    announce_current(t);
  if (transfers_)
    go_on(t, transfers_->on_time(now.monotonic_ns));
  ask_for_streams(t);
  announce_line(t);
  announce_heard(t);
  if (losses_.is_due(now.monotonic_ns) && watch_.vehicle()) {
    const auto seen = report_of_vehicle();
    losses_.look(seen.followed_in, seen.sequence_gaps, now.monotonic_ns);
  }
  if (call_.is_due(now.monotonic_ns)) {
    // Where it is not known who is there: all, and by turns the usual one, for who does not answer to all.
    const std::uint8_t usual = call_.calls() % 2 == 0 ? std::uint8_t{0} : usual_system;
    const auto chosen = watch_.kept() ? watch_.kept()->system : settings_.watch.system;
    call_.called(now.monotonic_ns);
    t.send(mavlink::command_long{.target_system = chosen != 0 ? chosen : usual,
                                 .target_component = mavlink::number(mavlink::mav_component::autopilot1),
                                 .command = mavlink::number(mavlink::mav_cmd::request_message),
                                 .param1 = static_cast<float>(mavlink::heartbeat::message_id)});
  }
  if (now.monotonic_ns >= next_beat_ns_) {
    // Not "one period after the last": a late turn must not shift all later ones.
    const auto period = settings_.heartbeat_ms * ns_per_ms;
    next_beat_ns_ = std::max(next_beat_ns_ + period, now.monotonic_ns + period / 2);
    heartbeat_held_back_ = gate_.missing(now.monotonic_ns).has_value();
    // Also while the link is down: over UDP it is our heartbeat that finds out that the peer listens again.
    if (!heartbeat_held_back_)
      t.send(mavlink::heartbeat{.type = settings_.as.type,
                                .autopilot = mavlink::number(mavlink::mav_autopilot::invalid),
                                .system_status = mavlink::number(mavlink::mav_state::active)});
  }
  return std::move(t.done);
}

// The vehicle that is flown is the one that is heard when the flight begins; it stays that until the flight is over.
std::pair<effects, std::optional<vehicle_kept>> core::on_keep_vehicle(const keep_vehicle& what, instant now) {
  decision_context t(*this, now);
  const bool is_known = watch_.kept() || watch_.vehicle();
  if (what.is_kept == watch_.kept().has_value() || !is_known)
    return {};
  vehicle_kept result;
  if (what.is_kept)
    result.who = vehicle_name{watch_.vehicle()->system, watch_.vehicle()->component};
  if (const auto news = watch_.keep(result.who))
    t.announce(*news);
  return {std::move(t.done), std::move(result)};
}

// What was held back does not wait for its next turn.
void core::on_child_alive(const runtime::child_alive& what, instant now) {
  gate_.on_alive(what.name, now.monotonic_ns);
  if (heartbeat_held_back_ && !gate_.missing(now.monotonic_ns))
    next_beat_ns_ = now.monotonic_ns;
}

std::int64_t core::next_deadline_ns() const {
  auto result = next_beat_ns_;
  for (const auto& each : {watch_.next_deadline_ns(), call_.next_deadline_ns(), commands_.next_deadline_ns(),
                           current_.next_deadline_ns(), streams_.next_deadline_ns(), looks_.next_deadline_ns(),
                           transfers_ ? transfers_->next_deadline_ns() : std::nullopt})
    result = std::min(result, each.value_or(result));
  return result;
}

} // namespace godwit::vehicle_link
