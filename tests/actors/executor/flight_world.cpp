#include "tests/actors/executor/flight_world.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "actors/executor/remaining.hpp"
#include "actors/executor/station_plan.hpp"
#include "actors/failsafe/first_look.hpp"
#include "actors/failsafe/vehicle_texts.hpp"
#include "io/fields/field_table.hpp"
#include "io/fields/json_text.hpp"
#include "io/fields/json_value.hpp"
#include "io/mavlink/messages.hpp"
#include "runtime/assert.hpp"

namespace godwit::tests {
namespace {

constexpr std::int64_t executor_period_ns = 200'000'000;
constexpr std::int64_t late_ms = 1'500;
// Frames from anybody else than the vehicle do not reach vehicle_link here, and its requests have numbers of ours.
constexpr io::link::peer_id line = 1;

template <class... M>
std::optional<std::uint8_t> target_in(const io::mavlink::frame_view& frame) {
  std::optional<std::uint8_t> result;
  ((frame.id() == M::message_id ? void(result = io::mavlink::decode<M>(frame).target_system) : void()), ...);
  return result;
}

// Of the messages that change or ask something; 0 means all.
bool names_another(const io::mavlink::frame_view& frame) {
  using namespace io::mavlink;
  const auto target =
      target_in<command_long, command_int, set_mode, mission_count, mission_item_int, mission_ack, mission_request_list,
                mission_request_int, mission_clear_all, mission_set_current, request_data_stream>(frame);
  return target && *target > 1;
}

// Requests of the failsafe have numbers above those of the executor.
constexpr std::uint64_t first_of_failsafe = 1ULL << 40U;

} // namespace

flight_world::flight_world(const options& wanted)
    : who_(wanted.who), map_(wanted.map), failsafe_settings_(wanted.failsafe), link_(new_link()),
      test_rng_(wanted.seed), lost_(wanted.lost), doubled_(wanted.doubled), late_(wanted.late),
      most_delay_ms_(wanted.most_delay_ms), keeps_order_(wanted.keeps_order) {
  if (wanted.asks_next)
    settings_.vehicle_id = "bird-1";
  else if (wanted.has_service)
    settings_.mission_id = short_mission(wanted.who).mission_id;
  settings_.has_service = wanted.has_service;
  settings_.start = wanted.start;
  settings_.arm_on_start = wanted.arm_on_start;
  settings_.takeoff_again = wanted.takeoff_again;
  settings_.refused_inserts = wanted.refused_inserts;
  settings_.changes_need_service = wanted.changes_need_service;
  settings_.service_wait_ms = wanted.service_wait_ms;
  settings_.deleted_mission = wanted.deleted_mission;
  settings_.shows_home = wanted.shows_home;
  settings_.brings_last_line = wanted.brings_last_line;
  settings_.marks_landings = wanted.marks_landings;
  settings_.checks.asks_for_straight_return = true;
  settings_.drain_percent_per_min = wanted.drain_percent_per_min;
  sim::vehicle_settings vehicle;
  vehicle.who = wanted.who;
  vehicle.speed = wanted.speed;
  vehicle.battery_percent = wanted.battery_percent;
  vehicle.endurance_s = wanted.endurance_s;
  vehicle.holds_when_landed = wanted.holds_when_landed;
  vehicle.rtl_autoland = wanted.rtl_autoland;
  vehicle.has_payload = wanted.has_payload;
  vehicle_ = std::make_unique<sim::vehicle>(vehicle, time_.now_ns(), [this](std::span<const std::byte> frame) {
    if (!is_vehicle_silent_)
      hear(frame);
  });
  if (wanted.is_person_on_other_line)
    persons_line_ =
        vehicle_->add_line([this](std::span<const std::byte> frame) { person_.receive(frame); }, time_.now_ns());
  core_ = std::make_unique<executor::core>(settings_, state_);
  failsafe_ = std::make_unique<failsafe::core>(failsafe_settings_, record_, failsafe_now());
  begin_link();
  begin_executor(true);
}

std::unique_ptr<vehicle_link::core> flight_world::new_link() const {
  return std::make_unique<vehicle_link::core>(vehicle_link::settings{}, io::mavlink::signing_settings{},
                                              io::mavlink::signing_time{}, kept_);
}

void flight_world::begin_link() {
  take(link_->on_link(io::link::link_status{io::link::link_phase::up, {}, 0}, link_now()));
}

void flight_world::begin_executor(bool is_new_process) {
  core_->on_host_status(host_status());
  core_->on_failsafe_status(failsafe_->told());
  take(core_->on_start(is_new_process));
  run_until_idle();
}

executor::host_status flight_world::host_status() const {
  executor::host_status result;
  result.journal = {true, true, is_journal_nearly_full_, 10ULL << 30U};
  result.actors = {{"vehicle_link", true}};
  return result;
}

void flight_world::set_journal_nearly_full(bool is_so) {
  is_journal_nearly_full_ = is_so;
  core_->on_host_status(host_status());
}

void flight_world::load(const mission::document& what) {
  mission_client::mission_loaded loaded;
  loaded.document = what;
  take(core_->on_mission(loaded, now()));
  tell_map(what.mission_id);
  run_until_idle();
}

void flight_world::pull_map(mission_client::pull_state outcome) {
  map_ = outcome;
  if (state_.mission)
    tell_map(state_.mission->mission_id);
  run_until_idle();
}

// A pull that has not begun is not spoken of.
void flight_world::tell_map(const std::string& mission_id) {
  if (map_ != mission_client::pull_state::not_started)
    take(core_->on_map({mission_id, map_, 0, 0, {}}, now()));
}

void flight_world::assign(const mission::assignment& assignment) {
  take(core_->on_assignment({state_.mission->mission_id, assignment}, now()));
  run_until_idle();
}

void flight_world::delete_mission(const std::string& id) {
  take(core_->on_deleted({id}, now()));
  run_until_idle();
}

void flight_world::refuse_mission(mission_client::refusal why) {
  take(core_->on_refused({settings_.mission_id, why, "as the test wants it", {}}, now()));
  run_until_idle();
}

operators::answer flight_world::say(operators::command_kind what) {
  operators::command command;
  command.kind = what;
  return say(command);
}

operators::answer flight_world::say(const operators::command& what) {
  auto said = what;
  said.by = "test";
  auto answer = core_->on_operator(said, now());
  run_until_idle();
  return answer;
}

// As mission_client does it: a service that is silent for 2 s is one whose answer is not known.
void flight_world::take_change(const std::string& key, bool is_flown, const std::optional<std::string>& after,
                               const std::vector<mission::item>& items, bool keeps_rest) {
  if (is_flown)
    return flown_changes_.push_back({key, reports_.size(), time_.now_ns()});
  asked_changes_.push_back({key, reports_.size(), time_.now_ns()});
  if (!is_service_silent_)
    return change_mission(key, after, items, keeps_rest);
  constexpr std::int64_t window_ns = 2'000'000'000;
  time_.at(time_.now_ns() + window_ns,
           [this, key] { answer_change(key, mission_client::change_verdict::unknown, "it did not answer"); });
}

void flight_world::answer_change(const std::string& key, mission_client::change_verdict verdict,
                                 const std::string& reason) {
  take(core_->on_change({key, verdict, reason}, now()));
  run_until_idle();
}

// As a missions service does it: another revision, and then the answer.
void flight_world::change_mission(const std::string& key, const std::optional<std::string>& after,
                                  const std::vector<mission::item>& items, bool keeps_rest) {
  mission_client::change_outcome answer{key, change_answer_, {}};
  auto revised = *state_.mission;
  if (answer.verdict == mission_client::change_verdict::done) {
    service_revision_ = std::max(service_revision_, revised.revision) + 1;
    revised.revision = service_revision_;
    const auto first = executor::first_remaining(revised, after);
    const std::vector rest(revised.items.begin() + static_cast<std::ptrdiff_t>(first), revised.items.end());
    revised.items.resize(first);
    revised.items.insert(revised.items.end(), items.begin(), items.end());
    if (keeps_rest)
      revised.items.insert(revised.items.end(), rest.begin(), rest.end());
  } else {
    answer.reason = "the service will not have it";
  }
  time_.at(time_.now_ns() + 50'000'000, [this, answer, revised] {
    if (answer.verdict == mission_client::change_verdict::done)
      load(revised);
    take(core_->on_change(answer, now()));
    run_until_idle();
  });
}

// What a new incarnation finds is what was written: through the form in which it is.
void flight_world::restore() {
  const auto written = nlohmann::json::parse(io::to_json(state_));
  state_ = {};
  const auto read = io::read_json(written, state_);
  GODWIT_ASSERT(read.has_value(), "the record can be read");
}

std::vector<executor::phase_machine::counts>& flight_world::all_transitions() {
  static std::vector<executor::phase_machine::counts> result(executor::phase_table().size());
  return result;
}

executor::core::ruling_counts& flight_world::all_decisions() {
  static executor::core::ruling_counts result{};
  return result;
}

void flight_world::end_core() {
  for (std::size_t i = 0; i < all_decisions().size(); ++i)
    all_decisions()[i] += core_->decided()[i];
  const auto& taken = core_->phases().taken();
  for (std::size_t row = 0; row < taken.size(); ++row)
    for (std::size_t from = 0; from < taken[row].size(); ++from)
      all_transitions()[row][from] += taken[row][from];
}

bool flight_world::acknowledge() {
  const auto awaits = [&] { return state_.preflight.now == executor::preflight::phase::awaiting_ack; };
  if (!run_until(awaits, 60))
    return false;
  operators::command command;
  command.kind = operators::command_kind::acknowledge;
  command.report = state_.preflight.report->id;
  return say(command).is_taken;
}

void flight_world::crash() {
  asked_.clear(); // nobody waits for the answers
  looks_.clear();
  notes_.clear();
  news_.clear();
  restore();
  end_core();
  core_ = std::make_unique<executor::core>(settings_, state_);
  take(core_->on_connection(link_->describe(link_now()), now()));
  begin_executor(false);
}

void flight_world::crash_failsafe() {
  failsafe_ = std::make_unique<failsafe::core>(failsafe_settings_, record_, failsafe_now());
  core_->on_failsafe_status(failsafe_->told());
  run_until_idle();
}

void flight_world::crash_link() {
  ++link_age_;
  link_ = new_link();
  begin_link();
  for (const auto& [number, is_transfer] : std::exchange(asked_, {}))
    if (is_transfer) {
      vehicle_link::transfer::outcome outcome;
      outcome.reason = "vehicle_link did not answer";
      take(core_->on_transfer(number, outcome, now()));
    } else {
      vehicle_link::command_outcome outcome;
      outcome.verdict = vehicle_link::command_verdict::timed_out;
      take(core_->on_command(number, outcome, now()));
    }
  for (const auto number : std::exchange(looks_, {}))
    take(core_->on_looked(number, {false, 0, "vehicle_link did not answer"}, now()));
  run_until_idle();
}

void flight_world::crash_all() {
  asked_.clear();
  looks_.clear();
  notes_.clear();
  news_.clear();
  restore();
  ++link_age_;
  link_ = new_link();
  failsafe_ = std::make_unique<failsafe::core>(failsafe_settings_, record_, failsafe_now());
  end_core();
  core_ = std::make_unique<executor::core>(settings_, state_);
  begin_link();
  begin_executor(true);
}

void flight_world::cut_line(double seconds) {
  cut_until_ns_ = time_.now_ns() + static_cast<std::int64_t>(seconds * 1e9);
}

void flight_world::deafen(double seconds) {
  deaf_until_ns_ = time_.now_ns() + static_cast<std::int64_t>(seconds * 1e9);
}

// -- the failsafe -----------------------------------------------------------------------------------

void flight_world::tick_failsafe() {
  failsafe_due_ns_ = time_.now_ns() + failsafe::tick_ms * failsafe::ns_per_ms;
  take(failsafe_->tick(failsafe_now()));
}

void flight_world::take(const failsafe::effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { take(what); }, each);
}

