#include <gtest/gtest.h>

#include "tests/actors/executor/progress/model_flight.hpp"

#include <algorithm>

#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::executor::progress::test {

namespace {

constexpr const char* mission_id = "m";

std::optional<std::uint32_t> id_of(const model_plan* plan) {
  return plan != nullptr && plan->id != 0 ? std::optional(plan->id) : std::nullopt;
}

} // namespace

model_flight::model_flight(std::uint64_t seed, const flavour& which)
    : kind_(which), draw_(seed), vehicle_(which, draw_), judge_(vehicle_, plans_) {
  const int count = draw_.between(1, 5);
  for (int i = 0; i < count; ++i)
    items_.push_back(new_item(i + 1 == count));
  take(mission_opened{mission_id, 1});
}

void model_flight::play() {
  const auto one_in = [&] { return draw_.one_in(3) ? 0 : draw_.between(2, 10); };
  vehicle_.set_faults({one_in(), one_in(), one_in()});
  for (int i = 0; i < chaos_turns && violation().empty(); ++i)
    turn_of_chaos();
  finish_calmly();
}

void model_flight::play_calmly() {
  vehicle_.set_longest_leg_ms(9000); // no item is reached so early that it might be old news
  finish_calmly();
}

void model_flight::finish_calmly() {
  vehicle_.set_faults({});
  for (int i = 0; i < max_calm_turns && !is_done() && violation().empty(); ++i) {
    turn(100, 700);
    act_as_needed();
  }
  check_end();
}

// -- the executor -------------------------------------------------------------------------------------

void model_flight::turn(int ms_from, int ms_to) {
  now_ns_ += draw_.between(ms_from, ms_to) * ms;
  vehicle_.tick(now_ns_);
  for (const auto& each : vehicle_.take_due())
    take(each);
  idle_turns_ = vehicle_.is_active() ? 0 : idle_turns_ + 1;
}

void model_flight::turn_of_chaos() {
  turn(50, 900);
  if (draw_.one_in(40))
    crash();
  else if (draw_.one_in(3))
    act_as_needed();
  else if (draw_.one_in(6))
    act_at_random();
}

void model_flight::act_as_needed() {
  if (!questions_.empty()) {
    const auto question = questions_.front();
    questions_.erase(questions_.begin());
    answer(question);
  } else if (upload_ != upload_phase::none) {
    go_on_with_upload();
  } else if (start_ != start_phase::none) {
    go_on_with_start();
  } else if (needs_upload()) {
    intend_upload(false);
  } else if (needs_start()) {
    intend_start(*first_to_fly());
  }
}

void model_flight::act_at_random() {
  const bool is_free = upload_ == upload_phase::none && start_ == start_phase::none && questions_.empty();
  switch (draw_.between(0, 7)) {
  case 0:
    return let_foreign_hand_upload();
  case 1:
    return restart_vehicle();
  case 2:
  case 3:
    if (is_free && s_.plan && s_.paused != pause_reason::foreign_plan) {
      const auto position =
          static_cast<std::uint32_t>(draw_.between(0, static_cast<int>(s_.plan->map.items.size()) - 1));
      if (s_.plan->map.items[position].first_nav_sequence)
        intend_start(position);
    }
    return;
  default:
    if (is_free)
      intend_upload(true);
  }
}

bool model_flight::needs_upload() const {
  return !s_.plan || s_.paused == pause_reason::foreign_plan ||
         (s_.plan->generation.is_finished && !s_.plan->map.ends_mission);
}

bool model_flight::needs_start() const {
  return first_to_fly() && (s_.paused || is_not_at_start_ || idle_turns_ > patient_turns);
}

bool model_flight::is_done() const {
  return upload_ == upload_phase::none && start_ == start_phase::none && judge_.is_complete(revision_);
}

std::uint32_t model_flight::first_undone() const {
  if (!s_.plan)
    return 0;
  const auto& map = s_.plan->map;
  if (s_.plan->ever_settled < map.items.size())
    return map.items[s_.plan->ever_settled].item_index;
  return map.items.back().item_index + 1;
}

std::optional<std::uint32_t> model_flight::first_to_fly() const {
  const auto& items = s_.plan->map.items;
  for (auto i = s_.plan->ever_settled; i < items.size(); ++i)
    if (items[i].first_nav_sequence)
      return i;
  return std::nullopt;
}

