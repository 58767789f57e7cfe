#include "programs/godwit-sim/vehicle/flight/mission_run.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "programs/godwit-sim/vehicle/flight/item_place.hpp"
#include "runtime/assert.hpp"

namespace godwit::sim {

using io::mavlink::mission_item_int;

namespace {

// A count that no mission lives to see; a float may hold more than an int.
constexpr float max_repeats = 32'767;

int repeats_of(const mission_item_int& jump) {
  if (jump.param2 < 0)
    return -1;
  return jump.param2 > 0 ? static_cast<int>(std::min(jump.param2, max_repeats)) : 0;
}

} // namespace

bool is_nav(const mission_item_int& item) { return item.command <= last_nav_command && item.command != nav_roi; }

void mission_run::take(std::vector<mission_item_int> items, int first_flown) {
  GODWIT_ASSERT(first_flown == 0 || first_flown == 1, "a plan begins at item 0, or at item 1 after home");
  items_ = std::move(items);
  first_flown_ = first_flown;
  last_ = -1;
  jumps_in_a_row_ = 0;
  enter(first_flown);
}

void mission_run::load(std::vector<mission_item_int> items, int first_flown) {
  forget_jumps();
  take(std::move(items), first_flown);
  state_ = run_state::idle;
}

void mission_run::replace(std::vector<mission_item_int> items, int first_flown, int current) {
  const bool was_running = state_ == run_state::running;
  take(std::move(items), first_flown);
  state_ = run_state::idle;
  if (current > first_flown && current < count())
    enter(current);
  if (was_running && !is_empty())
    state_ = run_state::running;
}

void mission_run::start(int first, int last) {
  GODWIT_ASSERT(first >= 0 && first < count() && !is_empty(), "a mission starts at one of its items");
  GODWIT_ASSERT(last < count() && (last < 0 || last >= first), "a mission ends at one of its items");
  last_ = last < 0 ? -1 : std::max(last, first_flown_);
  jumps_in_a_row_ = 0;
  if (state_ == run_state::completed)
    forget_jumps();
  enter(std::max(first, first_flown_));
  state_ = run_state::running;
  ++starts_;
}

void mission_run::stop() {
  enter(current_);
  state_ = run_state::idle;
}

bool mission_run::set_current(int sequence) {
  if (sequence < first_flown_ || sequence >= count())
    return false;
  if (last_ >= 0 && sequence > last_)
    last_ = -1;
  enter(sequence);
  if (state_ == run_state::completed)
    state_ = run_state::idle;
  return true;
}

const mission_item_int* mission_run::item() const {
  return state_ == run_state::running && !is_held_ ? &items_[static_cast<std::size_t>(current_)] : nullptr;
}

void mission_run::advance() {
  if (item() != nullptr && is_nav(*item()))
    jumps_in_a_row_ = 0;
  skip();
}

void mission_run::skip() {
  if (item() == nullptr)
    return;
  const auto next = find_next();
  if (next.to < 0) {
    enter(end() - 1);
    state_ = run_state::completed;
  } else if (next.pauses && has_nav_from(next.to)) {
    is_held_ = true;
  } else {
    if (counts_anew_)
      std::erase_if(jumps_taken_, [&](const auto& each) {
        return each.first > current_ && each.first < (next.jump >= 0 ? next.jump : next.to);
      });
    if (next.jump >= 0)
      count_jump(next.jump);
    enter(next.to);
  }
}

void mission_run::count_jump(int sequence) {
  ++jumps_taken_[sequence];
  ++jumps_in_a_row_;
}

int mission_run::commands_end() const {
  int sequence = current_ + 1;
  while (sequence < end() && !is_nav(items_[static_cast<std::size_t>(sequence)]) && !jump_target(sequence))
    ++sequence;
  return sequence;
}

bool mission_run::has_nav_from(int sequence) const {
  return std::any_of(items_.begin() + sequence, items_.begin() + end(), is_nav);
}

bool mission_run::goes_on() const {
  const auto next = find_next();
  return next.to >= 0 && !next.pauses;
}

mission_run::next_item mission_run::find_next() const {
  if (is_empty())
    return {};
  next_item found;
  const auto& from = items_[static_cast<std::size_t>(current_)];
  found.pauses = from.autocontinue == 0;
  int sequence = jump_target(current_) ? current_ : current_ + 1;
  for (; sequence < end(); ++sequence) {
    const auto& item = items_[static_cast<std::size_t>(sequence)];
    if (const auto target = jump_target(sequence)) {
      found.to = *target < end() ? *target : -1;
      found.jump = sequence;
      return found;
    }
    // After a NAV item stand the commands that were executed beside it.
    if (is_nav(item) || !is_nav(from)) {
      found.to = sequence;
      return found;
    }
    found.pauses = found.pauses || item.autocontinue == 0;
  }
  return found;
}

std::optional<int> mission_run::jump_target(int sequence) const {
  const auto& item = items_[static_cast<std::size_t>(sequence)];
  const auto repeats = repeats_of(item);
  const bool is_used_up = repeats >= 0 && taken(sequence) >= repeats;
  if (item.command != do_jump || is_used_up || jumps_in_a_row_ >= max_jumps_in_a_row)
    return std::nullopt;
  if (!(item.param1 >= static_cast<float>(first_flown_) && item.param1 < static_cast<float>(count())))
    return std::nullopt;
  return static_cast<int>(item.param1);
}

int mission_run::end() const { return last_ < 0 ? count() : last_ + 1; }

void mission_run::enter(int sequence) {
  current_ = sequence;
  is_held_ = false;
  ++changes_;
}

int mission_run::taken(int jump) const {
  const auto found = jumps_taken_.find(jump);
  return found == jumps_taken_.end() ? 0 : found->second;
}

} // namespace godwit::sim
