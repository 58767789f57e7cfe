#include "programs/godwit-drill/flight_simulation/people_audit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

#include "io/mavlink/enums.hpp"
#include "programs/godwit-drill/flight_simulation/vehicle_modes.hpp"

namespace godwit::drill {
namespace {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::number;
using sim::mode_kind;

constexpr std::uint8_t custom_bit = 1; // of a base mode

// What the two forms of a command have in common.
struct command_words {
  std::uint16_t command = 0;
  float param1 = 0;
  float param2 = 0;
  float param3 = 0;
};

std::optional<command_words> command_in(const mavlink::frame_view& frame) {
  if (frame.id() == mavlink::command_long::message_id) {
    const auto m = mavlink::decode<mavlink::command_long>(frame);
    return command_words{m.command, m.param1, m.param2, m.param3};
  }
  if (frame.id() == mavlink::command_int::message_id) {
    const auto m = mavlink::decode<mavlink::command_int>(frame);
    return command_words{m.command, m.param1, m.param2, m.param3};
  }
  return std::nullopt;
}

const sim::flight_mode* mode_in(const mavlink::frame_view& frame, sim::personality who) {
  const auto custom = custom_mode_in(frame, who);
  return custom ? sim::find_mode(modes_of(who), *custom) : nullptr;
}

moving_order moving_order_of(mode_kind kind) {
  switch (kind) {
  case mode_kind::mission:
    return moving_order::mission_mode;
  case mode_kind::guided:
    return moving_order::guided_mode;
  case mode_kind::take_off:
    return moving_order::take_off;
  case mode_kind::manual:
  case mode_kind::hold:
  case mode_kind::come_back:
  case mode_kind::land:
    break; // which stop it
  }
  return moving_order::none;
}

std::string_view words_of(moving_order what) {
  switch (what) {
  case moving_order::none:
    return "nothing";
  case moving_order::arm:
    return "ARM";
  case moving_order::mission_mode:
    return "the mission mode";
  case moving_order::guided_mode:
    return "a guided mode";
  case moving_order::start:
    return "MISSION_START";
  case moving_order::take_off:
    return "a take-off";
  case moving_order::reposition:
    return "DO_REPOSITION";
  case moving_order::choose_item:
    return "another item";
  }
  return "";
}

std::string seconds(std::int64_t ns) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f s", static_cast<double>(ns) * 1e-9);
  return text.data();
}

// The kind of mode that a station asks for by a command of its own; only what stops a flight or gives it to a pilot.
std::optional<mode_kind> stop_in(const mavlink::frame_view& frame, sim::personality who) {
  if (const auto* mode = mode_in(frame, who))
    return moving_order_of(mode->kind) == moving_order::none ? std::optional(mode->kind) : std::nullopt;
  const auto command = command_in(frame);
  if (!command)
    return std::nullopt;
  if (command->command == number(mav_cmd::nav_return_to_launch))
    return mode_kind::come_back;
  if (command->command == number(mav_cmd::nav_land))
    return mode_kind::land;
  if (command->command == number(mav_cmd::nav_loiter_unlim))
    return mode_kind::hold;
  return std::nullopt;
}

} // namespace

std::optional<std::uint32_t> custom_mode_in(const mavlink::frame_view& frame, sim::personality who) {
  if (frame.id() == mavlink::set_mode::message_id) {
    const auto m = mavlink::decode<mavlink::set_mode>(frame);
    return (m.base_mode & custom_bit) != 0 ? std::optional(m.custom_mode) : std::nullopt;
  }
  const auto m = command_in(frame);
  const bool is_mode = m && m->command == number(mav_cmd::do_set_mode) && m->param1 >= 0 && m->param1 < 256 &&
                       (static_cast<std::uint8_t>(m->param1) & custom_bit) != 0 && m->param2 >= 0 && m->param3 >= 0 &&
                       m->param3 < 256;
  if (!is_mode)
    return std::nullopt;
  const auto main_mode = static_cast<std::uint32_t>(m->param2);
  return who == sim::personality::px4 ? sim::px4_mode(main_mode, static_cast<std::uint32_t>(m->param3)) : main_mode;
}