model_flight::model_item model_flight::new_item(bool must_move) {
  model_item result{"i" + std::to_string(next_item_++), draw_.one_in(3) ? 1 : 0, draw_.one_in(4) ? 2 : 1};
  if (!must_move && draw_.one_in(5))
    result.movements = 0;
  return result;
}

// From the item FIRST of the mission on, as far as the last one or one before it that moves the vehicle.
plan_map model_flight::map_from(std::size_t first) {
  auto end = items_.size();
  if (draw_.one_in(4))
    for (auto i = first + 1; i < items_.size(); ++i)
      if (items_[i - 1].movements > 0 && draw_.one_in(2))
        end = i;
  auto next = kind_.first_sequence;
  plan_map map{.first_sequence = next, .start_sequence = next, .ends_mission = end == items_.size(), .items = {}};
  for (auto i = first; i < end; ++i) {
    const auto& each = items_[i];
    const auto count = static_cast<std::uint16_t>(each.commands_in_front + each.movements);
    mapped_item item{each.id, static_cast<std::uint32_t>(i), next, count, {}, {}};
    if (each.movements > 0) {
      item.first_nav_sequence = static_cast<std::uint16_t>(next + each.commands_in_front);
      item.last_nav_sequence = static_cast<std::uint16_t>(next + count - 1);
    }
    map.items.push_back(item);
    next = static_cast<std::uint16_t>(next + count);
  }
  map.total = static_cast<std::uint16_t>(next - kind_.first_sequence);
  return map;
}

void model_flight::intend_upload(bool is_new_revision) {
  auto first = first_undone();
  items_before_ = items_;
  upload_revision_ = revision_;
  if (is_new_revision || first >= items_.size()) {
    ++upload_revision_;
    const auto kept = std::min<std::size_t>(items_.size(), first + (draw_.one_in(2) ? 1U : 0U));
    items_.resize(kept);
    const int more = draw_.between(1, 3);
    for (int i = 0; i < more; ++i)
      items_.push_back(new_item(i + 1 == more));
  }
  plans_.push_back({map_from(first), kind_.has_ids ? ++next_id_ : 0, upload_revision_});
  if (!kind_.has_ids)
    vehicle_.hold();
  upload_ = upload_phase::intended;
  judge_.note("upload intended, revision " + std::to_string(upload_revision_));
  take(upload_intended{upload_revision_, plans_.back().map, id_of(vehicle_.plan()),
                       assignment_key{"a" + std::to_string(plans_.size()), "k"}});
}

void model_flight::go_on_with_upload() {
  if (upload_ == upload_phase::intended && draw_.one_in(8)) { // it failed
    upload_ = upload_phase::looked_at;
    take(upload_ended{draw_.one_in(2) ? upload_verdict::unchanged : upload_verdict::unknown, {}, "no space"});
    end_upload();
  } else if (upload_ == upload_phase::intended) {
    upload_ = upload_phase::switched;
    vehicle_.load(plans_.back(), plans_.size() - 1);
    upload_run_ = vehicle_.run();
  } else if (upload_ == upload_phase::switched && draw_.one_in(6)) { // the acknowledgement was lost
    upload_ = upload_phase::looked_at;
    take(upload_ended{upload_verdict::unknown, {}, "timed out"});
  } else if (upload_ == upload_phase::switched) {
    take(upload_ended{upload_verdict::accepted, id_of(&plans_.back()), {}});
    end_upload();
  }
}

void model_flight::end_upload() {
  if (s_.upload)
    return;
  upload_ = upload_phase::none;
  const bool came = s_.mission->revision == upload_revision_ && s_.plan && s_.plan->map == plans_.back().map;
  if (came)
    revision_ = upload_revision_;
  else
    items_ = items_before_;
}

void model_flight::answer(const effect& question) {
  if (std::holds_alternative<look_at_vehicle>(question) && s_.upload) {
    take(vehicle_looked_at{id_of(vehicle_.plan())});
    end_upload();
  } else if (std::holds_alternative<read_plan_back>(question) && s_.upload) {
    const auto* held = vehicle_.plan();
    const bool is_pending = held != nullptr && held->map == plans_.back().map && held->id == plans_.back().id;
    const bool is_before = held == nullptr || (s_.plan && held->map == s_.plan->map);
    take(plan_read_back{is_pending  ? read_back_match::pending
                        : is_before ? read_back_match::before
                                    : read_back_match::other});
    end_upload();
  } else if (std::holds_alternative<settle_start>(question) && s_.start) {
    const bool is_executed = start_ == start_phase::executed;
    start_ = start_phase::none;
    take(start_ended{is_executed});
  }
}