// After the failsafe_status that says whose it is, as the actor does it.
void flight_world::take(const failsafe::command_vehicle& each) {
  core_->on_failsafe_status(failsafe_->told());
  reactions_.push_back(each);
  if (const auto words = failsafe::words_for(each, owner_))
    take(link_->on_command(first_of_failsafe + each.number, *words, link_now()));
}

void flight_world::take(const failsafe::failsafe_status_changed& each) { core_->on_failsafe_status(each.now); }

void flight_world::take(const failsafe::guard_resolved& each) {
  take(core_->on_guarded(each.request_id, each.answer, true, now()));
}

void flight_world::take(const failsafe::remember& each) {
  static_cast<void>(failsafe::durable_core::apply(record_, each.what, now().wall_ns));
}

void flight_world::take(const executor::send_to_failsafe& each) {
  std::visit([this](const auto& what) { failsafe_->take(what, failsafe_now()); }, each.what);
  tick_failsafe();
}

// -- time -------------------------------------------------------------------------------------------

// As the actors do it, at each change.
void flight_world::keep_vehicle() {
  auto [wanted, kept] = link_->on_keep_vehicle({core_->keeps_vehicle()}, link_now());
  if (kept)
    kept_ = kept->who;
  take(wanted);
}

void flight_world::step() {
  if (core_->wants_service()) {
    mission_client::service_status status;
    status.mission_id = state_.mission->mission_id;
    status.pull = map_;
    core_->on_service(status);
  }
  const auto next = std::min({time_.now_ns() + executor_period_ns, failsafe_due_ns_, vehicle_->next_deadline_ns(),
                              link_->next_deadline_ns(), time_.next_ns()});
  still_ = next <= time_.now_ns() ? still_ + 1 : 0;
  GODWIT_ASSERT(still_ < 1'000, "time stands still: vehicle " + std::to_string(vehicle_->next_deadline_ns()) +
                                    ", link " + std::to_string(link_->next_deadline_ns()) + ", line " +
                                    std::to_string(time_.next_ns()) + ", phase " +
                                    std::string(io::name_of(link_->describe(link_now()).phase)) + ", now " +
                                    std::to_string(time_.now_ns()));
  time_.advance_to(next);
  while (time_.next_ns() <= time_.now_ns())
    time_.run_next();
  vehicle_->on_time(time_.now_ns());
  while (person_.answer()) {
  }
  take(link_->on_time(link_now()));
  keep_vehicle();
  if (failsafe_due_ns_ <= time_.now_ns())
    tick_failsafe();
  run_until_idle();
}

