#include "actors/executor/actor.hpp"

#include <algorithm>
#include <stdexcept>

#include "actors/executor/flight/watches/survey_view.hpp"
#include "actors/executor/people_views.hpp"
#include "actors/executor/remaining.hpp"
#include "actors/executor/scan_sentences.hpp"
#include "actors/executor/state_token.hpp"
#include "io/fields/field_table.hpp"

namespace godwit::executor {
namespace {

runtime::health_colour colour_of(const phase_status& status) {
  if (status.now != phase::paused)
    return runtime::health_colour::green;
  const bool is_expected = status.cause == pause_cause::asked || status.cause == pause_cause::plan_ended;
  return is_expected ? runtime::health_colour::yellow : runtime::health_colour::red;
}

} // namespace

template <class M>
auto actor::hears() {
  return on<M>([this](const M& message) { then(core_->on_vehicle(message, now())); });
}

actor::actor(runtime::spawn_context context, settings configured, std::shared_ptr<const peers> others,
             outside_world world)
    : durable_actor(std::move(context)), settings_(std::move(configured)), others_(std::move(others)),
      world_(std::move(world)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {
      on<mission_client::mission_loaded>(
          [this](const mission_client::mission_loaded& m) { then(core_->on_mission(m, now())); }),
      on<mission_client::earlier_found>(
          [this](const mission_client::earlier_found& m) { then(core_->on_earlier(m, now())); }),
      on<mission_client::mission_refused>(
          [this](const mission_client::mission_refused& m) { then(core_->on_refused(m, now())); }),
      on<mission_client::map_pulled>([this](const mission_client::map_pulled& m) { then(core_->on_map(m, now())); }),
      on<mission_client::change_outcome>(
          [this](const mission_client::change_outcome& m) { then(core_->on_change(m, now())); }),
      on<mission_client::assignment_arrived>(
          [this](const mission_client::assignment_arrived& m) { then(core_->on_assignment(m, now())); }),
      on<mission_client::mission_deleted>(
          [this](const mission_client::mission_deleted& m) { then(core_->on_deleted(m, now())); }),
      on<mission_client::mission_resolved>(
          [this](const mission_client::mission_resolved& m) { then(core_->on_delivered(m, now())); }),
      on<failsafe::failsafe_status>([this](const failsafe::failsafe_status& m) {
        core_->on_failsafe_status(m);
        after_turn();
      }),
      on_deferred<operators::command, operators::answer>(
          [this](const operators::command& m, std::uint64_t request_id) { obey(m, request_id); }),
      on<get_flight>([this](const get_flight&) { return describe(); }),
      on<get_missions>([this](const get_missions&) { return core_->missions(); }),
      on<get_plan>([this](const get_plan&) { return plan_view_of(current_state(), core_->view()); }),
      on<get_traffic>([this](const get_traffic&) { return core_->traffic(now()); }),
      on<get_preflight>(
          [this](const get_preflight&) { return preflight_view_of(current_state().preflight, core_->last_look()); }),
      on_deferred<station_act, act_answer>(
          [this](const station_act& m, std::uint64_t request_id) { obey(m, request_id); }),
      on<act_acknowledged>([this](const act_acknowledged& m) { then(core_->on_station(m, now())); }),
      on<start_mission>([this](const start_mission& m) { then(core_->on_station(m, now())); }),
      on_deferred<set_current, current_answer>(
          [this](const set_current& m, std::uint64_t request_id) { obey(m, request_id); }),
      on<plan_taken>([this](const plan_taken& m) { then(core_->on_station(m, now())); }),
      on<plan_cleared>([this](const plan_cleared& m) { then(core_->on_station(m, now())); }),
      hears<io::mavlink::heartbeat>(),
      hears<io::mavlink::current_mode>(),
      on<io::mavlink::sys_status>([this](const io::mavlink::sys_status& m) {
        then(core_->on_vehicle(m, now()));
        show_way_home();
      }),
      hears<io::mavlink::gps_raw_int>(),
      hears<io::mavlink::global_position_int>(),
      hears<io::mavlink::home_position>(),
      hears<io::mavlink::extended_sys_state>(),
      hears<io::mavlink::mission_current>(),
      hears<io::mavlink::mission_item_reached>(),
      hears<io::mavlink::ekf_status_report>(),
      hears<io::mavlink::estimator_status>(),
      hears<io::mavlink::statustext>(),
      hears<io::mavlink::adsb_vehicle>(),
      hears<io::mavlink::collision>(),
      hears<vehicle_link::connection_changed>(),
      hears<vehicle_link::vehicle_restarted>(),
      hears<vehicle_link::foreign_act>(),
      hears<vehicle_link::line_findings>(),
      hears<vehicle_link::picture_taken>(),
      on<runtime::child_event>([this](const runtime::child_event& m) {
        say_all(supervisor_->on_event(m, now().now_ns));
        greet_returned();
        supervise();
        read_host_status();
        after_turn();
      }),
      on<scan_controller::point_shown>([this](const scan_controller::point_shown& m) {
        execute(announce{sentence_about(m), false});
      }),
      on<scan_controller::point_closed>([this](const scan_controller::point_closed& m) {
        execute(announce{sentence_about(m), false});
      }),
      on<tick>([this](const tick& due) {
        if (due.incarnation != incarnation_number())
          return;
        tell_after(tick_period, me(), tick{incarnation_number()});
        supervise();
        read_host_status();
        look_at_service();
        ask_for_failsafe_status();
        keep_vehicle(true);
        after_turn();
        show_missions(); // they change seldom, and what they are takes a look at all items
        show_traffic();
      })};
}

void actor::started() {
  core_.emplace(settings_, current_state());
  restored_missions_ = current_state().progress.past_missions;
  if (const auto& open = current_state().progress.mission)
    restored_missions_.push_back(*open);
  supervision::own_process process{world_.process(), world_.children()};
  std::optional<supervision::own_process> not_recorded;
  observe(process, not_recorded);
  supervisor_.emplace(process.how, incarnation_number(), std::move(process.children));
  at_end([this] { world_.on_phase_status(current_state().status); });
  supervise();
  read_host_status();
  execute(core_->on_start(incarnation_number() == 1));
  ask(
      others_->vehicle, command_patience, vehicle_link::get_connection{},
      [this](const vehicle_link::connection& m) { then(core_->on_connection(m, now())); },
      [](const runtime::ask_error&) {}); // its next change is told
  ask_for_failsafe_status();
  after_turn();
  tell_after(tick_period, me(), tick{incarnation_number()});
}

// A stop is answered while the disk does not write; what else was taken is on the disk by then.
void actor::obey(const operators::command& m, std::uint64_t request_id) {
  const auto answer = core_->on_operator(m, now());
  if (!answer.advice.empty())
    execute(announce{answer.advice, true}); // to stations, which are answered by a number alone
  after_turn();
  if (operators::is_stop(m.kind))
    answer_later(request_id, answer);
  else
    after_commit([this, request_id, answer] { answer_later(request_id, answer); });
}

// It is not held up by the disk: what is sent after the answer has to meet nobody else's order. That something is
// begun is said before what comes of it.
void actor::obey(const station_act& m, std::uint64_t request_id) {
  auto [wanted, answer] = core_->on_station(m, now());
  if (answer.verdict == act_verdict::begun)
    answer_later(request_id, answer);
  then(wanted);
  if (answer.verdict != act_verdict::begun)
    answer_later(request_id, answer);
}

// Its answer comes as that of a start, with a key that no station's has; a crash forgets who waits for it.
void actor::obey(const set_current& m, std::uint64_t request_id) {
  currents_.insert(request_id);
  then(core_->on_station(m, keys_of_currents | request_id, now()));
}

bool actor::answer_current(const start_answer& m) {
  if ((m.key & keys_of_currents) == 0)
    return false;
  const auto request_id = m.key & ~keys_of_currents;
  if (currents_.erase(request_id) == 0)
    return true;
  const auto verdict = m.verdict == start_verdict::started        ? current_verdict::going
                       : m.verdict == start_verdict::no_such_item ? current_verdict::no_such_item
                       : m.verdict == start_verdict::failed       ? current_verdict::failed
                                                                  : current_verdict::not_now;
  answer_later(request_id, current_answer{verdict, m.reason});
  return true;
}

// What is told at a change may have been told to the incarnation before.
void actor::ask_for_failsafe_status() {
  if (!core_->wants_failsafe_status() || is_asking_failsafe_status_)
    return;
  is_asking_failsafe_status_ = true;
  ask(
      others_->failsafe, failsafe_status_patience, failsafe::get_failsafe_status{},
      [this](const failsafe::failsafe_status& m) {
        is_asking_failsafe_status_ = false;
        if (core_->wants_failsafe_status())
          core_->on_failsafe_status(m);
        after_turn();
      },
      [this](const runtime::ask_error&) { is_asking_failsafe_status_ = false; });
}

// At each change, and once a second: what is told while vehicle_link begins anew is lost.
void actor::keep_vehicle(bool is_tick) {
  const vehicle_link::keep_vehicle wanted{core_->keeps_vehicle()};
  const bool is_due = is_tick && now().now_ns - kept_told_ns_ >= keep_period.count();
  if (kept_told_ == wanted.is_kept && !is_due)
    return;
  kept_told_ = wanted.is_kept;
  kept_told_ns_ = now().now_ns;
  tell(others_->vehicle, wanted);
}

// -- the other actors ---------------------------------------------------------------------------------

void actor::read_host_status() {
  auto seen = world_.read_host_status();
  observe(seen.journal, journal_facts_);
  observe(seen.operators, operator_fact_);
  observe(seen.camera, camera_fact_);
  observe(seen.program, program_fact_);
  seen.actors = supervisor_->facts();
  core_->on_host_status(std::move(seen));
}

void actor::supervise() {
  const auto& s = current_state();
  supervisor_->look(s.supervision, s.status.in_flight, scans(s, settings_.scans), now().now_ns);
  send_table();
  if (!supervisor_->knows_children())
    ask_for_children();
  const bool is_gone = supervisor_->is_failsafe_gone(now().now_ns);
  core_->on_failsafe_gone(is_gone);
  if (is_gone && core_->wants_failsafe_status())
    core_->on_failsafe_status({}); // there is nobody to ask, and the vehicle still has to be brought home
  if (core_->view().mode() && supervisor_->misses_failsafe(s.supervision, now().now_ns))
    miss_failsafe(); // once the vehicle is heard: what is decided then is on the disk with the return
}

// Again with each tick, until it is acknowledged.
void actor::send_table() {
  const auto table = supervisor_->unacknowledged();
  if (!table || is_sending_table_)
    return;
  is_sending_table_ = true;
  ask(
      others_->guardian, guardian_patience, *table,
      [this](const runtime::supervised& held) {
        is_sending_table_ = false;
        supervisor_->on_acknowledged(held.epoch);
      },
      [this](const runtime::ask_error&) { is_sending_table_ = false; });
}

// What happened before this incarnation was told to the one before.
void actor::ask_for_children() {
  if (std::exchange(is_asking_children_, true))
    return;
  ask(
      others_->guardian, guardian_patience, runtime::get_children{},
      [this](const runtime::children& all) {
        is_asking_children_ = false;
        say_all(supervisor_->on_children(all, now().now_ns));
        read_host_status();
        after_turn();
      },
      [this](const runtime::ask_error&) { is_asking_children_ = false; });
}

// What they were told while they were away was dropped.
void actor::greet_returned() {
  for (const auto& name : supervisor_->take_returned()) {
    if (name == "mission_client")
      execute(core_->on_client_back());
    else if (name == "ground_port")
      core_->on_port_back();
    else if (name == "scan_controller" || name == "movement_detector")
      told_survey_.reset();
  }
}

// At each change. Who looks for points of interest is there by then, or is told when it comes.
void actor::tell_survey() {
  if (!supervisor_->is_scanning())
    return told_survey_.reset();
  auto seen = survey_progress_of(current_state());
  if (!seen || (told_survey_ && io::equal(*told_survey_, *seen)))
    return;
  tell(others_->scan, *seen);
  if (others_->eyes)
    tell(others_->eyes, *seen);
  told_survey_ = std::move(seen);
}

// A person who has the vehicle keeps it. What is decided here counts for the whole flight.
void actor::miss_failsafe() {
  commit(supervision::failsafe_missed{});
  execute(announce{"the failsafe can not be kept up: nobody watches fences, battery and links; no new plan is flown",
                   true});
  if (settings_.failsafe_gone != failsafe_gone_policy::come_home)
    return;
  if (core_->is_coming_down())
    return execute(announce{"the failsafe is gone; the vehicle comes down already, and is left to it", true});
  operators::command command;
  command.kind = operators::command_kind::come_home;
  command.by = actor_name();
  const auto answer = core_->on_operator(command, now());
  execute(answer.is_taken ? announce{"the vehicle returns because the failsafe is gone", true}
                          : announce{"the vehicle is not commanded to return: " + answer.reason, true});
}

void actor::say_all(const std::vector<announce>& sentences) {
  for (const auto& each : sentences)
    execute(each);
}

void actor::look_at_service() {
  if (!others_->client || !core_->wants_service() || is_asking_service_)
    return;
  is_asking_service_ = true;
  ask(
      *others_->client, command_patience, mission_client::get_service{},
      [this](const mission_client::service_status& m) {
        is_asking_service_ = false;
        core_->on_service(m);
      },
      [this](const runtime::ask_error&) { is_asking_service_ = false; });
}

void actor::then(const effects& wanted) {
  execute(wanted);
  after_turn();
}

// All that comes of it now; what follows from a note is decided when it is applied.
void actor::after_turn() {
  for (int i = 0;; ++i) {
    if (i == max_decisions_per_turn)
      throw std::logic_error("the executor does not come to an end with what it wants");
    hear_news();
    const auto wanted = core_->advance(now());
    if (wanted.empty())
      break;
    execute(wanted);
  }
  keep_vehicle(false);
  if (others_->port)
    execute(core_->tell_stations(now()));
  tell_survey();
  post_health();
  show_flight();
}

void actor::hear_news() {
  while (!news_.empty()) {
    const auto next = std::move(news_.front());
    news_.pop_front();
    std::visit([this](const auto& what) { execute(core_->on_news(what, now())); }, next);
  }
}

// -- what others see --------------------------------------------------------------------------------

void actor::post_health() {
  runtime::condition how{colour_of(current_state().status), core_->sentence()};
  if (how.how == runtime::health_colour::green && core_->is_battery_short())
    how = {runtime::health_colour::yellow, how.reason + "; the battery lasts just for the way home"};
  if (const auto moved = core_->home_moved(); !moved.empty())
    how = {runtime::health_colour::red, how.reason + "; " + moved};
  show_health(std::move(how));
}

// Whoever watches hears of it before the disk does: it is refreshed, and nothing is decided by it.
void actor::show_flight() {
  if (others_->watchers.empty())
    return;
  auto now_stands = describe();
  if (shown_flight_ == now_stands)
    return;
  for (const auto& each : others_->watchers)
    tell(each, now_stands);
  shown_flight_ = std::move(now_stands);
}

flight_status actor::describe() const {
  const auto& s = current_state();
  flight_status result;
  result.phase = io::name_of(s.status.now);
  result.cause = io::name_of(s.status.cause);
  result.sentence = core_->sentence();
  result.in_flight = s.status.in_flight;
  result.generation = s.progress.last_generation;
  result.reports = s.progress.mission ? s.progress.mission->report_no : 0;
  if (s.mission) {
    result.mission_id = s.mission->mission_id;
    result.revision = s.mission->revision;
    result.items = static_cast<std::uint32_t>(s.mission->items.size());
    result.items_done = static_cast<std::uint32_t>(first_remaining(*s.mission, last_done(s)));
  }
  if (s.preflight.now == preflight::phase::awaiting_ack && s.preflight.report)
    result.preflight_report = s.preflight.report->id;
  result.is_armed = core_->view().is_armed();
  if (core_->view().mode())
    result.mode = io::name_of(core_->view().mode()->kind);
  result.authority = core_->authority();
  result.why_no_mission = core_->why_no_mission();
  result.state = state_token(s);
  return result;
}

} // namespace godwit::executor
