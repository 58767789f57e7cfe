#include "actors/vehicle_link/core.hpp"
#include "actors/vehicle_link/relay_gate.hpp"
#include "io/mavlink/heartbeat_meaning.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace godwit::vehicle_link {

namespace {

constexpr std::int64_t ns_per_ms = 1'000'000;

// Before a vehicle is known: nearly every vehicle is system 1, and a heartbeat has to come from somewhere.
constexpr std::uint8_t usual_system = 1;

command_outcome unsent(std::uint16_t command, command_verdict verdict, std::string reason) {
  return {.command = command, .verdict = verdict, .reason = std::move(reason)};
}

bool has_nan(const send_command& c) {
  return std::isnan(c.param1) || std::isnan(c.param2) || std::isnan(c.param3) || std::isnan(c.param4) ||
         std::isnan(c.z) || (c.form == command_form::in_floats && (std::isnan(c.param5) || std::isnan(c.param6)));
}

std::vector<named_count> named(const std::vector<mavlink::channel_count>& counts) {
  std::vector<named_count> result;
  for (const auto& each : counts)
    result.push_back({each.name, each.count});
  return result;
}

void show(const mavlink::channel_report& of, connection& in) {
  in.rx_seq = of.last_sequence;
  in.signing_enabled = of.is_signing;
  in.frames_in = of.frames_in;
  in.frames_out = of.frames_out;
  in.sequence_gaps = of.sequence_gaps;
  in.parse_errors_total = of.parse_errors_total;
  in.parse_errors = named(of.parse_errors);
  in.kind_errors = named(of.kind_errors);
  in.signing_rejected = of.signing_rejected;
  in.signing_errors = named(of.signing_errors);
}

mavlink::command_long as_long(const send_command& c, std::uint8_t system) {
  return {.target_system = system,
          .target_component = c.target_component,
          .command = c.command,
          .confirmation = c.confirmation,
          .param1 = c.param1,
          .param2 = c.param2,
          .param3 = c.param3,
          .param4 = c.param4,
          .param5 = c.param5,
          .param6 = c.param6,
          .param7 = c.z};
}

mavlink::command_int as_int(const send_command& c, std::uint8_t system) {
  return {.target_system = system,
          .target_component = c.target_component,
          .frame = c.frame,
          .command = c.command,
          .param1 = c.param1,
          .param2 = c.param2,
          .param3 = c.param3,
          .param4 = c.param4,
          .x = c.x,
          .y = c.y,
          .z = c.z};
}

} // namespace

// Collects the effects of one event. Frames go to the vehicle, as soon as it is known where that is.
class core::decision_context {
public:
  decision_context(core& owner, instant when) : core_(owner), now(when) {}

  template <sent M>
  void send(const M& message) {
    if (auto frame = core_.channel_.pack(message, core_.ourselves(), now.wall_ns))
      done.emplace_back(transmission{core_.way_out(), *frame});
  }
  void announce(announcement what) { done.emplace_back(std::move(what)); }

private:
  core& core_;

public:
  instant now;
  effects done;
};

core::core(settings configured, const signing_settings& signing, mavlink::signing_time ceiling)
    : settings_(std::move(configured)), channel_(signing, ceiling), watch_(settings_.watch),
      streams_(settings_.streams), gate_(settings_.liveness_reporters, settings_.liveness_report_lasts_ms) {}

mavlink::sender core::ourselves() const {
  if (settings_.as.system != 0)
    return {settings_.as.system, settings_.as.component};
  return {watch_.vehicle() ? watch_.vehicle()->system : usual_system, settings_.as.component};
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
  return std::move(t.done);
}