// The line between link and vehicle, with its faults.
void flight_world::carry(
    std::span<const std::byte> frame,
    std::function<void(const std::vector<std::byte>&)> deliver) { // NOLINT(performance-unnecessary-value-param): kept
  const auto falls = [&](double share) {
    return share > 0 && std::uniform_real_distribution<>(0, 1)(test_rng_) < share;
  };
  if (time_.now_ns() < cut_until_ns_ || falls(lost_))
    return;
  const std::vector<std::byte> bytes(frame.begin(), frame.end());
  for (int copies = falls(doubled_) ? 2 : 1; copies > 0; --copies) {
    const auto delay_ms =
        most_delay_ms_ <= 1 ? 1 : std::uniform_int_distribution<std::int64_t>(1, most_delay_ms_)(test_rng_);
    const std::int64_t held_ms = falls(late_) ? late_ms : 0;
    auto at_ns = time_.now_ns() + (delay_ms + held_ms) * 1'000'000;
    if (keeps_order_)
      at_ns = newest_arrival_ns_ = std::max(at_ns, newest_arrival_ns_);
    time_.at(at_ns, [bytes, deliver] { deliver(bytes); });
  }
}

// What is noted is applied one by one, and then the core goes on.
void flight_world::run_until_idle() {
  for (;;) {
    while (!notes_.empty()) {
      const auto next = std::move(notes_.front());
      notes_.pop_front();
      const auto effects = executor::durable_core::apply(state_, next, now().wall_ns);
      core_->on_applied();
      for (const auto& each : effects)
        dispatch(each);
    }
    if (!news_.empty()) {
      const auto tell = std::move(news_.front());
      news_.pop_front();
      tell();
      continue;
    }
    const auto wanted = core_->advance(now());
    if (wanted.empty())
      break;
    take(wanted);
  }
  take(core_->tell_stations(now()));
}