moving_order moving_order_in(const mavlink::frame_view& frame, sim::personality who) {
  if (frame.id() == mavlink::mission_set_current::message_id)
    return moving_order::choose_item;
  if (const auto* mode = mode_in(frame, who))
    return moving_order_of(mode->kind);
  const auto command = command_in(frame);
  if (!command)
    return moving_order::none;
  if (command->command == number(mav_cmd::component_arm_disarm))
    return command->param1 == 1 ? moving_order::arm : moving_order::none;
  if (command->command == number(mav_cmd::mission_start))
    return moving_order::start;
  if (command->command == number(mav_cmd::nav_takeoff))
    return moving_order::take_off;
  if (command->command == number(mav_cmd::do_reposition))
    return moving_order::reposition;
  if (command->command == number(mav_cmd::do_set_mission_current))
    return moving_order::choose_item;
  return moving_order::none;
}

// -- what people do ---------------------------------------------------------------------------------

void people_audit::on_handled(const mavlink::frame_view& frame, bool is_persons, const sim::vehicle_picture& before,
                              const sim::vehicle_picture& after, std::int64_t now_ns) {
  const bool changes_mode = before.mode != after.mode;
  const bool disarms = before.armed && !after.armed;
  if (is_persons && !before.armed && after.armed)
    armed_ns_ = now_ns;
  if (!is_persons) {
    const auto* mode = mode_in(frame, who_);
    const bool is_same_mode = act_ && !act_->is_disarm && mode != nullptr && mode->name == act_->mode;
    const bool is_before_shown = act_ && (!act_->shown_ns || now_ns <= *act_->shown_ns + heeded_within_ns);
    if (act_ && !is_in_force())
      act_.reset(); // by a race, or it was found when it was sent
    else if (is_same_mode && is_before_shown)
      act_->is_as_godwits = true;
    return;
  }
  if (!changes_mode && !disarms)
    return;
  held_act act;
  act.at_ns = now_ns;
  act.mode = after.mode;
  act.is_disarm = disarms;
  act.words = disarms ? "disarm" : "change from " + before.mode + " to " + after.mode;
  act.words += " (message " + std::to_string(frame.id()) + ")";
  act_ = std::move(act);
}

void people_audit::on_release() {
  act_.reset();
  armed_ns_.reset();
  on_word();
}

bool people_audit::is_in_force() const {
  const auto seen = now_seen_();
  return act_ && (act_->is_disarm ? !seen.armed : seen.mode == act_->mode);
}

// By what godwit hears of it.
bool people_audit::is_known(const held_act& act, std::int64_t now_ns) const {
  if (act.answered_ns && now_ns > *act.answered_ns + heeded_within_ns)
    return true;
  if (act.is_as_godwits)
    return false;
  return act.shown_ns ? now_ns > *act.shown_ns + heeded_within_ns : now_ns > act.at_ns + shown_within_ns;
}

// -- what godwit sends ------------------------------------------------------------------------------

void people_audit::on_sent(const mavlink::frame_view& frame, std::int64_t now_ns) {
  if (frame.from() != godwit_id) { // passed on for a station; what the line then does with it is not godwit's
    const auto mode = custom_mode_in(frame, who_);
    for (auto& each : wanted_)
      each.is_done = each.is_done || (!each.needs_answer && mode && each.mode == mode);
    return;
  }
  const auto command = command_in(frame);
  if (command && command->command == number(mav_cmd::component_arm_disarm) && command->param1 != 1) {
    sent_ns_.erase(command->command); // what is accepted next is a disarm
    if (armed_ns_ && now_seen_().armed)
      find("disarm: DISARM was sent " + seconds(now_ns - *armed_ns_) + " after a person had armed it", now_ns);
    armed_ns_.reset();
  }
  if (const auto order = moving_order_in(frame, who_); order != moving_order::none)
    judge_order(order, frame, now_ns);
}

