#include "programs/godwitd/ground_run/actor.hpp"

#include <variant>

#include "actors/domain/uuid/uuid.hpp"
#include "programs/godwitd/ground_run/sentences.hpp"

namespace godwit::ground_run {

using mapobjects_store::map_failure;
using runtime::ask_error;

actor::actor(runtime::spawn_context context, settings wanted, std::shared_ptr<const peers> others,
             std::shared_ptr<daemon::sighting_feed> feed, run_world world)
    : actor_base(std::move(context)), mission_id_(wanted.mission_id), has_service_(wanted.has_service),
      core_(std::move(wanted)), others_(std::move(others)), feed_(std::move(feed)), world_(std::move(world)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {on<mission_client::mission_loaded>([this](const mission_client::mission_loaded& m) {
            loaded_ns_ = now_ns();
            execute(core_.on_loaded(m));
          }),
          on<mission_client::earlier_found>([](const mission_client::earlier_found&) {}), // nothing is flown
          on<mission_client::mission_refused>(
              [this](const mission_client::mission_refused& m) { execute(core_.on_refused(m)); }),
          on<mission_client::map_pulled>([this](const mission_client::map_pulled& m) {
            std::optional<double> pull_s;
            if (loaded_ns_)
              pull_s = static_cast<double>(now_ns() - *loaded_ns_) * 1e-9;
            execute(core_.on_pulled(m, pull_s));
          }),
          on<mission_client::change_outcome>(
              [this](const mission_client::change_outcome& m) { execute(announce{sentence_of(m)}); }),
          on<mission_client::assignment_arrived>([this](const mission_client::assignment_arrived& m) { turn_down(m); }),
          on<mission_client::mission_deleted>(
              [this](const mission_client::mission_deleted& m) { execute(core_.on_deleted(m)); }),
          on<mission_client::mission_resolved>(
              [this](const mission_client::mission_resolved& m) { execute(core_.on_resolved(m)); }),
          on<vehicle_link::connection_changed>([this](const vehicle_link::connection_changed& m) {
            has_news_of_vehicle_ = true;
            execute(announce{sentence_of(m)});
          }),
          on<woken>([this](const woken&) { flow_->go_on(); }),
          on<tick>([this](const tick& due) {
            if (due.incarnation == incarnation_number())
              look_again();
          }),
          on<retry_due>([this](const retry_due&) { execute(core_.on_retry()); }),
          on<get_run>([this](const get_run&) {
            return run_status{mission_id_, core_.now(), flow_->counts()};
          })};
}

void actor::started() {
  flow_.emplace(feed_, ways_of_flow());
  execute(core_.on_start());
  tell_after(tick_period, me(), tick{incarnation_number()});
}

void actor::execute(const steps& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { execute(what); }, each);
}

void actor::execute(const begin_fetch&) { tell(others_->client, mission_client::begin_mission{mission_id_}); }

void actor::execute(const choose&) {
  ask(
      others_->store, answer_timeout, mapobjects_store::choose_mission{mission_id_},
      [this](const mapobjects_store::map_answer& answer) {
        if (answer.failure == map_failure::none)
          execute(core_.on_chosen());
        else if (answer.failure != map_failure::busy)
          execute(core_.on_map_broken(answer.error));
      },
      [](const ask_error&) {}); // asked again with the next tick
}

void actor::execute(const look&) {
  ask(
      others_->client, answer_timeout, mission_client::get_service{},
      [this](const mission_client::service_status& now) { execute(core_.on_status(now)); }, [](const ask_error&) {});
}

void actor::execute(const see&) { flow_->begin(); }

void actor::execute(const push&) { tell(others_->client, mission_client::push_map{mission_id_}); }

void actor::execute(const count_owed&) {
  wants_owed_ = true;
  ask(
      others_->store, answer_timeout, mapobjects_store::get_owed{},
      [this](const mapobjects_store::owed_list& left) {
        if (left.failure != map_failure::none)
          return;
        wants_owed_ = false;
        execute(core_.on_owed(left));
      },
      [](const ask_error&) {});
}

void actor::execute(const begin_later&) { tell_after(retry_after, me(), retry_due{}); }

// What an answer did not resolve is asked again, once a second.
void actor::look_again() {
  const auto now = core_.now();
  if (now == phase::loading || now == phase::pulling)
    execute(has_service_ ? steps{look{}} : steps{choose{}});
  if (now == phase::pushing)
    execute(look{});
  if (wants_owed_)
    execute(count_owed{});
  if (!has_news_of_vehicle_)
    look_at_vehicle();
  flow_->look_again();
  tell_after(tick_period, me(), tick{incarnation_number()});
}

// A link that could never be opened does not change, and so nobody is told of it.
void actor::look_at_vehicle() {
  ask(
      others_->vehicle, answer_timeout, vehicle_link::get_connection{},
      [this](const vehicle_link::connection& now) {
        if (has_news_of_vehicle_ || now.reason.empty())
          return;
        has_news_of_vehicle_ = true;
        execute(announce{sentence_of(vehicle_link::connection_changed{now.phase, now.reason}), true});
      },
      [](const ask_error&) {});
}

daemon::sighting_flow::ways actor::ways_of_flow() {
  return {
      [this](const mapobjects_store::sighting& seen, daemon::sighting_flow::taker then, std::function<void()> failed) {
        ask(others_->store, answer_timeout, seen, std::move(then),
            [failed = std::move(failed)](const ask_error&) { failed(); });
      },
      [this](std::string sentence) {
        execute(announce{std::move(sentence), true});
      },
      [this] { execute(core_.on_sightings_over(flow_->counts())); },
      [this](const std::string& error) { execute(core_.on_map_broken(error)); }};
}

// There is no plan on the vehicle that could be changed. The key follows from the assignment, so that turning it down
// twice is one answer.
void actor::turn_down(const mission_client::assignment_arrived& wanted) {
  const std::string reason = "this vehicle does not fly missions yet";
  mission::assignment_response response;
  response.idempotency_key = ids::derived_uuid(wanted.assignment.assignment_id, wanted.mission_id);
  response.outcome = mission::assignment_outcome::rejected;
  response.reason = reason;
  tell(others_->client,
       mission_client::respond_to_assignment{wanted.mission_id, wanted.assignment.assignment_id, std::move(response)});
  execute(announce{"assignment " + wanted.assignment.assignment_id + " is turned down: " + reason});
}

} // namespace godwit::ground_run