void flight_world::take_report(const mission::progress_report& report) {
  reports_.push_back(report);
  if (const auto reached = executor::reached_shown(state_, report, settings_.shows_home))
    shown_reached_.push_back(reached->sequence);
}

std::uint64_t flight_world::station_commands(executor::act_kind what, executor::station by) {
  const executor::station_act act{what, by, std::string(io::name_of(what)), ++last_act_, true};
  auto [wanted, answer] = core_->on_station(act, now());
  take(wanted);
  run_until_idle();
  last_act_answer_ = answer;
  return last_act_;
}

void flight_world::take(const executor::send_to_port& each) {
  if (const auto* plan = std::get_if<ground_port::set_mission>(&each.what)) {
    shown_items_ = plan->items;
    ++times_shown_;
  }
  if (const auto* verdict = std::get_if<ground_port::plan_judged>(&each.what))
    judged_.push_back(*verdict);
  if (const auto* resolved = std::get_if<executor::act_resolved>(&each.what))
    resolved_acts_.push_back(*resolved);
  const auto* progress = std::get_if<ground_port::mission_progress>(&each.what);
  const auto is_news = [&] {
    const auto& last = shown_progress_.back();
    return last.current != progress->current || last.state != progress->state || last.plan_id != progress->plan_id;
  };
  if (progress != nullptr && (shown_progress_.empty() || is_news()))
    shown_progress_.push_back(*progress);
}