void model_flight::intend_start(std::uint32_t position) {
  const auto sequence = s_.plan->map.items[position].first_sequence;
  start_ = start_phase::intended;
  is_start_refused_ = draw_.one_in(10);
  take(start_intended{sequence});
}

void model_flight::go_on_with_start() {
  if (start_ == start_phase::intended && !is_start_refused_ && vehicle_.plan() != nullptr &&
      has_sequence(vehicle_.plan()->map, s_.start->sequence)) {
    start_ = start_phase::executed;
    vehicle_.jump(s_.start->sequence);
    start_run_ = vehicle_.run();
    return;
  }
  const bool is_executed = start_ == start_phase::executed;
  start_ = start_phase::none;
  take(start_ended{is_executed});
}

// What is in the mailbox is lost, the state is read from the disk, an upload that has not ended is dead.
void model_flight::crash() {
  judge_.note("crash");
  if (draw_.one_in(2))
    vehicle_.cut_line();
  state read;
  const auto result = io::read_json(nlohmann::json::parse(io::to_json(s_)), read);
  judge_.fail_if(!result || !io::equal(read, s_), "the state does not survive its JSON form");
  s_ = std::move(read);
  questions_ = resume(s_);
  if (upload_ != upload_phase::none)
    upload_ = upload_phase::looked_at;
}

void model_flight::let_foreign_hand_upload() {
  if (upload_ != upload_phase::none || start_ != start_phase::none || vehicle_.plan() == nullptr)
    return;
  judge_.note("foreign hand");
  model_plan foreign{*vehicle_.plan()};
  foreign.id = kind_.has_ids ? ++next_id_ : 0;
  foreign.map.items.push_back({"foreign", 999, end_sequence(foreign.map), 20, end_sequence(foreign.map),
                               static_cast<std::uint16_t>(end_sequence(foreign.map) + 19)});
  foreign.map.total = static_cast<std::uint16_t>(foreign.map.total + 20);
  plans_.push_back(foreign);
  vehicle_.load(foreign, plans_.size() - 1);
}

void model_flight::restart_vehicle() {
  if (upload_ == upload_phase::switched || start_ == start_phase::executed)
    return;
  vehicle_.reboot();
  take(vehicle_rebooted{});
}

// -- what it says -------------------------------------------------------------------------------------

void model_flight::take(const event& happened) {
  ++events_;
  if (draw_.one_in(4) && !matters(s_, happened, now_ns_))
    return;
  for (const auto& each : handle(s_, happened, now_ns_)) {
    if (const auto* report = std::get_if<mission::progress_report>(&each))
      check(*report);
    else if (const auto* what = std::get_if<news>(&each))
      hear(*what);
    else if (!std::holds_alternative<assignment_answered>(each))
      questions_.push_back(each);
  }
}

// A report of the generation can come in front of the news of its opening.
void model_flight::open_generation(std::uint32_t number) {
  if (judge_.is_open(number) || !s_.plan || s_.plan->generation.number != number)
    return;
  const bool is_upload = upload_ != upload_phase::none;
  judge_.open(number, is_upload ? plans_.size() - 1 : judge_.plan_of(number - 1), is_upload ? upload_run_ : start_run_,
              s_.plan->generation.start_sequence);
}

void model_flight::hear(const news& what) {
  open_generation(what.generation);
  if (what.kind == news_kind::generation_opened)
    is_not_at_start_ = false;
  else if (what.kind == news_kind::not_at_start)
    is_not_at_start_ = true;
  judge_.note(std::string(io::name_of(what.kind)) + " g" + std::to_string(what.generation));
}

void model_flight::check(const mission::progress_report& report) {
  open_generation(report.generation);
  judge_.take(report);
}

void model_flight::check_end() {
  if (!violation().empty())
    return;
  judge_.fail_if(!is_done(), "the mission is never complete");
  for (const auto& each : items_)
    judge_.fail_if(!judge_.is_settled(each.id), each.id + " was neither reached nor skipped");
}

bool model_flight::moves(const std::string& item) const {
  return std::any_of(items_.begin(), items_.end(),
                     [&](const model_item& each) { return each.id == item && each.movements > 0; });
}

} // namespace godwit::executor::progress::test
