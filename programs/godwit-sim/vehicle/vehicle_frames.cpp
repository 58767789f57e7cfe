// What a simulated vehicle does with the messages that come in.
#include "programs/godwit-sim/vehicle/vehicle_parts.hpp"

#include <algorithm>

#include "actors/ground_port/mission_server/item_forms.hpp"

namespace godwit::sim {

namespace {

using heard_messages = mavlink::message_list<
    mavlink::heartbeat, mavlink::set_mode, mavlink::ping, mavlink::timesync, mavlink::command_long,
    mavlink::command_int, mavlink::mission_set_current, mavlink::param_request_list, mavlink::param_request_read,
    mavlink::param_set, mavlink::request_data_stream, mavlink::mission_count, mavlink::mission_item_int,
    mavlink::mission_item, mavlink::mission_request, mavlink::mission_request_int, mavlink::mission_request_list,
    mavlink::mission_ack, mavlink::mission_clear_all, mavlink::mission_write_partial_list>;

constexpr std::uint8_t every_component = 0;
constexpr std::uint32_t manual_control_id = 69;

} // namespace

void vehicle::parts::on_frame(const mavlink::frame_view& frame, std::int64_t now_ns, line_number line) {
  advance(now_ns);
  const auto from = frame.from();
  if (!is_starting_ && from != out_.ourselves()) {
    out_.on_frame(from, line);
    plans_.lock(state_.is_armed && craft_.mission().state() == run_state::running);
    plans_.set_current(craft_.mission().current());
    if (frame.id() == file_transfer_id)
      hear_file_request(from, frame.payload());
    else if (frame.id() == manual_control_id)
      hear_sticks(frame.payload());
    else
      heard_messages::visit(frame, [&](const auto& message) { hear(from, message); });
  }
  end_turn();
}

bool vehicle::parts::is_for_us(std::uint8_t system, std::uint8_t component) const {
  const auto& us = out_.ourselves();
  if (traits_.hears_any_component)
    return system == us.system || system == 0;
  return system == us.system && (component == us.component || component == every_component);
}

void vehicle::parts::hear_file_request(mavlink::sender from, mavlink::byte_view payload) {
  const auto target = [&](std::size_t at) {
    return at < payload.size() ? std::to_integer<std::uint8_t>(payload[at]) : std::uint8_t{0};
  };
  if (!is_for_us(target(1), target(2)))
    return;
  std::vector<file_server::file> files;
  if (traits_.has_param_file)
    files.push_back(param_file(params_.all()));
  const auto there = out_.aim(out_.line_of_event());
  for (const auto& each : files_.on(from, payload, files))
    out_.send_payload(file_transfer_id, file_transfer_crc_extra, each);
}

void vehicle::parts::hear_sticks(mavlink::byte_view payload) {
  constexpr std::size_t target_at = 10;
  if (payload.size() > target_at && std::to_integer<std::uint8_t>(payload[target_at]) == out_.ourselves().system)
    pilot_->hear_sticks();
}

void vehicle::parts::hear(mavlink::sender from, const mavlink::heartbeat& m) { pilot_->hear_heartbeat(from, m); }

void vehicle::parts::hear(mavlink::sender from, const mavlink::set_mode& m) {
  if (is_for_us(m.target_system, every_component))
    pilot_->take(from, m);
}

void vehicle::parts::hear(mavlink::sender from, const mavlink::ping& m) {
  const auto there = out_.aim(out_.line_of_event());
  if (traits_.answers_ping && m.target_system == 0 && m.target_component == 0)
    out_.send(mavlink::ping{m.time_usec, m.seq, from.system, from.component});
}

void vehicle::parts::hear(mavlink::sender from, const mavlink::timesync& m) {
  const bool is_question = m.tc1 == 0;
  const bool is_ours = m.target_system == 0 || m.target_system == out_.ourselves().system;
  if (!is_question || !is_ours)
    return;
  mavlink::timesync reply{.tc1 = state_.up_ns(now_.world_ns), .ts1 = m.ts1};
  switch (traits_.timesync_target) {
  case timesync_target::nobody:
    break;
  case timesync_target::asker:
    reply.target_system = from.system;
    reply.target_component = from.component;
    break;
  case timesync_target::system_of_asker:
    reply.target_system = from.system;
    reply.target_component = 255;
    break;
  }
  const auto there = out_.aim(out_.line_of_event());
  out_.send(reply);
}

// Asking for a message is heard by all, whoever it is meant for in the system (PX4: evaluate_target_ok).
bool vehicle::parts::is_asked_of_all(const mavlink::command_long& m) const {
  return m.command == mavlink::number(mavlink::mav_cmd::request_message) && m.target_system == 0;
}

void vehicle::parts::hear(mavlink::sender from, const mavlink::command_long& m) {
  if (is_asked_of_all(m) || is_for_us(m.target_system, m.target_component))
    pilot_->take(role::read_order(from, m));
}

void vehicle::parts::hear(mavlink::sender from, const mavlink::command_int& m) {
  if (is_for_us(m.target_system, m.target_component))
    pilot_->take(role::read_order(from, m));
}

void vehicle::parts::hear(mavlink::sender, const mavlink::mission_set_current& m) {
  if (is_for_us(m.target_system, m.target_component))
    pilot_->take(m);
}

void vehicle::parts::hear(mavlink::sender, const mavlink::param_request_list& m) {
  if (!is_for_us(m.target_system, m.target_component))
    return;
  params_line_ = out_.line_of_event();
  params_.on(m, now_.real_ns);
  for (const auto text : traits_.banner)
    out_.say(mavlink::mav_severity::info, text);
  advance_params();
}

void vehicle::parts::hear(mavlink::sender, const mavlink::param_request_read& m) {
  if (!is_for_us(m.target_system, m.target_component))
    return;
  auto value = params_.on(m);
  const bool is_by_name = m.param_index < 0;
  if (value && is_by_name && traits_.hides_param_index)
    value->param_index = UINT16_MAX;
  const auto there = out_.aim(out_.line_of_event());
  if (value)
    out_.send(*value);
}

// Who has set it and everybody else: a value that has changed is told on each line.
void vehicle::parts::hear(mavlink::sender, const mavlink::param_set& m) {
  if (!is_for_us(m.target_system, m.target_component))
    return;
  auto value = params_.on(m);
  if (value && traits_.hides_param_index)
    value->param_index = UINT16_MAX;
  if (value)
    out_.send(*value);
}

void vehicle::parts::hear(mavlink::sender, const mavlink::request_data_stream& m) {
  if (!traits_.knows_stream_groups || !is_for_us(m.target_system, m.target_component))
    return;
  constexpr std::uint8_t all_groups = 0;
  constexpr std::int64_t stop = -1;
  const bool sends = m.start_stop != 0 && m.req_message_rate != 0;
  const auto interval_us = sends ? 1'000'000 / m.req_message_rate : stop;
  for (const auto& each : stream_groups()) {
    if (m.req_stream_id != all_groups && m.req_stream_id != each.number)
      continue;
    auto& streams = streams_[out_.line_of_event()];
    if (each.message == mavlink::mission_current::message_id)
      streams.current.set_period(sends ? interval_us * 1'000 : 0, now_.world_ns);
    else
      static_cast<void>(streams.messages.set_interval(each.message, interval_us, now_.world_ns)); // it is in the table
  }
}

// ArduPilot looks at `current` before it asks whether there is an upload. An item with 3, the altitude alone, is not
// flown here.
bool vehicle::parts::flies_to(mavlink::sender from, const plans::incoming& m) {
  const auto item = std::holds_alternative<mavlink::mission_item>(m)
                        ? plans::in_integers(std::get<mavlink::mission_item>(m))
                    : std::holds_alternative<mavlink::mission_item_int>(m) ? std::get<mavlink::mission_item_int>(m)
                                                                           : mavlink::mission_item_int{};
  const bool is_at_once = item.current == role::item_to_fly_to || item.current == role::item_with_altitude;
  if (!traits_.flies_to_items || !is_at_once || !is_for_us(item.target_system, item.target_component))
    return false;
  const bool is_flown = item.current == role::item_to_fly_to &&
                        item.command == mavlink::number(mavlink::mav_cmd::nav_waypoint) &&
                        pilot_->fly_to(role::read_order(from, item));
  const auto there = out_.aim(lines_of_partner(from));
  out_.send(mavlink::mission_ack{
      .target_system = from.system,
      .target_component = from.component,
      .type = mavlink::number(is_flown ? mavlink::mav_mission_result::accepted : mavlink::mav_mission_result::error)});
  return true;
}

void vehicle::parts::hear(mavlink::sender from, const plans::incoming& m) {
  const bool was_receiving = plans_.is_receiving();
  note_partner(from);
  if (flies_to(from, m))
    return;
  if (const auto* count = std::get_if<mavlink::mission_count>(&m))
    if (is_for_us(count->target_system, count->target_component) &&
        count->mission_type == mavlink::number(mavlink::mav_mission_type::mission))
      pilot_->expect_upload();
  react(plans_.on(from, m, now_.real_ns), was_receiving);
}

void vehicle::parts::take_rally_points() {
  std::vector<position> places;
  for (const auto& each : plans_.plan(mavlink::mav_mission_type::rally).items)
    places.push_back({each.x / mavlink::units_a_degree, each.y / mavlink::units_a_degree, craft_.home().altitude_m});
  craft_.set_rally_points(std::move(places));
}

void vehicle::parts::react(const plans::reaction& to, bool was_receiving) {
  bool is_whole = false;
  for (const auto& each : to.changes) {
    is_whole = is_whole || each.kind != plans::plan_change_kind::begun_replacing;
    pilot_->on_change(each);
    if (each.type == mavlink::mav_mission_type::rally && each.kind != plans::plan_change_kind::begun_replacing)
      take_rally_points();
  }
  outlet::line_set partner;
  for (const auto& each : to.messages)
    std::visit(
        [&](const auto& message) {
          partner = lines_of_partner({message.target_system, message.target_component});
          const auto there = out_.aim(partner);
          out_.send(message);
        },
        each);
  for (const auto& each : to.texts) {
    const bool is_for_partner =
        std::ranges::find(traits_.texts_for_uploader, each.text) != traits_.texts_for_uploader.end();
    if (is_for_partner)
      out_.say_on(partner, each.severity, each.text);
    else
      out_.say(each.severity, each.text);
  }
  if (was_receiving && !plans_.is_receiving() && !is_whole)
    pilot_->on_half_a_plan();
}

void vehicle::parts::note_partner(mavlink::sender who) {
  const auto found = std::ranges::find(uploaders_, who, &decltype(uploaders_)::value_type::first);
  if (found != uploaders_.end())
    found->second = out_.line_of_event();
  else if (uploaders_.size() < outlet::max_senders)
    uploaders_.emplace_back(who, out_.line_of_event());
}

outlet::line_set vehicle::parts::lines_of_partner(mavlink::sender who) const {
  const auto found = std::ranges::find(uploaders_, who, &decltype(uploaders_)::value_type::first);
  return outlet::only(found == uploaders_.end() ? out_.line_of_event() : found->second);
}

} // namespace godwit::sim
