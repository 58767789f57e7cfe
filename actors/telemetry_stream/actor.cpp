#include "actors/telemetry_stream/actor.hpp"

#include <utility>

namespace godwit::telemetry_stream {
namespace {

constexpr std::int64_t ns_in_ms = 1'000'000;

} // namespace

template <class M>
auto actor::shows() {
  return on<M>([this](const M& m) { publish(core_.take(m, handler_time().monotonic_ns)); });
}

actor::actor(runtime::spawn_context context, std::shared_ptr<const peers> others, std::shared_ptr<hub> to)
    : actor_base(std::move(context)), others_(std::move(others)), hub_(std::move(to)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {shows<io::mavlink::global_position_int>(), shows<io::mavlink::attitude>(),   shows<io::mavlink::sys_status>(),
          shows<vehicle_link::connection_changed>(), shows<executor::flight_status>(), shows<health::health_status>()};
}

// What the executor told while there was no incarnation to hear it.
void actor::started() {
  if (others_->flight)
    ask(
        others_->flight, answer_timeout, executor::get_flight{},
        [this](const executor::flight_status& m) { publish(core_.take(m, handler_time().monotonic_ns)); },
        [](const runtime::ask_error&) {}); // it tells the next change
  on_deadline();
}

void actor::on_deadline() {
  publish(core_.beat());
  if (++beats_ % beats_a_map == 0)
    ask_map();
  wake_at(now_ns() + std::chrono::nanoseconds(beat_period).count());
}

void actor::ask_map() {
  audience now{hub_->counts().subscribers != 0};
  observe(now, seen_);
  if (!now.is_there || !others_->map)
    return;
  ask(
      others_->map, answer_timeout, mapobjects_store::get_map{},
      [this](const mapobjects_store::map_status& m) { publish(core_.take(m, handler_time().monotonic_ns)); },
      [](const runtime::ask_error&) {}); // asked again
}

void actor::publish(publications all) {
  if (all.empty())
    return;
  at_end([this, all = std::move(all), at = handler_time()] {
    for (const auto& each : all)
      hub_->publish(each.what, each.data, at.wall_ns / ns_in_ms, at.monotonic_ns);
  });
}

} // namespace godwit::telemetry_stream
