#include "actors/ground_port/core.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/ground_port/about.hpp"
#include "actors/ground_port/decision_context.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "io/time_units.hpp"

namespace godwit::ground_port {

namespace {

constexpr auto onboard_computer = mavlink::number(mavlink::mav_component::onboard_computer);
constexpr auto autopilot_component = mavlink::number(mavlink::mav_component::autopilot1);

} // namespace

core::core(settings configured, const signing_settings& signing, const state& restored, bool has_executor, instant now)
    : settings_(std::move(configured)), has_executor_(has_executor),
      channel_(signing, mavlink::signing_time{restored.signing_ceiling}), stations_(settings_.heartbeats_to_begin),
      rules_(settings_.stations_are), gate_(settings_.rates), starts_(restored.last_start, now), views_(restored.views),
      acts_(static_cast<std::uint64_t>(now.wall_ns)),
      params_(params_to_show({settings_.as.system, settings_.as.component})),
      first_ticket_(static_cast<std::uint64_t>(now.wall_ns)), next_ticket_(first_ticket_),
      start_item_(restored.start_item), noted_start_item_(restored.start_item), next_beat_ns_(now.monotonic_ns) {
  make_server();
  for (const auto& each : restored.plans)
    server_->put_plan(each.type, restore(each.items));
  show_plans();
}

mavlink::sender core::ourselves() const {
  return {settings_.as.system, stood_down_ ? onboard_computer : settings_.as.component};
}

mavlink::sender core::autopilot() const { return {settings_.as.system, autopilot_component}; }

bool core::is_standing_in() const { return stands_in_for_autopilot(settings_.as) && !stood_down_; }

bool core::is_autopilot_here(std::int64_t now_ns) const {
  return autopilot_heard_ns_ && now_ns - *autopilot_heard_ns_ < autopilot_is_here_ns;
}

bool core::is_for_us(std::uint8_t target_system, std::uint8_t target_component) const {
  const auto us = ourselves();
  return (target_system == 0 || target_system == us.system) &&
         (target_component == 0 || target_component == us.component);
}

// -- the link -------------------------------------------------------------------------------------

effects core::on_link(const io::link::link_status& status, instant now) {
  decision_context t(*this, now);
  link_is_up_ = status.phase == io::link::link_phase::up;
  link_reason_ = status.reason;
  finish(t);
  return std::move(t.done);
}

effects core::on_bytes(io::link::peer_id peer, bool is_datagram, mavlink::byte_view bytes, instant now) {
  decision_context t(*this, now);
  channel_.unpack(peer, is_datagram, bytes, now, [&](const auto& frame) { take_frame(t, peer, frame); });
  if (channel_.rejected() != alerted_rejections_) {
    alerted_rejections_ = channel_.rejected();
    last_alert_ns_ = now.monotonic_ns;
  }
  finish(t);
  return std::move(t.done);
}

void core::take_frame(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame) {
  if (frame.id() == mavlink::radio_status::message_id) { // a radio's word, taken unsigned: says nothing of who is there
    ++counts_.not_accepted;
    return;
  }
  const auto who = frame.from();
  if (who.system == 0 || who.component == 0) { // no sender has such a name
    ++counts_.not_accepted;
    return;
  }
  if (who.system == settings_.as.system) {
    take_own_system(t, peer, frame);
    return;
  }
  auto* const from = stations_.hear(who, peer, t.now.monotonic_ns);
  if (from == nullptr)
    return;
  if (route(t, *from, frame))
    return;
  const bool is_taken = transfer_messages::visit(frame,
                                                 [&](const auto& m) {
                                                   if (is_busy_with_disk())
                                                     ++counts_.waiting_for_disk;
                                                   else if (!is_refused(t, *from, m))
                                                     go_on(t, server_->on(who, m, t.now.monotonic_ns));
                                                 }) ||
                        other_messages::visit(frame, [&](const auto& m) { take(t, *from, m); });
  if (!is_taken)
    ++counts_.not_accepted;
}

// Components of the vehicle are no stations: an autopilot sends commands to all components of its system, and none of
// them is answered here. That the autopilot is on this line at all ends standing in for it: stations would meet two
// autopilots with one address. It is believed by its heartbeats, and forgotten when it is silent.
void core::take_own_system(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame) {
  ++counts_.from_own_system;
  if (frame.from().component != autopilot_component)
    return;
  if (is_autopilot_here(t.now.monotonic_ns) && peer == autopilot_peer_)
    autopilot_heard_ns_ = t.now.monotonic_ns;
  if (frame.id() != mavlink::heartbeat::message_id ||
      !autopilot_beats_.note(peer, settings_.heartbeats_to_begin, t.now.monotonic_ns))
    return;
  autopilot_heard_ns_ = t.now.monotonic_ns;
  autopilot_peer_ = peer;
  if (!is_standing_in())
    return;
  stand_down(t, true);
  t.say(mavlink::mav_severity::critical, "The autopilot itself is on this port: godwit is component 191 now");
}

void core::stand_down(decision_context& t, bool is_down) {
  stood_down_ = is_down;
  const auto plans = std::exchange(server_, std::nullopt);
  make_server();
  for (const auto type :
       {mavlink::mav_mission_type::mission, mavlink::mav_mission_type::fence, mavlink::mav_mission_type::rally})
    server_->put_plan(type, plans->plan(type).items);
  params_ = vehicle_role::param_table(params_to_show(ourselves()));
  next_beat_ns_ = t.now.monotonic_ns;
}

void core::take(decision_context& t, station& from, const mavlink::heartbeat& m) {
  stations_.note_heartbeat(from, m, t.now.monotonic_ns);
}

void core::take(decision_context& t, station&, const mavlink::param_request_list& m) {
  if (is_for_us(m.target_system, m.target_component))
    params_.on(m, t.now.monotonic_ns);
  else
    ++counts_.not_for_us;
}

void core::take(decision_context& t, station&, const mavlink::param_request_read& m) {
  if (!is_for_us(m.target_system, m.target_component))
    ++counts_.not_for_us;
  else if (const auto value = params_.on(m))
    t.send(io::link::every_peer, *value);
}

void core::take(decision_context& t, station&, const mavlink::param_set& m) {
  if (!is_for_us(m.target_system, m.target_component))
    ++counts_.not_for_us;
  else if (const auto value = params_.on(m))
    t.send(io::link::every_peer, *value);
}

void core::take(decision_context& t, station& from, const mavlink::timesync& m) {
  if (m.tc1 == 0 && is_for_us(m.target_system, m.target_component))
    t.send(from.who, mavlink::timesync{.tc1 = t.now.monotonic_ns,
                                       .ts1 = m.ts1,
                                       .target_system = from.who.system,
                                       .target_component = from.who.component});
}

void core::take(decision_context& t, station& from, const mavlink::ping& m) {
  if (m.target_system == 0 && m.target_component == 0) // a question; an answer names whom it is for
    t.send(from.who, mavlink::ping{.time_usec = m.time_usec,
                                   .seq = m.seq,
                                   .target_system = from.who.system,
                                   .target_component = from.who.component});
}

// -- the vehicle and the executor -----------------------------------------------------------------

effects core::on_telemetry(const telemetry& m, instant now) {
  decision_context t(*this, now);
  if (const auto* beat = std::get_if<mavlink::heartbeat>(&m)) {
    is_armed_ = io::mavlink::is_armed(*beat);
    owner_ = flight::owner_of(*beat);
    mode_ = flight::mode_of(*beat);
    is_mode_known_ = is_mode_known_ || !forwarded_.is_waiting(now.monotonic_ns);
  }
  // In the autopilot's place we say how the mission goes: ours, and not the one that the vehicle flies by.
  const bool is_replaced = is_standing_in() && (std::holds_alternative<mavlink::mission_current>(m) ||
                                                std::holds_alternative<mavlink::mission_item_reached>(m));
  if (gate_.take(m, now.monotonic_ns) && settings_.forwards_telemetry && !is_replaced &&
      !is_autopilot_here(now.monotonic_ns)) {
    std::visit([&](const auto& message) { t.send_as(io::link::every_peer, message, autopilot()); }, m);
    ++counts_.forwarded;
  }
  finish(t);
  return std::move(t.done);
}

effects core::on_progress(const mission_progress& m, instant now) {
  decision_context t(*this, now);
  progress_ = m;
  if (m.state != mavlink::mission_state::active)
    is_hold_asked_ = false;
  // The start item is used up, whoever started the mission.
  if (is_running() && noted_start_item_ && !starts_.is_asked() && !is_busy_with_disk()) {
    noted_start_item_.reset();
    ++waiting_for_disk_;
    t.note(start_item_noted{next_ticket_++, std::nullopt, std::nullopt});
  }
  finish(t);
  return std::move(t.done);
}

effects core::on_item_reached(const item_reached& m, instant now) {
  decision_context t(*this, now);
  const bool is_told = told_reached_
                           ? told_reached_->mission_id == m.mission_id && m.report_no <= told_reached_->report_no
                           : m.is_repeated;
  if (!is_told || m.report_no == 0) {
    told_reached_ = m;
    t.send(io::link::every_peer, mavlink::mission_item_reached{.seq = m.sequence});
  }
  finish(t);
  return std::move(t.done);
}

effects core::on_status_text(const status_text& m, instant now) {
  decision_context t(*this, now);
  t.say(m.severity, m.text);
  finish(t);
  return std::move(t.done);
}

// -- time -----------------------------------------------------------------------------------------

effects core::on_time(instant now) {
  decision_context t(*this, now);
  channel_.on_silence(now, [&](auto peer, const auto& frame) { take_frame(t, peer, frame); });
  if (stood_down_ && !server_->is_receiving() && !server_->is_giving() &&
      now.monotonic_ns - autopilot_heard_ns_.value_or(0) >= stands_in_again_after_ns)
    stand_down(t, false);
  go_on(t, server_->on_time(now.monotonic_ns));
  tell_judged(t);
  if (const auto record = starts_.on_time(now))
    t.note(start_noted{*record});
  if (now.monotonic_ns >= next_beat_ns_)
    beat(t);
  finish(t);
  return std::move(t.done);
}

// Once a second: who we are, and how the operator's link is. In the autopilot's place the vehicle's own heartbeat is
// the only one: a vehicle that is silent must not seem alive.
void core::beat(decision_context& t) {
  const auto period = settings_.heartbeat_ms * ns_per_ms;
  next_beat_ns_ = std::max(next_beat_ns_ + period, t.now.monotonic_ns + period / 2);
  t.done.emplace_back(stations_.operator_now(t.now.monotonic_ns));
  if (!is_standing_in())
    t.send(io::link::every_peer, mavlink::heartbeat{.type = mavlink::number(mavlink::mav_type::onboard_controller),
                                                    .autopilot = mavlink::number(mavlink::mav_autopilot::invalid),
                                                    .system_status = mavlink::number(mavlink::mav_state::active)});
}

// What every event may have made due.
void core::finish(decision_context& t) {
  // As long as the executor has not said that it does not, it may be flying the mission.
  const bool may_be_flown = progress_ ? progress_->state == mavlink::mission_state::active : has_executor_;
  server_->lock(is_armed_ && may_be_flown);
  if (const auto message = report_.due(current(), t.now.monotonic_ns))
    t.send(io::link::every_peer, *message);
  while (const auto value = params_.due(t.now.monotonic_ns))
    t.send(io::link::every_peer, *value);
  while (const auto text = texts_.due(t.now.monotonic_ns))
    t.send(text->to, text->frame);
}

std::int64_t core::next_deadline_ns() const {
  const bool waits = !held_.empty() && held_.front().on_disk_ns;
  const auto judged_by_ns = waits ? held_.front().judged_by_ns() : std::numeric_limits<std::int64_t>::max();
  return std::min({next_beat_ns_, judged_by_ns, server_->next_deadline_ns(), starts_.next_deadline_ns(),
                   report_.next_due_ns(), params_.next_due_ns(), texts_.next_due_ns()});
}

// -- what is shown --------------------------------------------------------------------------------

port_description core::describe(instant now) const {
  port_description result;
  result.link_is_up = link_is_up_;
  result.reason = link_is_up_ ? std::string() : link_reason_;
  result.system = ourselves().system;
  result.component = ourselves().component;
  result.autopilot_heard = is_autopilot_here(now.monotonic_ns);
  result.signing_enabled = channel_.is_signing();
  result.transfer = server_->is_receiving() ? "receiving" : server_->is_giving() ? "giving" : "idle";
  const auto age_ms = [&](std::int64_t when_ns) { return (now.monotonic_ns - when_ns) / ns_per_ms; };
  for (const auto& each : stations_.all())
    result.stations.push_back({each.who.system, each.who.component, each.is_ground_station, age_ms(each.last_frame_ns),
                               each.last_beat_ns ? age_ms(*each.last_beat_ns) : -1});
  for (std::size_t i = 0; i < shown_.size(); ++i)
    result.plans.push_back({std::string(enum_names(mavlink::mav_mission_type{})[i].second), shown_[i].id,
                            static_cast<std::uint32_t>(shown_[i].items)});
  const auto seen = channel_.report(std::nullopt);
  result.counts = {{"frames_in", seen.frames_in},
                   {"frames_out", seen.frames_out},
                   {"parse_errors", seen.parse_errors_total},
                   {"signing_rejected", seen.signing_rejected},
                   {"not_accepted", counts_.not_accepted},
                   {"not_for_us", counts_.not_for_us},
                   {"from_own_system", counts_.from_own_system},
                   {"commands_for_autopilot", counts_.commands_for_autopilot},
                   {"commands_unsupported", counts_.commands_unsupported},
                   {"commands_refused", counts_.commands_refused},
                   {"forwarded", counts_.forwarded},
                   {"held_back", gate_.held_back()},
                   {"passed_to_vehicle", counts_.passed_to_vehicle},
                   {"passed_to_stations", counts_.passed_to_stations},
                   {"passing_refused", counts_.passing_refused},
                   {"passing_dropped", to_vehicle_.dropped() + acts_.dropped() + acts_.replaced()},
                   {"not_passed_to_stations", counts_.not_passed_to_stations},
                   {"acts_asked", acts_.asked()},
                   {"acts_unanswered", counts_.acts_unanswered},
                   {"not_sent", counts_.not_sent},
                   {"texts_dropped", texts_.dropped()},
                   {"plans_refused", counts_.plans_refused},
                   {"transfers_dropped", server_->dropped() + counts_.waiting_for_disk + counts_.held_dropped},
                   {"stations_refused", stations_.refused()},
                   {"stations_evicted", stations_.evicted()}};
  return result;
}

runtime::condition core::health(instant now) {
  if (stood_down_)
    return {runtime::health_colour::red,
            "the port stands in for the autopilot, but the autopilot itself is on it; set the "
            "port's component to 191, or take the autopilot off this line"};
  if (channel_.signs_beyond_reservation())
    return {runtime::health_colour::red,
            "signing goes on without its time being on the disk: the journal does not answer"};
  if (!link_is_up_)
    return {runtime::health_colour::yellow, "the link to the ground is down: " + link_reason_};
  if (last_alert_ns_ && now.monotonic_ns - *last_alert_ns_ < alert_lasts_ns)
    return {runtime::health_colour::yellow, "frames are refused for their signature: " + channel_.last_rejection()};
  return {runtime::health_colour::green, settings_.open_line};
}

} // namespace godwit::ground_port
