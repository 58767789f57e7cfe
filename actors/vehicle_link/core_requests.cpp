// What others ask the link for: commands, modes, items to go on at, keys, and transfers of plans.
#include <cmath>
#include <utility>

#include "actors/vehicle_link/core_context.hpp"

namespace godwit::vehicle_link {

namespace {

command_outcome unsent(std::uint16_t command, command_verdict verdict, std::string reason) {
  return {.command = command, .verdict = verdict, .reason = std::move(reason)};
}

bool has_nan(const send_command& c) {
  return std::isnan(c.param1) || std::isnan(c.param2) || std::isnan(c.param3) || std::isnan(c.param4) ||
         std::isnan(c.z) || (c.form == command_form::in_floats && (std::isnan(c.param5) || std::isnan(c.param6)));
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
    return unsent(what.command, command_verdict::not_sent,
                  "there is no vehicle on the link: " + why_no_vehicle(now.monotonic_ns));
  if (what.target_component == 0)
    return unsent(what.command, command_verdict::invalid, "a command needs one component that answers it, not all");
  // The simulation build of ArduPilot aborts on NaN in COMMAND_LONG, and no build of it gives NaN a meaning.
  if (watch_.vehicle()->autopilot == mavlink::number(mavlink::mav_autopilot::ardupilotmega) && has_nan(what))
    return unsent(what.command, command_verdict::invalid, "ArduPilot takes no NaN as a parameter; use 0");
  // Both would be armed.
  const bool arms = what.command == mavlink::number(mavlink::mav_cmd::component_arm_disarm) && what.param1 > 0;
  if (arms && !twin_.empty())
    return unsent(what.command, command_verdict::invalid, twin_);
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
  case asker_kind::look:
    answer_look(t, looks_.on_outcome(done.outcome, t.now.monotonic_ns));
    ask_for_heartbeat(t);
    return;
  case asker_kind::current_item:
    if (const auto outcome = current_.on_outcome(done.outcome, t.now.monotonic_ns))
      t.done.emplace_back(resolved_command{{asker_kind::outside, current_.request_id()}, *outcome});
    else
      announce_current(t);
    return;
  }
}

// What has changed since it was decided ends it here: the answer to the copies before may still come.
void core::send_copies(decision_context& t) {
  for (const auto& each : commands_.due_copies(t.now.monotonic_ns)) {
    if (watch_.vehicle() && orders_.why_not(each.only_while, t.now.monotonic_ns).empty())
      send_out(t, each);
    else
      commands_.send_no_more_copies(each);
  }
}

void core::answer_look(decision_context& t, const std::optional<resolved_look>& done) {
  if (done)
    t.done.emplace_back(*done);
}

void core::ask_for_heartbeat(decision_context& t) {
  if (const auto request = looks_.next_request(t.now.monotonic_ns))
    give(t, {asker_kind::look, 0}, *request);
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

// A vehicle that changes its key in flight could leave nobody who commands it.
std::string core::why_no_key() const {
  if (!channel_.is_signing())
    return "godwitd has no key to give (--signing-key)";
  if (!channel_.may_send_key())
    return "the line to the vehicle is not marked as one on which nobody can listen (vehicle.secure)";
  if (watch_.phase() != connection_phase::connected)
    return "the vehicle is not heard";
  return orders_.is_surely_disarmed() ? "" : "not while the vehicle is armed";
}

std::pair<effects, signing_answer> core::on_set_up_signing(const set_up_signing& what, instant now) {
  decision_context t(*this, now);
  if (auto why = why_no_key(); !why.empty())
    return {effects{}, {false, std::move(why)}};
  mavlink::setup_signing message{.target_system = watch_.vehicle()->system,
                                 .target_component = watch_.vehicle()->component};
  if (!what.off) {
    message.initial_timestamp = mavlink::units(mavlink::signing_time_at(now.wall_ns));
    std::transform(channel_.key().bytes().begin(), channel_.key().bytes().end(), message.secret_key.begin(),
                   [](std::byte each) { return std::to_integer<std::uint8_t>(each); });
  }
  t.send(message);
  return {std::move(t.done), {true, {}}};
}

// PX4 sends what it is asked for before its answer, and ArduPilot after it.
effects core::on_look(std::uint64_t request_id, instant now) {
  decision_context t(*this, now);
  if (watch_.phase() != connection_phase::connected) {
    t.done.emplace_back(resolved_look{request_id, {false, 0, "the vehicle is not heard"}});
    return std::move(t.done);
  }
  const bool is_px4 = watch_.vehicle()->autopilot == mavlink::number(mavlink::mav_autopilot::px4);
  answer_look(t, looks_.begin(request_id, is_px4, now.monotonic_ns));
  ask_for_heartbeat(t);
  return std::move(t.done);
}

effects core::on_watch_closely(const watch_closely& what, instant now) {
  decision_context t(*this, now);
  streams_.want_heartbeats(what.is_close, now.monotonic_ns);
  if (!what.is_close)
    commands_.send_no_more_copies();
  ask_for_streams(t);
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
    refuse("there is no vehicle on the link: " + why_no_vehicle(now.monotonic_ns));
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
  return begin_transfer(request_id, what.mission_type, {}, now, [&](transfer::client& client) {
    return client.download(what.mission_type, now.monotonic_ns, what.id_suffices);
  });
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

} // namespace godwit::vehicle_link
