#include "tests/actors/executor/progress/model_flight.hpp"

#include <algorithm>

#include "actors/executor/progress/patience.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"

namespace godwit::executor::progress::test {

namespace {

constexpr const char* mission_id = "m";

std::optional<std::uint32_t> id_of(const model_plan* plan) {
  return plan != nullptr && plan->id != 0 ? std::optional(plan->id) : std::nullopt;
}

std::string text_of(const event& happened) {
  return std::visit([]<class T>(const T& each) { return std::string(T::fields.type_name) + ' ' + io::to_json(each); },
                    happened);
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
  is_calm_ = false;
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
  is_calm_ = true;
  for (int i = 0; i < max_calm_turns && !is_done() && violation().empty(); ++i) {
    turn(100, 700);
    act_as_needed();
  }
  for (int i = 0; i < ending_turns; ++i)
    turn(500, 700);
  check_end();
}

// -- the executor -------------------------------------------------------------------------------------

void model_flight::turn(int ms_from, int ms_to) {
  now_ns_ += draw_.between(ms_from, ms_to) * ms;
  vehicle_.tick(now_ns_);
  for (const auto& each : vehicle_.take_due())
    hear(each);
  idle_turns_ = vehicle_.is_active() ? 0 : idle_turns_ + 1;
}

void model_flight::turn_of_chaos() {
  turn(50, 900);
  if (draw_.one_in(3))
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
    intend_new_plan(false);
  } else if (needs_start()) {
    intend_start(*first_to_fly());
  }
}

void model_flight::act_at_random() {
  const bool is_free = upload_ == upload_phase::none && start_ == start_phase::none && questions_.empty();
  switch (draw_.between(0, 12)) {
  case 0:
    return let_foreign_hand_upload();
  case 1:
    return restart_vehicle();
  case 2:
    return take(mission_aborted{});
  case 3:
    if (is_free && s_.plan)
      intend_same_plan();
    return;
  case 4:
  case 5:
  case 6:
    if (is_free && s_.plan && s_.paused != pause_reason::foreign_plan) {
      const auto position =
          static_cast<std::uint32_t>(draw_.between(0, static_cast<int>(s_.plan->map.items.size()) - 1));
      if (s_.plan->map.items[position].first_nav_sequence)
        intend_start(position);
    }
    return;
  default:
    if (is_free)
      intend_new_plan(true);
  }
}

bool model_flight::needs_upload() const {
  if (!s_.plan || s_.paused == pause_reason::foreign_plan)
    return true;
  const bool is_all_done = s_.plan->generation.is_finished || (idle_turns_ > patient_turns && !first_to_fly());
  return is_all_done && !s_.plan->map.ends_mission;
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
  if (s_.plan->ever_resolved < map.items.size())
    return map.items[s_.plan->ever_resolved].item_index;
  return map.items.back().item_index + 1;
}

std::optional<std::uint32_t> model_flight::first_to_fly() const {
  const auto& items = s_.plan->map.items;
  for (auto i = s_.plan->ever_resolved; i < items.size(); ++i)
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

void model_flight::intend_new_plan(bool is_new_revision) {
  const auto first = first_undone();
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
  intend_upload(map_from(first));
}

// An assignment that changes nothing: the vehicle is to fly the plan from its beginning.
void model_flight::intend_same_plan() {
  items_before_ = items_;
  upload_revision_ = revision_ + 1;
  intend_upload(s_.plan->map);
}

void model_flight::intend_upload(plan_map map) {
  const auto id = kind_.has_ids ? id_of_content(map) : 0;
  plans_.push_back({std::move(map), id, upload_revision_});
  if (!kind_.has_ids)
    vehicle_.hold();
  else if (id_of(vehicle_.plan()) == id)
    vehicle_.mark_run(); // what it flies during the upload counts for the new plan too
  upload_run_ = vehicle_.run();
  upload_ = upload_phase::intended;
  judge_.note("upload intended, revision " + std::to_string(upload_revision_));
  const assignment_key key{"a" + std::to_string(plans_.size()), "k"};
  take(upload_intended{upload_revision_, plans_.back().map, id_of(vehicle_.plan()), key});
  if (s_.upload)
    judge_.expect_answer(key.assignment_id);
  else
    end_upload();
}

std::uint32_t model_flight::id_of_content(const plan_map& map) {
  for (const auto& each : plans_)
    if (!each.is_foreign && each.map.items == map.items)
      return each.id;
  return ++next_id_;
}

void model_flight::go_on_with_upload() {
  if (upload_ == upload_phase::intended && draw_.one_in(8)) { // it failed
    upload_ = upload_phase::looked_at;
    take(upload_ended{draw_.one_in(2) ? upload_verdict::unchanged : upload_verdict::unknown, {}, "no space"});
    end_upload();
  } else if (upload_ == upload_phase::intended) {
    upload_ = upload_phase::switched;
    const auto& plan = plans_.back();
    if (id_of(vehicle_.plan()) == plan.id && (kind_.goes_on || vehicle_.is_active())) {
      vehicle_.keep(plan, plans_.size() - 1);
    } else {
      vehicle_.load(plan, plans_.size() - 1);
      upload_run_ = vehicle_.run();
    }
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
  } else if (std::holds_alternative<resolve_start>(question) && s_.start) {
    end_start();
  }
}

void model_flight::intend_start(std::uint32_t position) {
  const auto sequence = s_.plan->map.items[position].first_sequence;
  start_ = start_phase::intended;
  is_start_refused_ = draw_.one_in(10);
  take(start_intended{sequence, was_incomplete_, !last_sequence_ || *last_sequence_ > sequence});
  if (!s_.start)
    start_ = start_phase::none;
}

void model_flight::go_on_with_start() {
  if (start_ == start_phase::intended && !is_start_refused_ && vehicle_.plan() != nullptr &&
      has_sequence(vehicle_.plan()->map, s_.start->sequence)) {
    start_ = start_phase::executed;
    if (draw_.one_in(2))
      vehicle_.hold();
    vehicle_.jump(s_.start->sequence);
    start_run_ = vehicle_.run();
    return;
  }
  end_start();
}

void model_flight::end_start() {
  take(start_ended{start_ == start_phase::executed});
  if (!s_.start)
    start_ = start_phase::none;
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
  foreign.is_foreign = true;
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

// Where what the vehicle says counts, the judge knows it too.
void model_flight::hear(const heard& message) {
  const bool is_free = !s_.upload && !s_.start;
  const auto lost_before = lost_;
  take(message.what);
  const auto* current = std::get_if<current_told>(&message.what);
  if (current != nullptr) {
    using io::mavlink::mission_state;
    const auto state = current->message.mission_state;
    last_sequence_ = current->message.seq;
    was_incomplete_ = state != number(mission_state::unknown) && state != number(mission_state::complete);
  }
  if (lost_ != lost_before || current == nullptr || !message.is_true || !is_free || !s_.plan ||
      !s_.plan->generation.is_armed)
    return;
  if (is_over(s_.plan->generation.resolving_since_ns, now_ns_, settling_ns))
    judge_.see(current->message.seq, message.run);
}

void model_flight::take(const event& happened) {
  ++events_;
  if (notes_events_)
    judge_.note(std::to_string(now_ns_ / ms % 1'000'000) + " ms " + text_of(happened));
  if (!is_calm_ && draw_.one_in(one_event_in_crashes))
    return take_and_crash(happened);
  if (draw_.one_in(4) && !matters(s_, happened, now_ns_))
    return;
  dispatch(apply(s_, happened, now_ns_));
}

void model_flight::take_and_crash(const event& happened) {
  switch (draw_.between(0, 2)) {
  case 0: // the process dies before the event is handled, and the event with it
    ++lost_;
    return crash();
  case 1: { // the actor dies while it handles the event, which is put back
    auto unwritten = s_;
    static_cast<void>(apply(unwritten, happened, now_ns_));
    crash();
    dispatch(apply(s_, happened, now_ns_));
    if (std::holds_alternative<upload_intended>(happened))
      upload_ = upload_phase::intended; // nothing had been sent, and the intent is there now
    return;
  }
  default: { // the process dies when the new state and its effects are written, and lets them out when it is back
    const auto written = apply(s_, happened, now_ns_);
    crash();
    dispatch(written);
  }
  }
}

void model_flight::dispatch(const effects& all) {
  for (const auto& each : all) {
    if (const auto* report = std::get_if<mission::progress_report>(&each)) {
      open_generation(report->generation);
      judge_.take(*report);
    } else if (const auto* what = std::get_if<progress_event>(&each)) {
      note(*what);
    } else if (const auto* answer = std::get_if<assignment_answered>(&each)) {
      judge_.take(*answer);
    } else {
      questions_.push_back(each);
    }
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

void model_flight::note(const progress_event& what) {
  open_generation(what.generation);
  if (what.kind == progress_event_kind::generation_opened)
    is_not_at_start_ = false;
  else if (what.kind == progress_event_kind::not_at_start)
    is_not_at_start_ = true;
  judge_.note(std::string(io::name_of(what.kind)) + " g" + std::to_string(what.generation));
}

void model_flight::check_end() {
  if (!violation().empty())
    return;
  if (!s_.plan->generation.moved_to && !s_.plan->generation.complete_upto)
    judge_.end_generation();
  judge_.fail_if(!is_done(), "the mission is never complete");
  judge_.fail_if(!judge_.is_everything_answered(), "an assignment is never answered");
  for (const auto& each : items_)
    judge_.fail_if(!judge_.is_resolved(each.id), each.id + " was neither reached nor skipped");
}

bool model_flight::moves(const std::string& item) const {
  return std::any_of(items_.begin(), items_.end(),
                     [&](const model_item& each) { return each.id == item && each.movements > 0; });
}

} // namespace godwit::executor::progress::test