void people_audit::judge_order(moving_order order, const mavlink::frame_view& frame, std::int64_t now_ns) {
  if (act_ && !is_in_force())
    act_.reset();
  if (act_ && is_known(*act_, now_ns)) {
    find("taken: " + std::string(words_of(order)) + " was sent " + seconds(now_ns - act_->at_ns) +
             " after a person's " + act_->words +
             (act_->shown_ns ? ", shown " + seconds(now_ns - *act_->shown_ns) + " before" : ", never shown"),
         now_ns);
    act_.reset();
  }
  const bool flies_plan = order == moving_order::start || order == moving_order::mission_mode;
  if (flies_plan && foreign_since_ns_ && now_ns > *foreign_since_ns_ + proof_lasts_ns) {
    find("foreign: " + std::string(words_of(order)) + " was sent " + seconds(now_ns - *foreign_since_ns_) +
             " after somebody else had uploaded another plan",
         now_ns);
    foreign_since_ns_ = now_ns; // one finding for each
  }
  if (order == moving_order::arm || order == moving_order::start)
    judge_again(frame, now_ns);
}

void people_audit::judge_again(const mavlink::frame_view& frame, std::int64_t now_ns) {
  const auto command = command_in(frame)->command;
  const auto accepted = accepted_ns_.find(command);
  if (accepted != accepted_ns_.end() && now_ns > accepted->second + copies_within_ns) {
    find("again: command " + std::to_string(command) + " was sent " + seconds(now_ns - accepted->second) +
             " after the vehicle had accepted it",
         now_ns);
    accepted_ns_.erase(accepted);
  }
  sent_ns_[command] = now_ns;
}

void people_audit::on_answered(const mavlink::frame_view& frame, std::int64_t now_ns) {
  if (frame.id() == mavlink::command_ack::message_id) {
    const auto m = mavlink::decode<mavlink::command_ack>(frame);
    const bool is_accepted = m.result == number(mavlink::mav_result::accepted) && m.target_system == godwit_id.system &&
                             m.target_component == godwit_id.component;
    if (is_accepted && sent_ns_.contains(m.command))
      accepted_ns_.try_emplace(m.command, now_ns);
  } else if (frame.id() == mavlink::mission_ack::message_id) {
    const auto m = mavlink::decode<mavlink::mission_ack>(frame);
    const bool is_ours = m.target_system == godwit_id.system && m.target_component == godwit_id.component;
    if (is_ours && m.type == 0 && m.mission_type == 0)
      foreign_since_ns_.reset();
  }
}

// ArduPilot acknowledges SET_MODE as if that were a command.
void people_audit::on_acknowledged(const mavlink::command_ack& m, std::int64_t now_ns) {
  const bool is_mode = m.command == number(mav_cmd::do_set_mode) || m.command == mavlink::set_mode::message_id;
  const bool is_of_act = act_ && (act_->is_disarm ? m.command == number(mav_cmd::component_arm_disarm) : is_mode);
  const bool is_to_other = m.target_system != godwit_id.system || m.target_component != godwit_id.component;
  if (is_of_act && is_to_other && !act_->answered_ns && m.result == number(mavlink::mav_result::accepted))
    act_->answered_ns = now_ns;
}

void people_audit::on_delivered(const mavlink::frame_view& frame, std::int64_t now_ns) {
  if (frame.id() == mavlink::command_ack::message_id)
    return on_acknowledged(mavlink::decode<mavlink::command_ack>(frame), now_ns);
  if (frame.id() != mavlink::heartbeat::message_id)
    return;
  if (act_ && !act_->shown_ns && is_in_force()) {
    const auto m = mavlink::decode<mavlink::heartbeat>(frame);
    const bool is_armed = (m.base_mode & number(mavlink::mav_mode_flag::safety_armed)) != 0;
    const auto* mode = sim::find_mode(modes_of(who_), m.custom_mode);
    const bool shows = act_->is_disarm ? !is_armed : mode != nullptr && mode->name == act_->mode;
    if (shows)
      act_->shown_ns = now_ns;
  }
  if (accepted_ns_.empty())
    return;
  constexpr double moves_mps = 0.5;
  const auto seen = now_seen_();
  if (seen.in_air || seen.ground_speed_mps > moves_mps)
    accepted_ns_.clear(); // it was done; after a landing it may be sent anew
}