void flight_world::dispatch(const executor::durable_core::effect& each) {
  std::visit(
      [this]<class M>(const M& m) {
        if constexpr (std::is_same_v<M, mission_client::report_progress>)
          take_report(m.report);
        else if constexpr (std::is_same_v<M, mission_client::respond_to_assignment>)
          answers_.push_back(m);
        else if constexpr (std::is_same_v<M, mission_client::insert_waypoint>)
          take_change(m.insert.idempotency_key, m.is_flown, m.insert.after_item_id, {m.insert.waypoint}, true);
        else if constexpr (std::is_same_v<M, mission_client::replace_tail>)
          take_change(m.tail.idempotency_key, m.is_flown, m.tail.after_item_id, m.tail.items, false);
        else if constexpr (std::is_same_v<M, executor::start_answer>)
          start_answers_.push_back(m);
        else if constexpr (std::is_same_v<M, ground_port::plan_judged>)
          judged_.push_back(m);
        else if constexpr (std::is_same_v<M, executor::phase_status>)
          said_.push_back(std::to_string(time_.now_ns() / 1'000'000) + " ms: " + std::string(io::name_of(m.now)) +
                          (m.reason.empty() ? "" : ": " + m.reason));
        else if constexpr (std::is_same_v<M, executor::preflight::phase_changed>)
          said_.push_back("preflight " + m.sentence);
        else if constexpr (requires { core_->on_news(m, now()); })
          news_.emplace_back([this, m] { take(core_->on_news(m, now())); });
      },
      each);
}

// -- the executor's wishes --------------------------------------------------------------------------

void flight_world::take(const executor::effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { take(what); }, each);
}

