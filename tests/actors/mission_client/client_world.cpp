#include "tests/actors/mission_client/client_world.hpp"

namespace godwit::mission_client::test {

namespace {

using namespace std::chrono_literals;

runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 1ms, .backoff_max = 10ms};
  return result;
}

} // namespace

listener::behavior_type listener::handlers() {
  return {on<mission_loaded>([this](const auto& m) { into_->loaded.push_back(m); }),
          on<earlier_found>([this](const auto& m) { into_->earlier.push_back(m); }),
          on<mission_refused>([this](const auto& m) { into_->refused.push_back(m); }),
          on<map_pulled>([this](const auto& m) { into_->pulled.push_back(m); }),
          on<change_outcome>([this](const auto& m) { into_->outcomes.push_back(m); }),
          on<assignment_arrived>([this](const auto& m) { into_->arrived.push_back(m); }),
          on<mission_deleted>([this](const auto& m) { into_->deleted.push_back(m); }),
          on<mission_resolved>([this](const auto& m) { into_->resolved.push_back(m); })};
}

process::process(outside& around, settings configured) : world(around.disk, ++around.processes), around_(around) {
  const auto others =
      std::make_shared<peers>(peers{world.actors().add<listener>({.name = "listener"}, patient(), &around.listener),
                                    world.actors().add<store_actor>({.name = "store"}, patient(), &around.store)});
  client = world.actors().add<actor>({.name = "mission_client"}, patient(), configured,
                                     std::static_pointer_cast<service_port>(port), std::shared_ptr<const peers>(others),
                                     around.processes);
  world.start();
  world.run_until_idle();
}

void process::exchange() {
  around_.service.run(port, world.now_ns(), [this] { world.tell(client, wake{}); });
}

void process::advance(std::chrono::nanoseconds duration, std::chrono::nanoseconds stride) {
  for (auto left = duration; left.count() > 0; left -= stride) {
    world.run_until_idle();
    exchange();
    world.advance(std::min(left, stride));
  }
  exchange();
  world.run_until_idle();
}

service_status process::status() {
  const auto asked = world.ask(client, 1s, get_service{});
  world.advance(10ms);
  return asked->answer;
}

retry_answer process::retry(const std::string& key) {
  const auto asked = world.ask(client, 1s, retry_outbox{key});
  world.advance(10ms);
  return asked->answer;
}

runtime::health_entry process::health() const {
  for (const auto& each : world.health().entries())
    if (each.component == "mission_client")
      return each;
  return {};
}

void begin(process& p, const std::string& mission_id) {
  p.say(begin_mission{mission_id});
  p.advance(2s);
}

report_progress report(const std::string& mission_id, std::uint32_t number) {
  mission::progress_report result;
  result.mission_id = mission_id;
  result.generation = 1;
  result.report_no = number;
  result.kind = mission::progress_kind::reached;
  result.item_id = "w1";
  result.item_index = 1;
  result.at = "2026-05-04T10:15:30Z";
  return {uuid(number, mission_id.front()), result};
}

insert_waypoint insert(const std::string& mission_id, std::int32_t base, std::uint64_t number) {
  return {mission_id,
          {.idempotency_key = uuid(number, 'e'),
           .base_revision = base,
           .after_item_id = "w1",
           .waypoint = mission::waypoint{"look-" + std::to_string(number), {47.3988, 8.5469, 30}, 0, 2, {}}}};
}

replace_tail tail(const std::string& mission_id, std::int32_t base, std::uint64_t number) {
  return {mission_id,
          {.idempotency_key = uuid(number, 'f'),
           .base_revision = base,
           .after_item_id = "w1",
           .items = {mission::return_home{"home-" + std::to_string(number)}},
           .reason = "click to fly"}};
}

respond_to_assignment response(const std::string& mission_id, const mission::assignment& to,
                               mission::assignment_outcome outcome, std::uint64_t number) {
  mission::assignment_response result;
  result.idempotency_key = uuid(number, '9');
  result.outcome = outcome;
  if (outcome == mission::assignment_outcome::rejected)
    result.reason = "stale";
  result.last_progress = report(mission_id, 1).report;
  result.generation = 2;
  return {mission_id, to.assignment_id, result};
}

} // namespace godwit::mission_client::test
