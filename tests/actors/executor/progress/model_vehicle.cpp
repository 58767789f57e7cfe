#include "tests/actors/executor/progress/model_vehicle.hpp"

#include <algorithm>

namespace godwit::executor::progress::test {

void model_vehicle::tick(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (!plan_)
    return;
  if (is_active_ && now_ns_ >= reaches_at_ns_)
    reach();
  if (now_ns_ >= next_current_ns_)
    say_current();
  if (kind_.goes_on && last_reached_ && now_ns_ >= next_repetition_ns_) {
    send(reached_told{*last_reached_});
    next_repetition_ns_ = now_ns_ + 1000 * ms;
  }
}

std::vector<heard> model_vehicle::take_due() {
  const auto later =
      std::stable_partition(line_.begin(), line_.end(), [&](const under_way& each) { return each.due_ns <= now_ns_; });
  std::stable_sort(line_.begin(), later, [](const auto& a, const auto& b) { return a.due_ns < b.due_ns; });
  std::vector<heard> result;
  for (auto each = line_.begin(); each != later; ++each)
    result.push_back(std::move(each->message));
  line_.erase(line_.begin(), later);
  return result;
}

void model_vehicle::load(const model_plan& plan, std::size_t number) {
  const bool was_flying = plan_ && is_active_;
  const auto before = now_says();
  const auto reached_before = last_reached_;
  const bool had_plan = plan_.has_value();
  plan_ = plan;
  sequence_ = plan.map.start_sequence;
  is_active_ = was_flying && kind_.goes_on;
  is_complete_ = false;
  last_reached_.reset();
  begin_run(number);
  if (had_plan && kind_.goes_on)
    tell_stale_messages(before, reached_before);
  if (!says_still_)
    say_current();
}

void model_vehicle::mark_run() {
  runs_.push_back({runs_.back().plan, std::vector<bool>(plan_->map.items.size()), plan_->is_foreign, true});
}

void model_vehicle::keep(const model_plan& plan, std::size_t number) {
  plan_ = plan;
  runs_.push_back({number, std::vector<bool>(plan.map.items.size()), plan.is_foreign, true});
}

void model_vehicle::tell_stale_messages(const mission_current& before, std::optional<std::uint16_t> reached_before) {
  auto odd = before;
  odd.mission_id = plan_->id;
  odd.total = plan_->map.total;
  switch (draw_.between(0, 5)) {
  case 0: // the new id with the old sequence
    send(current_told{odd});
    break;
  case 1:
    odd.seq = no_sequence;
    send(current_told{odd});
    break;
  case 2:
    if (reached_before)
      send(reached_told{*reached_before}, draw_.between(0, max_delay_ms));
    break;
  case 3:
    says_still_ = before;
    says_until_ns_ = now_ns_ + draw_.between(0, max_delay_ms) * ms;
    break;
  default:
    break;
  }
}

void model_vehicle::hold() {
  is_held_ = true;
  is_active_ = false;
  last_reached_.reset();
}

void model_vehicle::jump(std::uint16_t sequence) {
  if (kind_.goes_on && is_complete_ && !is_held_ && sequence == sequence_)
    return say_current();
  sequence_ = sequence;
  last_reached_.reset();
  is_held_ = false;
  is_active_ = true;
  is_complete_ = false;
  begin_run(runs_.back().plan);
  say_current();
}

void model_vehicle::reboot() {
  line_.clear();
  hold();
  is_complete_ = false;
  says_still_.reset();
  if (!plan_)
    return;
  sequence_ = plan_->map.first_sequence;
  begin_run(runs_.back().plan);
}

bool model_vehicle::has_flown(std::size_t since_run, std::uint32_t position) const {
  for (auto i = since_run; i < runs_.size(); ++i) {
    if (i > since_run && runs_[i].plan != runs_[i - 1].plan && !runs_[i].is_same_content)
      return false;
    if (position < runs_[i].was_flown.size() && runs_[i].was_flown[position])
      return true;
  }
  return false;
}

bool model_vehicle::has_had_foreign_plan(std::size_t since_run) const {
  return std::any_of(runs_.begin() + static_cast<std::ptrdiff_t>(since_run), runs_.end(),
                     [](const model_run& each) { return each.is_foreign; });
}

bool model_vehicle::moves(std::uint16_t sequence) const {
  const auto position = position_at(plan_->map, sequence);
  if (!position)
    return false;
  const auto& item = plan_->map.items[*position];
  return item.first_nav_sequence && sequence >= *item.first_nav_sequence && sequence <= *item.last_nav_sequence;
}

mission_current model_vehicle::now_says() const {
  if (!plan_)
    return {};
  const auto how = is_complete_ ? mission_state::complete : is_active_ ? mission_state::active : mission_state::paused;
  return {
      .seq = sequence_, .total = plan_->map.total, .mission_state = io::mavlink::number(how), .mission_id = plan_->id};
}

void model_vehicle::begin_run(std::size_t plan) {
  runs_.push_back({plan, std::vector<bool>(plan_->map.items.size()), plan_->is_foreign});
  if (is_active_)
    pass_commands();
  reaches_at_ns_ =
      now_ns_ + draw_.between(longest_leg_ms_ * 2 / 3, longest_leg_ms_) * ms; // old news does not live so long
}

void model_vehicle::mark(std::uint16_t sequence) {
  const auto position = position_at(plan_->map, sequence);
  if (position && done_sequence(plan_->map.items[*position]) == sequence)
    runs_.back().was_flown[*position] = true;
}

// Commands take no time. After the last movement the mission is complete.
void model_vehicle::pass_commands() {
  const auto end = end_sequence(plan_->map);
  auto next = sequence_;
  while (next < end && !moves(next))
    mark(next++);
  if (next < end) {
    sequence_ = next;
    return;
  }
  sequence_ = static_cast<std::uint16_t>(end - 1);
  is_active_ = false;
  is_complete_ = true;
}

void model_vehicle::reach() {
  mark(sequence_);
  last_reached_ = sequence_;
  next_repetition_ns_ = now_ns_ + 1000 * ms;
  const bool is_behind = kind_.goes_on && draw_.one_in(2);
  send(reached_told{sequence_}, is_behind ? draw_.between(1, 650) : 0);
  if (sequence_ + 1 == end_sequence(plan_->map)) {
    is_active_ = false;
    is_complete_ = true;
  } else {
    ++sequence_;
    pass_commands();
  }
  reaches_at_ns_ = now_ns_ + draw_.between(longest_leg_ms_ / 3, longest_leg_ms_) * ms;
  say_current();
}

void model_vehicle::say_current() {
  if (says_still_ && now_ns_ >= says_until_ns_)
    says_still_.reset();
  send(current_told{says_still_ ? *says_still_ : now_says()}, 0, !says_still_);
  next_current_ns_ = now_ns_ + 1000 * ms;
}

void model_vehicle::send(const event& what, int delay_ms, bool is_true) {
  const heard message{what, run(), is_true};
  const auto happens = [&](int one_in) { return one_in > 0 && draw_.one_in(one_in); };
  if (happens(faults_.one_lost_in))
    return;
  if (happens(faults_.one_repeated_in))
    line_.push_back({now_ns_ + draw_.between(0, max_delay_ms) * ms, message});
  if (happens(faults_.one_late_in))
    delay_ms = draw_.between(0, max_delay_ms);
  line_.push_back({now_ns_ + delay_ms * ms, message});
}

} // namespace godwit::executor::progress::test
