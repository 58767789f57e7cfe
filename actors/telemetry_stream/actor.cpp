#include "actors/telemetry_stream/actor.hpp"

#include <utility>

#include "io/time_units.hpp"
#include "runtime/content_hash.hpp"

namespace godwit::telemetry_stream {

template <class M>
auto actor::shows() {
  return on<M>([this](const M& m) { publish(core_.take(m, handler_time().monotonic_ns)); });
}

actor::actor(runtime::spawn_context context, std::shared_ptr<const peers> others, std::shared_ptr<hub> to)
    : actor_base(std::move(context)), others_(std::move(others)), hub_(std::move(to)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {shows<io::mavlink::global_position_int>(),
          shows<io::mavlink::attitude>(),
          shows<io::mavlink::sys_status>(),
          shows<io::mavlink::gps_raw_int>(),
          shows<io::mavlink::home_position>(),
          shows<vehicle_link::connection_changed>(),
          shows<executor::flight_status>(),
          shows<executor::known_missions>(),
          shows<executor::way_home_estimate>(),
          shows<executor::heard_traffic>(),
          shows<health::health_status>(),
          on<scan_controller::point_shown>([this](const scan_controller::point_shown&) { ask_points(); }),
          on<scan_controller::point_closed>([this](const scan_controller::point_closed&) { ask_points(); })};
}

// What the executor told while there was no incarnation to hear it.
void actor::started() {
  if (others_->flight)
    ask(
        others_->flight, answer_timeout, executor::get_flight{},
        [this](const executor::flight_status& m) { publish(core_.take(m, handler_time().monotonic_ns)); },
        [](const runtime::ask_error&) {}); // it tells the next change
  if (others_->missions)
    ask(
        others_->missions, answer_timeout, executor::get_missions{},
        [this](const executor::known_missions& m) { publish(core_.take(m, handler_time().monotonic_ns)); },
        [](const runtime::ask_error&) {});
  ask_points();
  on_deadline();
}

void actor::on_deadline() {
  publish(core_.beat());
  if (++beats_ % beats_a_question == 0)
    ask_round();
  wake_at(now_ns() + std::chrono::nanoseconds(beat_period).count());
}

void actor::ask_round() {
  audience now{hub_->counts().subscribers != 0};
  observe(now, seen_);
  if (!now.is_there)
    return;
  ask_points();
  if (!others_->map)
    return;
  ask(
      others_->map, answer_timeout, mapobjects_store::get_map{},
      [this](const mapobjects_store::map_status& m) { publish(core_.take(m, handler_time().monotonic_ns)); },
      [](const runtime::ask_error&) {}); // asked again
}

// While no mission with scanning flies there is nobody to ask.
void actor::ask_points() {
  if (!others_->points)
    return;
  ask(
      others_->points, answer_timeout, scan_controller::get_points{},
      [this](const scan_controller::points& m) {
        pictured_points now{others_->pictured ? others_->pictured() : std::vector<std::uint64_t>()};
        observe(now, pictured_);
        publish(core_.take(m, now.numbers, handler_time().wall_ns));
      },
      [this](const runtime::ask_error& why) {
        if (why.code == runtime::ask_errc::not_taken)
          publish(core_.take_no_points());
      });
}

void actor::publish(publications all) {
  if (all.empty())
    return;
  if (is_recorded())
    for (const auto& each : all)
      note_call("publish " + std::string(io::name_of(each.what)), runtime::content_hash(each.data));
  at_end([this, all = std::move(all), at = handler_time()] {
    for (const auto& each : all)
      hub_->publish(each.what, each.data, at.wall_ns / ns_per_ms, at.monotonic_ns);
  });
}

} // namespace godwit::telemetry_stream
