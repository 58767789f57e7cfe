// What the link shows of itself.
#include <utility>
#include <vector>

#include "actors/vehicle_link/core_context.hpp"

#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

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
  in.signed_in = of.signed_in;
  in.signing_rejected = of.signing_rejected;
  in.signing_errors = named(of.signing_errors);
}

} // namespace

std::string core::refused_sentence() const {
  return std::string(refused_for_signature) + ": " + channel_.last_rejection();
}

unusable_frames core::unusable() const {
  return {channel_.rejected(), channel_.report(std::nullopt).parse_errors_total, channel_.v1_frames()};
}

std::string core::why_no_vehicle(std::int64_t now_ns) const {
  return watch_.reason() + heard_.sentence(unusable(), now_ns);
}

void core::announce_heard(decision_context& t) {
  const auto phase = watch_.phase();
  if (phase == connection_phase::connected || phase == connection_phase::down ||
      !heard_.may_be_announced(t.now.monotonic_ns) || !heard_.on_announcement(unusable(), t.now.monotonic_ns))
    return;
  t.announce(connection_changed{phase, why_no_vehicle(t.now.monotonic_ns)});
}

bool core::speaks_v1_only(std::int64_t now_ns) const {
  return first_v1_ns_ && channel_.frames_in() == 0 && now_ns - *first_v1_ns_ >= v1_only_after_ms * ns_per_ms;
}

mavlink::channel_report core::report_of_vehicle() const {
  const auto& vehicle = watch_.vehicle();
  return vehicle ? channel_.report(mavlink::sender{vehicle->system, vehicle->component}, vehicle->peer)
                 : channel_.report(std::nullopt);
}

connection core::describe(instant now) const {
  connection result;
  result.phase = watch_.phase();
  result.connected = result.phase == connection_phase::connected;
  result.reason = result.connected ? std::string() : why_no_vehicle(now.monotonic_ns);
  result.last_heartbeat_age_ms = watch_.heartbeat_age_ms(now.monotonic_ns);
  result.heard_for_ms = watch_.heard_for_ms(now.monotonic_ns);
  if (const auto& vehicle = watch_.vehicle()) {
    result.system = vehicle->system;
    result.autopilot = vehicle->autopilot;
    result.vehicle_type = vehicle->type;
  }
  show(report_of_vehicle(), result);
  result.tx_seq = channel_.next_sequence(ourselves());
  result.heartbeat_held_back = heartbeat_held_back_;
  result.not_accepted = not_accepted_;
  result.relayed_to_vehicle = relayed_to_vehicle_;
  result.relayed_to_stations = relayed_to_stations_;
  result.relays_dropped = relays_dropped_;
  result.vehicle_restarts = watch_.restarts();
  result.late_heartbeats = late_heartbeats_;
  result.other_autopilots = watch_.other_autopilots();
  result.other_programs = other_programs_;
  result.under_its_name = under_its_name_;
  result.orders_kept_back = orders_.kept_back();
  result.reconnects = reconnects_;
  result.kept = watch_.kept();
  result.line = line(now.monotonic_ns);
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
    return {runtime::health_colour::red, why_no_vehicle(now.monotonic_ns)};
  if (!twin_.empty())
    return {runtime::health_colour::red, twin_};
  if (channel_.signs_beyond_reservation())
    return {runtime::health_colour::red,
            "signing goes on without its time being on the disk: the journal does not answer"};
  if (last_alert_ns_ && now.monotonic_ns - *last_alert_ns_ < alert_lasts_ms * ns_per_ms)
    return {runtime::health_colour::yellow, refused_sentence()};
  if (const auto ahead_s = channel_.followed_ahead_s(now.wall_ns); ahead_s > usual_signing_lead_s)
    return {runtime::health_colour::yellow,
            "the vehicle signs with a clock that is " + std::to_string(ahead_s) +
                " s ahead of ours (ArduPilot puts it a minute on at each start); godwit signs at its time, and from " +
                std::to_string(mavlink::max_ahead / mavlink::signing_units_per_s) +
                " s on nothing of it is believed: start it again later, or set our clock"};
  if (const auto who = gate_.missing(now.monotonic_ns))
    return {runtime::health_colour::yellow, "our heartbeat is held back: " + *who + " does not answer its pings"};
  if (auto who = partner_ ? identity_.other_sender(*partner_, now.monotonic_ns) : std::string(); !who.empty())
    return {runtime::health_colour::yellow, std::move(who)};
  if (losses_.is_bad())
    return {runtime::health_colour::yellow, losses_.sentence()};
  return {runtime::health_colour::green, settings_.open_line};
}

} // namespace godwit::vehicle_link