// -- stations at the port ---------------------------------------------------------------------------

void people_audit::on_station_sent(const mavlink::frame_view& frame, std::int64_t now_ns) {
  const auto command = command_in(frame);
  const bool is_mode = frame.id() == mavlink::set_mode::message_id;
  if (!command && !is_mode)
    return;
  on_release(); // a person's word: what they start, arm or set is theirs
  wanted_state wanted;
  wanted.since_ns = now_ns;
  wanted.command = command ? command->command : number(mav_cmd::do_set_mode);
  wanted.needs_answer = !is_mode;
  wanted.judged_ns = now_ns + done_within_ns;
  if (const auto kind = stop_in(frame, who_)) {
    const auto seen = now_seen_();
    if (is_mode && !(seen.armed && (seen.in_air || who_ == sim::personality::rover)))
      return;
    const auto* mode = mode_in(frame, who_);
    if (mode == nullptr && !sim::has_mode_of_kind(modes_of(who_), *kind))
      return;
    wanted.mode = mode != nullptr ? mode->custom : sim::mode_of_kind(modes_of(who_), *kind).custom;
    wanted.words = std::string(sim::find_mode(modes_of(who_), *wanted.mode)->name);
  } else if (command && command->command == number(mav_cmd::component_arm_disarm)) {
    wanted.is_armed = command->param1 == 1;
    wanted.words = *wanted.is_armed ? "armed" : "disarmed";
  } else {
    return;
  }
  if (wanted_.size() == max_waiting) {
    judge_wanted(wanted_.front());
    wanted_.pop_front();
  }
  wanted_.push_back(std::move(wanted));
}

void people_audit::on_station_heard(const mavlink::frame_view& frame, std::int64_t now_ns) {
  if (frame.id() != mavlink::command_ack::message_id)
    return;
  const auto m = mavlink::decode<mavlink::command_ack>(frame);
  for (auto& each : wanted_) {
    if (each.command != m.command || each.is_answered || !each.needs_answer)
      continue;
    if (m.result == number(mavlink::mav_result::accepted)) {
      each.is_answered = true;
      each.judged_ns = now_ns + done_within_ns;
      break;
    }
    if (m.result != number(mavlink::mav_result::in_progress)) {
      each.is_done = true; // refused: nothing was promised
      break;
    }
  }
}

void people_audit::on_time(std::int64_t now_ns) {
  if (wanted_.empty())
    return;
  observe_wanted();
  while (!wanted_.empty() && (wanted_.front().is_done || now_ns >= wanted_.front().judged_ns)) {
    judge_wanted(wanted_.front());
    wanted_.pop_front();
  }
}

void people_audit::observe_wanted() {
  const auto seen = now_seen_();
  for (auto& each : wanted_) {
    if (each.mode && sim::find_mode(modes_of(who_), *each.mode)->name == seen.mode)
      each.is_done = true;
    if (each.is_armed && *each.is_armed == seen.armed)
      each.is_done = true;
  }
}

void people_audit::judge_wanted(const wanted_state& each) {
  if (each.is_done || (each.needs_answer && !each.is_answered))
    return;
  if (each.needs_answer)
    find("answer: a station received ACCEPTED for command " + std::to_string(each.command) +
             ", and the vehicle was not " + each.words + " within " + seconds(done_within_ns),
         each.since_ns);
  else
    find("swallowed: a station's SET_MODE to " + each.words + " was not done within " + seconds(done_within_ns),
         each.since_ns);
}

void people_audit::find(const std::string& finding, std::int64_t now_ns) {
  if (findings_.size() < max_findings)
    findings_.push_back("people: " + std::to_string(now_ns / 1'000'000) + " ms: " + finding);
}

} // namespace godwit::drill
