#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/domain/mission/read.hpp"
#include "io/fields/field_table.hpp"
#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/short_mission.hpp"
#include "programs/godwit-drill/flight_simulation/stored_disk.hpp"
#include "programs/godwit-sim/vehicle/world/position.hpp"
#include "programs/godwitd/configuration.hpp"
#include "runtime/assert.hpp"

namespace godwit::drill {

namespace {

namespace mavlink = io::mavlink;

// The guard has refused a start: until the service manager asks again.
constexpr std::int64_t asked_again_ns = 10'000'000'000;

// A radio beside the vehicle, of which godwit knows nothing.
constexpr mavlink::sender persons_id{254, 190};

// As an operator writes them; addresses are needed, and nobody goes there.
daemon::daemon_settings settings_for(const std::string& mission_id, const flight_simulation::options& wanted) {
  daemon::given_texts words{
      {"vehicle", wanted.vehicle_line}, {"ground", "udpin://127.0.0.1:0"}, {"operator-listen", "127.0.0.1:0"}};
  if (wanted.has_service) {
    words["service"] = "https://missions.example.org";
    words[wanted.takes_next ? "vehicle-id" : "mission-id"] = wanted.takes_next ? "bird-1" : mission_id;
  }
  words["arm-on-start"] = wanted.arms_on_start ? "true" : "false";
  words["ground-as-autopilot"] = wanted.speaks_as_autopilot ? "true" : "false";
  if (wanted.starts_by_itself)
    words["start"] = "automatic";
  const auto configuration = daemon::effective_configuration(words, {});
  GODWIT_ASSERT(configuration.has_value(), "drill: the words are right");
  auto settings = daemon::settings_from(*configuration);
  GODWIT_ASSERT(settings.has_value(), "drill: the configuration can be used");
  settings->pictures_folder.clear(); // the only one that would be of the real disk
  return *std::move(settings);
}

} // namespace

flight_simulation::flight_simulation(const options& wanted) : flight_simulation(wanted, short_mission(wanted.who)) {}

flight_simulation::flight_simulation(const options& wanted, const mission::document& mission)
    : seed_(wanted.seed), who_(wanted.who), planted_(wanted.planted), test_rng_(wanted.seed),
      is_shuffled_(wanted.is_shuffled), mission_id_(mission.mission_id), first_mission_(mission),
      service_(daemon_process::wall_began_ns), station_([this](std::span<const std::byte> frame) {
        if (!process_ || is_station_cut())
          return;
        audit_.on_station_sent(mavlink::frame_view(frame.data()), now_ns_);
        process_->ground_wire().receive(frame);
      }),
      line_(wanted.seed,
            [this](sim::way to, std::span<const std::byte> frame, bool is_damaged) { arrived(to, frame, is_damaged); }),
      person_(persons_id, [this](std::span<const std::byte> frame) { person_sends(frame); }),
      audit_(wanted.who, [this] { return vehicle_->describe(); }) {
  service_.add_mission(mission);
  sim::vehicle_settings vehicle;
  vehicle.who = wanted.who;
  vehicle.speed = wanted.speed;
  vehicle.seed = wanted.seed;
  vehicle.stream_factor = wanted.stream_factor;
  vehicle.beats_at_mode_change = wanted.beats_at_mode_change;
  vehicle.aircraft = wanted.aircraft;
  vehicle_ = std::make_unique<sim::vehicle>(vehicle, now_ns_, [this](std::span<const std::byte> frame) {
    audit_.on_answered(mavlink::frame_view(frame.data()), now_ns_);
    line_.send(sim::way::out, frame, now_ns_);
    if (persons_line_ == 0)
      person_.receive(frame);
  });
  if (wanted.is_person_on_other_line)
    persons_line_ = vehicle_->add_line([this](std::span<const std::byte> frame) { person_.receive(frame); }, now_ns_);
  if (wanted.has_neighbour) {
    constexpr double away_m = 100;
    vehicle.system = 2;
    vehicle.home = sim::moved(vehicle.home, {90, away_m});
    neighbour_ = std::make_unique<sim::vehicle>(
        vehicle, now_ns_, [this](std::span<const std::byte> frame) { line_.send(sim::way::out, frame, now_ns_); });
  }
  line_.set(wanted.line);
  outside_.settings = settings_for(mission_id_, wanted);
  outside_.map_file = folder_.file("map.db");
  outside_.say = [this](std::string_view part, const std::string& sentence) {
    note(std::string(part) + ": " + sentence);
  };
  outside_.on_phase_status = [this](const executor::phase_status& now) { take_status(now); };
  if (wanted.is_recorded)
    record_ = std::make_unique<flight_record>();
  if (record_ && planted_ == planted_flaw::forget_delivery)
    record_->forget_second_report();
  outside_.record = record_.get();
  if (wanted.has_stored_journal) {
    stored_.emplace(folder_.file("godwit.db"), [this] { return now_ns_; });
    outside_.journal.below = [this] { return stored_->open(); };
  }
  begins_ns_ = now_ns_;
}

// -- time -------------------------------------------------------------------------------------------

std::int64_t flight_simulation::next_due_ns() const {
  auto process_ns = begins_ns_;
  if (process_)
    process_ns = is_suspended()
                     ? suspended_until_ns_
                     : std::min(process_->next_timer_ns(), sync_ends_ns_.value_or(process_->next_timer_ns()));
  const auto act_ns = at_order_ && at_order_->at_ns ? *at_order_->at_ns : std::numeric_limits<std::int64_t>::max();
  const auto neighbour_ns = neighbour_ ? neighbour_->next_deadline_ns() : std::numeric_limits<std::int64_t>::max();
  return std::min({vehicle_->next_deadline_ns(), neighbour_ns, line_.next_deadline_ns(), service_.next_deadline_ns(),
                   station_.next_deadline_ns(), process_ns, act_ns});
}

void flight_simulation::step(std::int64_t end_ns) {
  now_ns_ = std::clamp(next_due_ns(), now_ns_, end_ns);
  if (process_ && !is_suspended())
    process_->pass_time_until(now_ns_);
  else if (!process_ && now_ns_ >= begins_ns_)
    begin_process();
  do_planned_act(); // before what arrives in the same instant
  line_.on_time(now_ns_);
  plant();
  if (vehicle_->next_deadline_ns() <= now_ns_)
    vehicle_->on_time(now_ns_);
  if (neighbour_ && neighbour_->next_deadline_ns() <= now_ns_)
    neighbour_->on_time(now_ns_);
  if (track_.is_due(now_ns_))
    track_.look(*vehicle_, now_ns_);
  service_.on_time(now_ns_);
  station_.on_time(now_ns_);
  audit_.on_time(now_ns_);
  run_until_idle();
}

// Until nothing more happens without time passing.
void flight_simulation::run_until_idle() {
  do
    run_process();
  while (exchange() || person_.answer());
  if (person_.take_brought_plan()) {
    note("a person has uploaded another plan");
    audit_.on_foreign_plan(now_ns_);
  }
  watch_process();
}

void flight_simulation::run_process() {
  if (is_suspended())
    return;
  end_sync();
  if (process_ && !is_shuffled_ && !planned_)
    process_->run_until_idle();
  else
    run_shuffled();
  begin_sync();
}

void flight_simulation::run_shuffled() {
  while (process_ && process_->step(test_rng_()))
    if (is_planned_now())
      std::exchange(planned_, std::nullopt)->what();
}

bool flight_simulation::exchange() {
  if (!process_)
    return false;
  const auto orders = process_->vehicle_wire().take_sent();
  for (const auto& each : orders) {
    const mavlink::frame_view frame(each.data());
    look_at_intent(frame);
    audit_.on_sent(frame, now_ns_);
    look_at_order(frame);
    line_.send(sim::way::in, each, now_ns_);
  }
  const auto shown = process_->ground_wire().take_sent();
  for (const auto& each : shown)
    if (!is_station_cut()) {
      audit_.on_station_heard(mavlink::frame_view(each.data()), now_ns_);
      station_.receive(each);
    }
  const bool has_called = service_.take_from(process_->service_port(), now_ns_);
  return !orders.empty() || !shown.empty() || has_called;
}

// Who sends a plan or a start has written first that it will.
void flight_simulation::look_at_intent(const mavlink::frame_view& frame) {
  const auto is_plan = [](const mavlink::mission_count& what) { // fences and rally points are no mission
    return what.count > 0 && what.mission_type == mavlink::number(mavlink::mav_mission_type::mission);
  };
  const bool brings_plan =
      frame.id() == mavlink::mission_count::message_id && is_plan(mavlink::decode<mavlink::mission_count>(frame));
  const auto is_start = [](const mavlink::command_long& what) { // a copy may come after the answer to the first
    return what.command == mavlink::number(mavlink::mav_cmd::mission_start) && what.confirmation == 0;
  };
  const bool starts =
      frame.id() == mavlink::command_long::message_id && is_start(mavlink::decode<mavlink::command_long>(frame));
  if (!brings_plan && !starts)
    return;
  const auto intent = read_intent(outside_.journal.actors["executor"].kept, wall_ns());
  if ((brings_plan && !intent.brings_plan) || (starts && !intent.starts))
    sent_without_intent_ = true;
}

// -- the process ------------------------------------------------------------------------------------

void flight_simulation::begin_process() {
  ledger_.emplace(folder_.file("godwit.starts"), outside_.settings.restarts);
  const auto verdict = ledger_->begin(moment(), status_.in_flight);
  if (!verdict.may_start) {
    note("it does not start: " + verdict.sentence);
    begins_ns_ = now_ns_ + asked_again_ns;
    return;
  }
  note("process " + std::to_string(++processes_));
  outside_.process = {verdict.may_end_fast, verdict.is_reduced};
  process_ = std::make_unique<daemon_process>(outside_, now_ns_, test_rng_());
  process_->hold_journal(sync_takes_ns_ > 0);
}

daemon::boot_moment flight_simulation::moment() const {
  return {"boot " + std::to_string(boots_), now_ns_ / 1'000'000};
}

// As the service manager does it.
void flight_simulation::watch_process() {
  const auto why = process_ ? process_->wants_exit() : std::nullopt;
  if (!why)
    return;
  note("the process ends: " + why->reason);
  if (why->cause == runtime::exit_cause::given_up_in_flight)
    ledger_->end_fast(moment());
  kill_process();
}

// -- the vehicle ------------------------------------------------------------------------------------

void flight_simulation::arrived(sim::way to, std::span<const std::byte> frame, bool is_damaged) {
  if (to == sim::way::out) {
    if (!process_)
      return;
    if (!is_damaged && mavlink::frame_view(frame.data()).from().system == 1)
      audit_.on_delivered(mavlink::frame_view(frame.data()), now_ns_);
    process_->vehicle_wire().receive(frame);
    return;
  }
  const auto hand_on = [this](const mavlink::frame_view& good) { reaches_vehicle(good); };
  if (is_damaged)
    damaged_.feed_datagram(frame, hand_on);
  else
    hand_on(mavlink::frame_view(frame.data()));
}

void flight_simulation::reaches_vehicle(const mavlink::frame_view& frame) {
  vehicle_order order{now_ns_, frame.id()};
  order.mode = custom_mode_in(frame, who_);
  if (frame.id() == mavlink::command_long::message_id)
    order.command = mavlink::decode<mavlink::command_long>(frame).command;
  if (frame.id() == mavlink::command_int::message_id)
    order.command = mavlink::decode<mavlink::command_int>(frame).command;
  const auto seen = vehicle_->describe();
  const bool sets_mode =
      order.command == mavlink::number(mavlink::mav_cmd::do_set_mode) || frame.id() == mavlink::set_mode::message_id;
  order.puts_to_rest = sets_mode && !seen.armed && (seen.mode == "AUTO" || seen.mode == "AUTO.MISSION");
  const bool clears =
      frame.id() == mavlink::mission_clear_all::message_id ||
      (frame.id() == mavlink::mission_count::message_id && mavlink::decode<mavlink::mission_count>(frame).count == 0);
  order.clears_armed = clears && seen.armed;
  if (frame.id() != mavlink::heartbeat::message_id)
    orders_.push_back(order);
  vehicle_->on_frame(frame, now_ns_);
  if (neighbour_)
    neighbour_->on_frame(frame, now_ns_);
  audit_.on_handled(frame, frame.from() != godwit_id, seen, vehicle_->describe(), now_ns_);
  if (moves_vehicle(order))
    note("message " + std::to_string(order.message_id) + ", command " + std::to_string(order.command) +
         " has come to the vehicle, which is in " + vehicle_->describe().mode);
}

// -- what a flight is to do wrong ---------------------------------------------------------------------

void flight_simulation::take_status(const executor::phase_status& now) {
  status_ = now;
  if (killed_ns_ && now.now != executor::phase::disconnected) {
    process_recovery_ns_ = now_ns_ - *killed_ns_;
    killed_ns_.reset();
  }
  if (now.cause == executor::pause_cause::taken_over && planted_ == planted_flaw::order_to_person &&
      !order_to_person_ns_)
    order_to_person_ns_ = now_ns_ + 2'000'000'000;
}

// -- people -----------------------------------------------------------------------------------------

void flight_simulation::person_sends(std::span<const std::byte> bytes) {
  const mavlink::frame_view frame(bytes.data());
  const auto before = vehicle_->describe();
  vehicle_->on_frame(frame, now_ns_, persons_line_);
  audit_.on_handled(frame, true, before, vehicle_->describe(), now_ns_);
}

void flight_simulation::when_ordered(int skip, std::int64_t after_ns, std::function<void()> what) {
  const auto is_order = [this](const mavlink::frame_view& frame) {
    return frame.id() == mavlink::mission_count::message_id || moving_order_in(frame, who_) != moving_order::none;
  };
  at_order_ = planned_act{is_order, skip, after_ns, std::nullopt, std::move(what)};
}

void flight_simulation::when_sent(frame_filter is_it, std::int64_t after_ns, std::function<void()> what) {
  at_order_ = planned_act{std::move(is_it), 0, after_ns, std::nullopt, std::move(what)};
}

void flight_simulation::look_at_order(const mavlink::frame_view& frame) {
  if (!at_order_ || at_order_->at_ns || frame.from() != godwit_id || !at_order_->is_it(frame))
    return;
  if (at_order_->skip-- == 0)
    at_order_->at_ns = now_ns_ + at_order_->after_ns;
}

void flight_simulation::do_planned_act() {
  if (at_order_ && at_order_->at_ns && now_ns_ >= *at_order_->at_ns)
    std::exchange(at_order_, std::nullopt)->what();
}

void flight_simulation::say(operators::command_kind what) {
  operators::command command;
  command.kind = what;
  say(std::move(command));
}

void flight_simulation::say(operators::command what) {
  note("operator command: " + std::string(io::name_of(what.kind)));
  const bool releases = what.kind == operators::command_kind::hand_back ||
                        what.kind == operators::command_kind::start || what.kind == operators::command_kind::resume;
  if (releases)
    audit_.on_release();
  else
    audit_.on_word();
  if (what.by.empty())
    what.by = "drill";
  if (process_)
    process_->say(what);
}

// -- what has happened ------------------------------------------------------------------------------

std::vector<mission::progress_report> flight_simulation::reports_of(const std::string& mission_id) {
  std::vector<mission::progress_report> result;
  for (const auto& each : service_.rows(mission_id, sim::missions::row_kind::progress)) {
    auto read = mission::read<mission::progress_report>(each.text);
    GODWIT_ASSERT(read.has_value(), "the service has stored a good report");
    result.push_back(*std::move(read));
  }
  return result;
}

std::vector<mission::progress_report> flight_simulation::reports() {
  auto result = reports_of(mission_id_);
  if (result.size() < 3)
    return result;
  const auto third = result.begin() + 2;
  GODWIT_ASSERT(planted_ != planted_flaw::end_process, "drill: it was asked to end here");
  if (planted_ == planted_flaw::lose_report)
    result.erase(third);
  else if (planted_ == planted_flaw::double_report)
    result.insert(third, mission::progress_report(*third));
  return result;
}

void flight_simulation::note(const std::string& sentence) {
  told_.push_back(std::to_string(now_ns_ / 1'000'000) + " ms: " + sentence);
}

bool flight_simulation::was_told(const std::string& words) const {
  return std::ranges::any_of(told_, [&](const std::string& each) { return each.find(words) != std::string::npos; });
}

bool flight_simulation::was_told_last(const std::string& words) const {
  constexpr std::size_t newest = 2;
  const auto from = told_.size() > newest ? told_.end() - newest : told_.begin();
  return std::any_of(from, told_.end(), [&](const std::string& each) { return each.find(words) != std::string::npos; });
}

std::string flight_simulation::story() {
  std::string result = "seed " + std::to_string(seed_) + "\n";
  for (const auto& each : told_)
    result += each + "\n";
  for (const auto& each : reports())
    result += std::to_string(each.report_no) + " r" + std::to_string(each.revision) + " g" +
              std::to_string(each.generation) + " " + std::string(io::name_of(each.kind)) + " " +
              each.item_id.value_or("") + (each.inferred ? " (inferred)" : "") + " at " + each.at + "\n";
  const auto seen = vehicle_->describe();
  return result + "vehicle: " + seen.mode + (seen.armed ? ", armed" : ", disarmed") +
         (seen.in_air ? ", in the air" : "") + ", mission " + seen.mission_state + " at " +
         std::to_string(seen.mission_current) + " of " + std::to_string(seen.mission_count) + "\n";
}

} // namespace godwit::drill