void flight_world::take(const executor::order& each) {
  if (!each.expected.empty())
    take(executor::send_to_failsafe{failsafe::expect_mode{each.expected, flight::order_is_expected_ns / 1'000'000}});
  const bool stands_by = state_.doing && state_.doing->kind == executor::task_kind::stand_by;
  const bool changes_nothing = std::holds_alternative<failsafe::guard_mission>(each.what) ||
                               std::holds_alternative<vehicle_link::download_plan>(each.what) ||
                               std::holds_alternative<vehicle_link::look>(each.what);
  const bool is_last_line = each.number >= executor::first_of_last_line;
  last_line_orders_ += is_last_line ? 1 : 0;
  orders_ += stands_by || changes_nothing || is_last_line ? 0 : 1;
  if (std::holds_alternative<vehicle_link::look>(each.what)) {
    looks_.insert(each.number);
    return take(link_->on_look(each.number, link_now()));
  }
  if (!std::holds_alternative<failsafe::guard_mission>(each.what))
    asked_[each.number] = std::holds_alternative<vehicle_link::upload_plan>(each.what) ||
                          std::holds_alternative<vehicle_link::download_plan>(each.what);
  std::visit(
      [&]<class M>(const M& what) {
        if constexpr (std::is_same_v<M, failsafe::guard_mission>) {
          failsafe_->take(failsafe::asked_guard{each.number, what}, failsafe_now());
          tick_failsafe();
        } else if constexpr (std::is_same_v<M, vehicle_link::send_command>) {
          const bool is_starting = state_.doing && state_.doing->kind == executor::task_kind::start;
          const bool is_px4 = owner_.autopilot == io::mavlink::mav_autopilot::px4;
          starts_ +=
              what.command == io::mavlink::number(io::mavlink::mav_cmd::mission_start) ||
                      (is_px4 && is_starting && what.command == io::mavlink::number(io::mavlink::mav_cmd::do_set_mode))
                  ? 1
                  : 0;
          const auto arm_disarm = io::mavlink::number(io::mavlink::mav_cmd::component_arm_disarm);
          arms_ += what.command == arm_disarm && what.param1 == 1 ? 1 : 0;
          disarms_ += what.command == arm_disarm && what.param1 == 0 ? 1 : 0;
          if (stands_by)
            ++stand_bys_;
          else
            commands_.push_back(what.command);
          take(link_->on_command(each.number, what, link_now()));
        } else if constexpr (std::is_same_v<M, vehicle_link::set_current_item>) {
          take(link_->on_set_current(each.number, what, link_now()));
        } else if constexpr (std::is_same_v<M, vehicle_link::upload_plan>) {
          take(link_->on_upload(each.number, what, link_now()));
        } else if constexpr (std::is_same_v<M, vehicle_link::download_plan>) {
          take(link_->on_download(each.number, what, link_now()));
        }
      },
      each.what);
}

void flight_world::take(const executor::send_to_client& each) {
  begins_ += std::holds_alternative<mission_client::begin_mission>(each.what) ? 1 : 0;
  if (std::holds_alternative<mission_client::pull_map>(each.what)) {
    ++pulls_;
    map_ = mission_client::pull_state::in_flight; // until the test says how it ends
  }
  accepted_copies_ += std::holds_alternative<mission_client::accept_copy>(each.what) ? 1 : 0;
  if (std::holds_alternative<mission_client::push_map>(each.what)) {
    ++pushes_;
    mission_client::mission_resolved resolved;
    resolved.mission_id = std::get<mission_client::push_map>(each.what).mission_id;
    time_.at(time_.now_ns() + 1'000'000'000, [this, resolved] { take(core_->on_delivered(resolved, now())); });
  }
}

// -- the link ---------------------------------------------------------------------------------------

void flight_world::take(const vehicle_link::effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { take(what); }, each);
}

// Of the executor and of the failsafe alike.
bool flight_world::is_lost(std::span<const std::byte> frame) {
  if (losses_.second == 0)
    return false;
  bool result = false;
  io::mavlink::scanner one;
  one.feed(frame, [&](const io::mavlink::frame_view& each) {
    result = each.id() == io::mavlink::command_long::message_id &&
             io::mavlink::decode<io::mavlink::command_long>(each).command == losses_.first;
  });
  if (result)
    --losses_.second;
  return result;
}

