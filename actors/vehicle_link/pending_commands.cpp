#include "actors/vehicle_link/pending_commands.hpp"

#include <algorithm>
#include <string>

#include "io/mavlink/enums.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

using io::mavlink::mav_result;

command_outcome outcome_of(const io::mavlink::command_ack& ack, std::int64_t round_trip_ns) {
  command_outcome result;
  result.command = ack.command;
  result.verdict = ack.result == static_cast<std::uint8_t>(mav_result::accepted) ? command_verdict::accepted
                                                                                 : command_verdict::refused;
  result.result = ack.result;
  result.result_param2 = ack.result_param2;
  result.round_trip_us = round_trip_ns / ns_per_us;
  if (result.verdict != command_verdict::accepted)
    result.reason = sentence_for_result(ack.result);
  return result;
}

command_outcome unanswered(std::uint16_t command, command_verdict verdict, std::string reason) {
  command_outcome result;
  result.command = command;
  result.verdict = verdict;
  result.reason = std::move(reason);
  return result;
}

} // namespace

std::string sentence_for_result(std::uint8_t result) {
  switch (static_cast<mav_result>(result)) {
  case mav_result::accepted:
    return "the vehicle accepted it";
  case mav_result::temporarily_rejected:
    return "the vehicle can not do it at the moment; try again";
  case mav_result::denied:
    return "the vehicle denied it: its parameters or the vehicle's state do not allow it";
  case mav_result::unsupported:
    return "the vehicle does not know this command";
  case mav_result::failed:
    return "the vehicle tried and failed; its status text says why";
  case mav_result::in_progress:
    return "the vehicle is working on it";
  case mav_result::cancelled:
    return "the vehicle gave it up because it was asked to";
  case mav_result::command_long_only:
    return "the vehicle takes this command only as COMMAND_LONG";
  case mav_result::command_int_only:
    return "the vehicle takes this command only as COMMAND_INT";
  case mav_result::unsupported_mav_frame:
    return "the vehicle does not take this command in this coordinate frame";
  case mav_result::not_in_control:
    return "another station has control of the vehicle";
  }
  return "the vehicle answered with result " + std::to_string(result) + ", which is not known here";
}

std::optional<command_verdict> pending_commands::take(asker asked_by, const send_command& what, std::int64_t timeout_ms,
                                                      std::int64_t now_ns) {
  const key which{what.command, what.target_component};
  if (waiting_.contains(which))
    return command_verdict::already_running;
  if (waiting_.size() >= max_commands_in_flight)
    return command_verdict::too_many;
  const auto timeout_ns = timeout_ms * ns_per_ms;
  auto& entry = waiting_[which];
  entry = {asked_by, what, now_ns + copy_after_ns(), now_ns, timeout_ns, now_ns + timeout_ns};
  stop_late_copies(entry);
  std::erase_if(own_, [&](const auto& each) { return now_ns - each.second > own_answers_repeat_ns; });
  own_[what.command] = now_ns;
  return std::nullopt;
}

std::int64_t pending_commands::copy_after_ns() const {
  const auto slowest = std::ranges::max_element(round_trips_ns_);
  return std::max(copy_after_ms * ns_per_ms, slowest == round_trips_ns_.end() ? 0 : *slowest);
}

void pending_commands::stop_late_copies(waiting& entry) const {
  if (entry.copy_ns - entry.sent_ns > copies_within_ms * ns_per_ms)
    entry.what.copies = 1;
}

bool pending_commands::is_own(std::uint16_t command, std::int64_t now_ns) const {
  const auto found = own_.find(command);
  return found != own_.end() && now_ns - found->second <= own_answers_repeat_ns;
}

std::vector<send_command> pending_commands::due_copies(std::int64_t now_ns) {
  std::vector<send_command> result;
  for (auto& [which, entry] : waiting_) {
    if (entry.what.copies <= 1 || now_ns < entry.copy_ns)
      continue;
    --entry.what.copies;
    ++entry.what.confirmation;
    entry.copy_ns = now_ns + copy_after_ns();
    result.push_back(entry.what);
    stop_late_copies(entry);
  }
  return result;
}

void pending_commands::send_no_more_copies(const send_command& of) {
  if (const auto found = waiting_.find({of.command, of.target_component}); found != waiting_.end())
    found->second.what.copies = 1;
}

void pending_commands::send_no_more_copies() {
  for (auto& [which, entry] : waiting_)
    entry.what.copies = 1;
}

std::optional<resolved_command> pending_commands::acknowledge(const io::mavlink::command_ack& ack,
                                                              std::uint8_t component, std::int64_t now_ns) {
  const auto found = waiting_.find({ack.command, component});
  if (found == waiting_.end())
    return std::nullopt;
  auto& entry = found->second;
  entry.what.copies = 1;
  if (round_trips_ns_.size() == round_trips_kept)
    round_trips_ns_.erase(round_trips_ns_.begin());
  round_trips_ns_.push_back(now_ns - entry.sent_ns);
  if (ack.result == static_cast<std::uint8_t>(mav_result::in_progress)) {
    entry.deadline_ns = std::min(now_ns + entry.timeout_ns, entry.sent_ns + max_progress_ms * ns_per_ms);
    return std::nullopt;
  }
  resolved_command result{entry.asked_by, outcome_of(ack, now_ns - entry.sent_ns)};
  waiting_.erase(found);
  return result;
}

std::vector<resolved_command> pending_commands::expire(std::int64_t now_ns) {
  std::vector<resolved_command> result;
  for (auto each = waiting_.begin(); each != waiting_.end();) {
    const auto& [which, entry] = *each;
    if (entry.deadline_ns > now_ns) {
      ++each;
      continue;
    }
    const auto waited_ms = (now_ns - entry.sent_ns) / ns_per_ms;
    result.push_back({entry.asked_by, unanswered(which.first, command_verdict::timed_out,
                                                 "no answer within " + std::to_string(waited_ms) +
                                                     " ms; whether the vehicle acted is not known")});
    each = waiting_.erase(each);
  }
  return result;
}

std::vector<resolved_command> pending_commands::end_all(command_verdict verdict, const std::string& reason) {
  std::vector<resolved_command> result;
  for (const auto& [which, entry] : waiting_)
    result.push_back({entry.asked_by, unanswered(which.first, verdict, reason)});
  waiting_.clear();
  return result;
}

std::optional<std::int64_t> pending_commands::next_deadline_ns() const {
  std::optional<std::int64_t> result;
  for (const auto& [which, entry] : waiting_) {
    const auto due_ns = entry.what.copies > 1 ? std::min(entry.copy_ns, entry.deadline_ns) : entry.deadline_ns;
    result = std::min(result.value_or(due_ns), due_ns);
  }
  return result;
}

} // namespace godwit::vehicle_link