void core::take_frame(decision_context& t, io::link::peer_id peer, const mavlink::frame_view& frame) {
  const auto from = frame.from();
  if (frame.id() == mavlink::heartbeat::message_id) {
    change_phase(t, watch_.on_heartbeat(mavlink::decode<mavlink::heartbeat>(frame), from.system, from.component,
                                        t.now.monotonic_ns, peer));
  }
  const bool is_vehicle = watch_.is_vehicle(from.system, from.component, peer);
  const bool is_forged = !is_vehicle && watch_.has_its_name(from.system, from.component);
  if (is_forged)
    ++under_its_name_;
  if (is_vehicle && is_late_mode(frame, t.now)) {
    ++late_heartbeats_; // a mode from before would be taken for somebody's
    return;
  }
  if (frame.id() == mavlink::radio_status::message_id) {
    t.done.emplace_back(observation(mavlink::decode<mavlink::radio_status>(frame)));
    return;
  }
  const bool is_relayed = !is_forged && relay(t, frame);
  const auto take_message = [&](const auto& message) { take(t, message); };
  if (!is_vehicle || !(told_messages::visit(frame, take_message) || used_messages::visit(frame, take_message))) {
    if (!is_relayed)
      ++not_accepted_;
    return;
  }
  streams_.on_message(frame.id());
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
  if (transfers_)
    go_on(t, transfers_->on(message, t.now.monotonic_ns));
}

template <mavlink::message M>
void core::take(decision_context& t, const M& message) {
  if constexpr (requires { message.time_boot_ms; })
    note_boot_time(t, message.time_boot_ms);
  if constexpr (told_messages::contains(M::message_id))
    t.done.emplace_back(observation(message));
}

void core::take(decision_context& t, const mavlink::heartbeat& m) {
  orders_.heard(m.custom_mode, io::mavlink::is_armed(m));
  t.done.emplace_back(observation(m));
}

void core::take(decision_context& t, const mavlink::current_mode& m) {
  orders_.heard_mode(m.custom_mode);
  t.done.emplace_back(observation(m));
}

void core::take(decision_context& t, const mavlink::command_ack& m) {
  // An older sender leaves the target at 0; what is meant for another station is none of our business.
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
  const auto restarted = watch_.on_boot_time(boot_ms, t.now.monotonic_ns);
  if (!restarted)
    return;
  for (const auto& each :
       commands_.end_all(command_verdict::vehicle_restarted,
                         "the autopilot restarted before it answered; whether it acted is not known"))
    resolve(t, each);
  t.announce(*restarted);
  restart_conversation(t);
}

void core::change_phase(decision_context& t, const std::optional<connection_changed>& change) {
  if (!change)
    return;
  t.announce(*change);
  if (change->phase != connection_phase::connected) {
    streams_.end();
    return;
  }
  call_.end();
  const auto& vehicle = *watch_.vehicle();
  if (!transfers_)
    transfers_.emplace(ourselves(), mavlink::sender{vehicle.system, vehicle.component},
                       transfer::profile_for(static_cast<mavlink::mav_autopilot>(vehicle.autopilot)));
  restart_conversation(t);
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
  if (const auto news = watch_.on_refused(refused_sentence()))
    t.announce(*news);
}

// -- time -----------------------------------------------------------------------------------------