bool flight_world::is_silenced(std::span<const std::byte> frame) const {
  if (lost_message_ == 0 && !loses_fences_)
    return false;
  bool result = false;
  io::mavlink::scanner one;
  one.feed(frame, [&](const io::mavlink::frame_view& each) {
    const bool is_of_fence = each.id() == io::mavlink::mission_count::message_id &&
                             io::mavlink::decode<io::mavlink::mission_count>(each).mission_type != 0;
    result = (lost_message_ != 0 && each.id() == lost_message_) || (loses_fences_ && is_of_fence);
  });
  return result;
}

void flight_world::take(const vehicle_link::transmission& each) {
  sent_to_others_ += names_another(each.frame.view()) ? 1 : 0;
  if (is_lost(each.frame.span()) || is_silenced(each.frame.span()) || is_vehicle_silent_)
    return;
  carry(each.frame.span(), [this](const std::vector<std::byte>& bytes) {
    to_vehicle_.feed(bytes,
                     [this](const io::mavlink::frame_view& frame) { vehicle_->on_frame(frame, time_.now_ns()); });
  });
}

void flight_world::hear(std::span<const std::byte> frame) {
  if (persons_line_ == 0)
    person_.receive(frame);
  note_picture(frame);
  if (is_silenced(frame) || time_.now_ns() < deaf_until_ns_)
    return;
  carry(frame, [this, age = link_age_](const std::vector<std::byte>& bytes) {
    if (age == link_age_)
      take(link_->on_bytes(line, true, bytes, link_now()));
  });
}

void flight_world::note_picture(std::span<const std::byte> frame) {
  constexpr std::size_t id_at = 7; // of MAVLink 2
  constexpr auto feedback = io::mavlink::camera_feedback::message_id;
  constexpr auto captured = io::mavlink::camera_image_captured::message_id;
  const auto id = std::to_integer<std::uint32_t>(frame[id_at]) | std::to_integer<std::uint32_t>(frame[id_at + 1]) << 8U;
  if (id == feedback || id == captured)
    pictures_.push_back(vehicle_->describe().where);
}

void flight_world::take(const vehicle_link::resolved_command& each) {
  if (each.asked_by.kind != vehicle_link::asker_kind::outside)
    return;
  if (each.asked_by.request_id >= first_of_failsafe)
    failsafe_->take(failsafe::command_resolved{each.asked_by.request_id - first_of_failsafe, each.outcome.verdict},
                    failsafe_now());
  else {
    asked_.erase(each.asked_by.request_id);
    take(core_->on_command(each.asked_by.request_id, each.outcome, now()));
  }
}

void flight_world::take(const vehicle_link::resolved_transfer& each) {
  asked_.erase(each.request_id);
  take(core_->on_transfer(each.request_id, each.outcome, now()));
}

void flight_world::take(const vehicle_link::observation& each) {
  std::visit(
      [this](const auto& m) {
        if constexpr (std::is_same_v<std::decay_t<decltype(m)>, io::mavlink::heartbeat>)
          owner_ = flight::owner_of(m);
        if constexpr (requires { failsafe::sense(m); })
          failsafe_->take(failsafe::sense(m), failsafe_now());
        if constexpr (
            requires(executor::vehicle_view view) { view.take(m); } ||
            requires(executor::vehicle_view view) { view.take(m, std::int64_t{}); } ||
            requires(executor::traffic_view view) { view.take(m, std::int64_t{}); } ||
            std::is_same_v<std::decay_t<decltype(m)>, io::mavlink::mission_item_reached> ||
            std::is_same_v<std::decay_t<decltype(m)>, io::mavlink::statustext>)
          take(core_->on_vehicle(m, now()));
      },
      each);
}

void flight_world::take(const vehicle_link::announcement& each) {
  if (const auto* changed = std::get_if<vehicle_link::connection_changed>(&each))
    take(core_->on_vehicle(*changed, now()));
  else if (const auto* restarted = std::get_if<vehicle_link::vehicle_restarted>(&each))
    take(core_->on_vehicle(*restarted, now()));
  else if (const auto* foreign = std::get_if<vehicle_link::foreign_act>(&each)) {
    failsafe_->take(*foreign, failsafe_now());
    take(core_->on_vehicle(*foreign, now()));
  } else if (const auto* line = std::get_if<vehicle_link::line_findings>(&each))
    take(core_->on_vehicle(*line, now()));
  else if (const auto* picture = std::get_if<vehicle_link::picture_taken>(&each))
    take(core_->on_vehicle(*picture, now()));
}

