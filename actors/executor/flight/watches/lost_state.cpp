#include "actors/executor/flight/watches/lost_state.hpp"

#include <utility>

#include "actors/domain/mission/commands/command_table.hpp"
#include "actors/executor/may_send.hpp"
#include "actors/executor/plan/vehicle_items.hpp"

namespace godwit::executor {
namespace {

vehicle_link::send_command command_of(const io::mavlink::mission_item_int& item) {
  vehicle_link::send_command result;
  result.command = item.command;
  result.form = vehicle_link::command_form::in_integers; // a float would round a place
  result.frame = item.frame;
  result.param1 = item.param1;
  result.param2 = item.param2;
  result.param3 = item.param3;
  result.param4 = item.param4;
  result.x = item.x;
  result.y = item.y;
  result.z = item.z;
  return result;
}

} // namespace

bool lost_state::may_set(instant now) const {
  const auto& view = flight_.view;
  return !flight_.has_person() && !flight_.runner.is_busy() && view.is_connected() && view.is_armed() &&
         view.is_in(flight::mode_kind::mission) &&
         may_send({.kind = order_kind::neutral}, flight_.authority, flight_.evidence, now.now_ns) == permission::may;
}

void lost_state::look(effects& out, instant now) {
  const auto& s = flight_.s;
  if (!s.owes_state || !flight_.is_in_flight() || !s.flown || !s.progress.plan) {
    is_begun_ = false;
    rest_.clear();
    return;
  }
  if (!may_set(now))
    return;
  if (!std::exchange(is_begun_, true)) {
    const auto& g = s.progress.plan->generation;
    rest_ = flight_.is_ardupilot() ? plan::state_at(s.flown->items, g.moved_to.value_or(g.current))
                                   : std::vector<io::mavlink::mission_item_int>();
    tries_ = 0;
    asked_ns_ = 0;
  }
  if (asked_ns_ != 0 && now.now_ns - asked_ns_ < answered_within_ns)
    return;
  if (!rest_.empty() && tries_ == max_tries) {
    warn(out, "no acknowledgement came");
    rest_.erase(rest_.begin());
    tries_ = 0;
  }
  if (rest_.empty()) {
    is_begun_ = false;
    out.emplace_back(note{state_set_again{}});
    return;
  }
  ++tries_;
  asked_ns_ = now.now_ns;
  auto command = command_of(rest_.front());
  command.confirmation = static_cast<std::uint8_t>(tries_ - 1);
  command.only_while = flight_.known();
  out.emplace_back(order{goes::at_once, ++last_number_, now.now_ns, {}, std::move(command)});
}

void lost_state::on_command(effects& out, std::uint64_t number, const vehicle_link::command_outcome& outcome) {
  using vehicle_link::command_verdict;
  if (number != last_number_ || rest_.empty() || asked_ns_ == 0)
    return;
  asked_ns_ = 0;
  if (outcome.verdict == command_verdict::refused)
    warn(out, outcome.reason);
  if (outcome.verdict != command_verdict::accepted && outcome.verdict != command_verdict::refused)
    return; // once more
  rest_.erase(rest_.begin());
  tries_ = 0;
}

void lost_state::warn(effects& out, const std::string& why) const {
  const auto* const row = mission::command_of(rest_.front().command);
  out.emplace_back(announce{"after the pause the vehicle did not take " +
                                std::string(row == nullptr ? "a command" : row->name) + " of its plan again: " + why,
                            true});
}

} // namespace godwit::executor