effects core::on_time(instant now) {
  decision_context t(*this, now);
  channel_.on_silence(now, [&](const auto& frame) { take_frame(t, way_out(), frame); });
  change_phase(t, watch_.on_time(now.monotonic_ns));
  for (const auto& each : commands_.expire(now.monotonic_ns))
    resolve(t, each);
  if (const auto outcome = current_.on_time(now.monotonic_ns))
    t.done.emplace_back(resolved_command{{asker_kind::outside, current_.request_id()}, *outcome});
  if (current_.wants_repetition(now.monotonic_ns) && watch_.vehicle())
    announce_current(t);
  if (transfers_)
    go_on(t, transfers_->on_time(now.monotonic_ns));
  ask_for_streams(t);
  if (losses_.is_due(now.monotonic_ns) && watch_.vehicle()) {
    const auto seen = channel_.report(mavlink::sender{watch_.vehicle()->system, watch_.vehicle()->component});
    losses_.look(seen.frames_in, seen.sequence_gaps, now.monotonic_ns);
  }
  if (call_.is_due(now.monotonic_ns)) {
    // Where it is not known who is there: all, and by turns the usual one, for who does not answer to all.
    const std::uint8_t usual = call_.calls() % 2 == 0 ? std::uint8_t{0} : usual_system;
    call_.called(now.monotonic_ns);
    t.send(mavlink::command_long{.target_system = settings_.watch.system != 0 ? settings_.watch.system : usual,
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

// What was held back for want of a liveness_reporter does not wait for its next turn.
void core::on_liveness_report(const liveness_report& what, instant now) {
  gate_.on_liveness_report(what.who, now.monotonic_ns);
  if (heartbeat_held_back_ && !gate_.missing(now.monotonic_ns))
    next_beat_ns_ = now.monotonic_ns;
}

std::int64_t core::next_deadline_ns() const {
  auto result = next_beat_ns_;
  for (const auto& each :
       {watch_.next_deadline_ns(), call_.next_deadline_ns(), commands_.next_deadline_ns(), current_.next_deadline_ns(),
        streams_.next_deadline_ns(), transfers_ ? transfers_->next_deadline_ns() : std::nullopt})
    result = std::min(result, each.value_or(result));
  return result;
}

// -- what others ask for --------------------------------------------------------------------------

// For who knows no command for it; it has no answer.
void core::announce_current(decision_context& t) {
  if (const auto why = orders_.why_not(current_.only_while(), t.now.monotonic_ns); !why.empty()) {
    t.done.emplace_back(
        resolved_command{{asker_kind::outside, current_.request_id()}, current_.end_outdated(std::string(why))});
    return;
  }
  t.send(mavlink::mission_set_current{.target_system = watch_.vehicle()->system,
                                      .target_component = watch_.vehicle()->component,
                                      .seq = current_.sequence()});
}

std::optional<command_outcome> core::refusal(const send_command& what, instant now) {
  if (watch_.phase() == connection_phase::down)
    return unsent(what.command, command_verdict::not_sent, "the link to the vehicle is down: " + watch_.reason());
  if (!watch_.vehicle())
    return unsent(what.command, command_verdict::not_sent, "no vehicle was heard on the link yet");
  if (what.target_component == 0)
    return unsent(what.command, command_verdict::invalid, "a command needs one component that answers it, not all");
  // The simulation build of ArduPilot aborts on NaN in COMMAND_LONG, and no build of it gives NaN a meaning.
  if (watch_.vehicle()->autopilot == mavlink::number(mavlink::mav_autopilot::ardupilotmega) && has_nan(what))
    return unsent(what.command, command_verdict::invalid, "ArduPilot takes no NaN as a parameter; use 0");
  if (const auto why = orders_.why_not(what.only_while, now.monotonic_ns); !why.empty())
    return unsent(what.command, command_verdict::outdated, std::string(why));
  return std::nullopt;
}

void core::give(decision_context& t, asker who, const send_command& what) {
  if (auto refused = refusal(what, t.now)) {
    resolve(t, {who, std::move(*refused)});
    return;
  }
  const auto timeout_ms = what.timeout_ms > 0 ? what.timeout_ms : settings_.command_timeout_ms;
  if (const auto why = commands_.take(who, what, timeout_ms, t.now.monotonic_ns)) {
    const auto* const sentence = *why == command_verdict::already_running
                                     ? "the same command waits for its answer already"
                                     : "too many commands wait for their answers";
    resolve(t, {who, unsent(what.command, *why, sentence)});
    return;
  }
  send_out(t, what);
}

void core::send_out(decision_context& t, const send_command& what) {
  const auto system = watch_.vehicle()->system;
  if (what.form == command_form::in_integers)
    t.send(as_int(what, system));
  else
    t.send(as_long(what, system));
}

void core::resolve(decision_context& t, const resolved_command& done) {
  switch (done.asked_by.kind) {
  case asker_kind::outside:
    t.done.emplace_back(done);
    return;
  case asker_kind::streams:
    streams_.on_outcome(done.outcome, t.now.monotonic_ns);
    ask_for_streams(t);
    return;
  case asker_kind::current_item:
    if (const auto outcome = current_.on_outcome(done.outcome, t.now.monotonic_ns))
      t.done.emplace_back(resolved_command{{asker_kind::outside, current_.request_id()}, *outcome});
    else
      announce_current(t);
    return;
  }
}

void core::ask_for_streams(decision_context& t) {
  if (watch_.phase() != connection_phase::connected)
    return;
  while (const auto next = streams_.next_request(t.now.monotonic_ns)) {
    if (const auto* command = std::get_if<send_command>(&*next)) {
      give(t, {asker_kind::streams, 0}, *command);
      return; // its outcome asks for the next
    }
    auto older = std::get<mavlink::request_data_stream>(*next);
    older.target_system = watch_.vehicle()->system;
    older.target_component = watch_.vehicle()->component;
    t.send(older);
  }
}

effects core::on_command(std::uint64_t request_id, const send_command& what, instant now) {
  decision_context t(*this, now);
  give(t, {asker_kind::outside, request_id}, what);
  return std::move(t.done);
}

effects core::on_cancel(const cancel_command& what, instant now) {
  decision_context t(*this, now);
  if (commands_.is_waiting(what.command, what.target_component))
    t.send(mavlink::command_cancel{
        .target_system = watch_.vehicle()->system, .target_component = what.target_component, .command = what.command});
  return std::move(t.done);
}

effects core::on_set_mode(const set_mode& what, instant now) {
  decision_context t(*this, now);
  if (watch_.vehicle() && orders_.why_not(what.only_while, now.monotonic_ns).empty())
    t.send(mavlink::set_mode{
        .target_system = watch_.vehicle()->system, .base_mode = what.base_mode, .custom_mode = what.custom_mode});
  return std::move(t.done);
}

effects core::on_set_current(std::uint64_t request_id, const set_current_item& what, instant now) {
  decision_context t(*this, now);
  if (current_.is_busy()) {
    resolve(t, {{asker_kind::outside, request_id},
                unsent(mavlink::number(mavlink::mav_cmd::do_set_mission_current), command_verdict::already_running,
                       "another item is being made the current one")});
    return std::move(t.done);
  }
  give(t, {asker_kind::current_item, request_id}, current_.begin(request_id, what));
  return std::move(t.done);
}

effects core::on_set_up_signing(const set_up_signing& what, instant now) {
  decision_context t(*this, now);
  if (!channel_.may_send_key() || !watch_.vehicle())
    return std::move(t.done);
  mavlink::setup_signing message{.target_system = watch_.vehicle()->system,
                                 .target_component = watch_.vehicle()->component};
  if (!what.off) {
    message.initial_timestamp = mavlink::units(mavlink::signing_time_at(now.wall_ns));
    std::transform(channel_.key().bytes().begin(), channel_.key().bytes().end(), message.secret_key.begin(),
                   [](std::byte each) { return std::to_integer<std::uint8_t>(each); });
  }
  t.send(message);
  return std::move(t.done);
}

// -- transfers ------------------------------------------------------------------------------------

void core::go_on(decision_context& t, transfer::step next) {
  for (const auto& each : next.messages)
    std::visit([&](const auto& message) { t.send(message); }, each);
  if (next.advanced)
    t.announce(*next.advanced);
  if (next.finished)
    t.done.emplace_back(resolved_transfer{transfer_request_, std::move(*next.finished)});
}

template <class Begin>
effects core::begin_transfer(std::uint64_t request_id, mavlink::mav_mission_type type,
                             const std::optional<seen_state>& only_while, instant now, Begin begin) {
  decision_context t(*this, now);
  const auto refuse = [&](std::string why) {
    transfer::outcome outcome;
    outcome.verdict = transfer::verdict::not_begun;
    outcome.mission_type = type;
    outcome.holding = transfer::holding::unchanged;
    outcome.reason = std::move(why);
    t.done.emplace_back(resolved_transfer{request_id, std::move(outcome)});
  };
  if (watch_.phase() == connection_phase::down)
    refuse("the link to the vehicle is down: " + watch_.reason());
  else if (!transfers_)
    refuse("no vehicle was heard on the link yet");
  else if (!transfers_->is_idle())
    refuse("another transfer with the vehicle is under way");
  else if (const auto why = orders_.why_not(only_while, now.monotonic_ns); !why.empty())
    refuse(std::string(why));
  else {
    transfer_request_ = request_id;
    go_on(t, begin(*transfers_));
  }
  return std::move(t.done);
}

effects core::on_upload(std::uint64_t request_id, const upload_plan& what, instant now) {
  return begin_transfer(request_id, what.mission_type, what.only_while, now, [&](transfer::client& client) {
    return client.upload(what.mission_type, what.items, now.monotonic_ns);
  });
}

effects core::on_download(std::uint64_t request_id, const download_plan& what, instant now) {
  return begin_transfer(request_id, what.mission_type, {}, now,
                        [&](transfer::client& client) { return client.download(what.mission_type, now.monotonic_ns); });
}

effects core::on_clear(std::uint64_t request_id, const clear_plan& what, instant now) {
  return begin_transfer(request_id, what.mission_type, {}, now,
                        [&](transfer::client& client) { return client.clear(what.mission_type, now.monotonic_ns); });
}

effects core::on_cancel_transfer(instant now) {
  decision_context t(*this, now);
  if (transfers_)
    go_on(t, transfers_->cancel(now.monotonic_ns));
  return std::move(t.done);
}

// -- what is shown --------------------------------------------------------------------------------

std::string core::refused_sentence() const {
  return std::string(refused_for_signature) + ": " + channel_.last_rejection();
}

bool core::speaks_v1_only(std::int64_t now_ns) const {
  return first_v1_ns_ && channel_.frames_in() == 0 && now_ns - *first_v1_ns_ >= v1_only_after_ms * ns_per_ms;
}

connection core::describe(instant now) const {
  connection result;
  result.phase = watch_.phase();
  result.connected = result.phase == connection_phase::connected;
  result.reason = watch_.reason();
  result.last_heartbeat_age_ms = watch_.heartbeat_age_ms(now.monotonic_ns);
  std::optional<mavlink::sender> who;
  if (const auto& vehicle = watch_.vehicle()) {
    who = mavlink::sender{vehicle->system, vehicle->component};
    result.system = vehicle->system;
    result.autopilot = vehicle->autopilot;
    result.vehicle_type = vehicle->type;
  }
  show(channel_.report(who), result);
  result.tx_seq = channel_.next_sequence(ourselves());
  result.heartbeat_held_back = heartbeat_held_back_;
  result.not_accepted = not_accepted_;
  result.relayed_to_vehicle = relayed_to_vehicle_;
  result.relayed_to_stations = relayed_to_stations_;
  result.relays_dropped = relays_dropped_;
  result.vehicle_restarts = watch_.restarts();
  result.late_heartbeats = late_heartbeats_;
  result.other_autopilots = watch_.other_autopilots();
  result.under_its_name = under_its_name_;
  result.orders_kept_back = orders_.kept_back();
  result.reconnects = reconnects_;
  for (const auto id : streams_.missing())
    if (const auto* const info = mavlink::find_message(id))
      result.missing_streams.emplace_back(info->name);
  return result;
}

runtime::condition core::health(instant now) {
  if (speaks_v1_only(now.monotonic_ns))
    return {runtime::health_colour::red,
            "the vehicle speaks MAVLink 1 only; set it to MAVLink 2 (ArduPilot: SERIALn_PROTOCOL = 2, PX4: "
            "MAV_PROTO_VER = 2)"};
  if (watch_.phase() != connection_phase::connected)
    return {runtime::health_colour::red, watch_.reason()};
  if (channel_.signs_beyond_reservation())
    return {runtime::health_colour::red,
            "signing goes on without its time being on the disk: the journal does not answer"};
  if (last_alert_ns_ && now.monotonic_ns - *last_alert_ns_ < alert_lasts_ms * ns_per_ms)
    return {runtime::health_colour::yellow, refused_sentence()};
  if (const auto who = gate_.missing(now.monotonic_ns))
    return {runtime::health_colour::yellow, "our heartbeat is held back: " + *who + " does not say that it is well"};
  if (losses_.is_bad())
    return {runtime::health_colour::yellow, losses_.sentence()};
  return {runtime::health_colour::green, settings_.open_line};
}

} // namespace godwit::vehicle_link