// -- people -----------------------------------------------------------------------------------------

void flight_world::fly_by_hand(std::uint32_t custom_mode) {
  constexpr std::uint32_t copter_guided = 4;
  constexpr std::uint32_t plane_take_off = 13;
  const bool is_px4 = owner_.autopilot == io::mavlink::mav_autopilot::px4;
  if (owner_.autopilot == io::mavlink::mav_autopilot::ardupilotmega)
    switch_mode(owner_.vehicle == flight::vehicle_class::fixed_wing ? plane_take_off : copter_guided);
  run_for(0.5);
  person_.arm();
  run_for(0.5);
  person_.command(io::mavlink::mav_cmd::nav_takeoff, 0, 0, 0, is_px4 ? 500 : 15); // above mean sea level; above home
  run_for(8);
  switch_mode(custom_mode);
  run_for(2);
}

void flight_world::switch_mode(std::uint32_t custom_mode, mode_form how) {
  person_.change_mode(who_, custom_mode, how);
}

void flight_world::vehicle_says(std::string_view text) {
  io::mavlink::statustext says;
  says.severity = io::mavlink::number(io::mavlink::mav_severity::critical);
  std::copy_n(text.begin(), std::min(text.size(), says.text.size()), says.text.begin());
  vehicle_tells(says);
}

executor::preflight::finding flight_world::found(std::string_view check) const {
  if (const auto& look = core_->last_look())
    for (const auto& each : look->what.findings)
      if (each.check == check)
        return each;
  return {};
}

void flight_world::vehicle_tells(const vehicle_link::observation& what) {
  take(what);
  run_until_idle();
}

void flight_world::vehicle_restarts() {
  take(vehicle_link::announcement(vehicle_link::vehicle_restarted{}));
  run_until_idle();
}

void flight_world::another_program_beats() {
  const io::mavlink::heartbeat beat{.type = io::mavlink::number(io::mavlink::mav_type::onboard_controller),
                                    .autopilot = io::mavlink::number(io::mavlink::mav_autopilot::invalid)};
  hear(io::mavlink::encode(beat, {1, 1}, 0).span());
}

void flight_world::another_vehicle_beats(std::uint8_t system) {
  const io::mavlink::heartbeat beat{.type = io::mavlink::number(io::mavlink::mav_type::quadrotor),
                                    .autopilot = io::mavlink::number(io::mavlink::mav_autopilot::px4)};
  hear(io::mavlink::encode(beat, {system, 1}, 0).span());
}

void flight_world::arm_by_hand() { person_.arm(); }

void flight_world::disarm_by_hand() { person_.disarm(true); }

void flight_world::set_home_by_hand() { person_.command(io::mavlink::mav_cmd::do_set_home, 1); }

void flight_world::set_home_by_hand(const sim::position& where) { person_.set_home(where); }

std::optional<std::uint32_t> flight_world::heard_mode() const {
  const auto& mode = core_->view().mode();
  return mode ? std::optional(mode->custom_mode) : std::nullopt;
}

std::string flight_world::story() const {
  std::string result;
  for (const auto& each : said_)
    result += each + "\n";
  for (const auto& each : reports_)
    result += std::to_string(each.report_no) + " r" + std::to_string(each.revision) + " g" +
              std::to_string(each.generation) + " " + std::string(io::name_of(each.kind)) + " " +
              each.item_id.value_or("") + (each.inferred ? " (inferred)" : "") + "\n";
  const auto seen = vehicle_->describe();
  result += "vehicle: " + seen.mode + (seen.armed ? ", armed" : ", disarmed") + (seen.in_air ? ", in the air" : "") +
            ", mission " + seen.mission_state + " at " + std::to_string(seen.mission_current) + " of " +
            std::to_string(seen.mission_count) + "\n";
  return result;
}

} // namespace godwit::tests
