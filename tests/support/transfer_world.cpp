#include "tests/support/transfer_world.hpp"

#include <algorithm>
#include <utility>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::tests {

namespace mavlink = io::mavlink;

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

template <class M>
std::size_t frame_size(const M& message) {
  return mavlink::encode(message, vehicle_id, 0).size();
}

template <class M>
transfer::step hear(transfer::client& client, const M& message, std::int64_t now_ns) {
  return client.on(message, now_ns);
}

// The client never asks for the deprecated form of an item.
transfer::step hear(transfer::client& /*client*/, const mavlink::mission_item& /*message*/, std::int64_t /*now_ns*/) {
  return {};
}

} // namespace

transfer_world::transfer_world(const mission_server::server_profile& vehicle, const transfer::peer_profile& profile,
                               const line_settings& settings, std::uint64_t seed)
    : time_(second_ns + static_cast<std::int64_t>(seed * 7'919'813 % 40'000'000)), profile_(profile),
      server_(vehicle, vehicle_id), seed_(seed) {
  add_station(our_id, settings);
}

transfer_world::station& transfer_world::add_station(mavlink::sender self, const line_settings& settings) {
  stations_.push_back(std::make_unique<station>(self, profile_, time_, settings, seed_ * 1'000'003 + stations_.size()));
  return *stations_.back();
}

transfer::outcome transfer_world::upload(std::vector<mavlink::mission_item_int> plan, mavlink::mav_mission_type type) {
  begin(ours(), ours().client.upload(type, std::move(plan), time_.now_ns()));
  return last_outcome();
}

transfer::outcome transfer_world::download(mavlink::mav_mission_type type) {
  begin(ours(), ours().client.download(type, time_.now_ns()));
  return last_outcome();
}

transfer::outcome transfer_world::clear(mavlink::mav_mission_type type) {
  begin(ours(), ours().client.clear(type, time_.now_ns()));
  return last_outcome();
}

transfer::outcome transfer_world::last_outcome() {
  run_until_idle(ours());
  return ours().outcomes.empty() ? transfer::outcome{} : ours().outcomes.back();
}

bool transfer_world::run_until_idle(station& from, std::int64_t at_most_ns) {
  const auto until_ns = time_.now_ns() + at_most_ns;
  while (!from.client.is_idle())
    if (!run_once(until_ns))
      return false;
  return true;
}

void transfer_world::run_for(std::int64_t duration_ns) {
  const auto until_ns = time_.now_ns() + duration_ns;
  while (run_once(until_ns)) {
  }
  time_.advance_to(until_ns);
}

bool transfer_world::run_once(std::int64_t until_ns) {
  auto next_ns = std::min(time_.next_ns(), is_vehicle_down_ ? INT64_MAX : server_.next_deadline_ns());
  for (const auto& each : stations_)
    next_ns = std::min(next_ns, each->client.next_deadline_ns().value_or(INT64_MAX));
  if (next_ns > until_ns)
    return false;
  if (time_.next_ns() == next_ns) {
    time_.run_next();
    return true;
  }
  time_.advance_to(next_ns);
  if (!is_vehicle_down_ && server_.next_deadline_ns() <= next_ns)
    execute(server_.on_time(next_ns));
  for (const auto& each : stations_)
    if (each->client.next_deadline_ns().value_or(INT64_MAX) <= next_ns)
      execute(*each, each->client.on_time(next_ns));
  return true;
}

void transfer_world::execute(station& from, transfer::step what) {
  for (const auto& each : what.messages) {
    if (std::holds_alternative<mavlink::mission_request_list>(each) && from.bytes_when_settling == 0)
      from.bytes_when_settling = from.line.bytes();
    if (from.drops_sent(each))
      continue;
    const auto size = std::visit([](const auto& m) { return frame_size(m); }, each);
    from.line.send(simulated_line::up, size, [this, id = from.id, each] { to_vehicle(id, each); });
  }
  if (what.advanced)
    from.progress.push_back(*what.advanced);
  if (what.finished)
    from.outcomes.push_back(std::move(*what.finished));
}

void transfer_world::to_vehicle(mavlink::sender from, const transfer::outgoing& what) {
  if (is_vehicle_down_)
    return;
  execute(std::visit([&](const auto& m) { return server_.on(from, m, time_.now_ns()); }, what));
}

void transfer_world::execute(const mission_server::reaction& what) {
  for (const auto& change : what.changes)
    if (change.type == mavlink::mav_mission_type::mission &&
        change.kind != mission_server::plan_change_kind::begun_replacing)
      history_.push_back({change.by, server_.plan(change.type).items});
  for (const auto& message : what.messages)
    for (const auto& each : stations_)
      if (!each->drops_received(message))
        std::visit([&](const auto& m) { to_station(*each, m); }, message);
}

template <class M>
void transfer_world::to_station(station& to, const M& message) {
  to.line.send(simulated_line::down, frame_size(message),
               [this, &to, message] { execute(to, hear(to.client, message, time_.now_ns())); });
}

void transfer_world::report_mission_every_second() {
  time_.at(time_.now_ns() + second_ns, [this] {
    const auto id = [&](mavlink::mav_mission_type type) { return server_.plan(type).id; };
    mavlink::mission_current now;
    now.mission_id = id(mavlink::mav_mission_type::mission);
    now.fence_id = id(mavlink::mav_mission_type::fence);
    now.rally_points_id = id(mavlink::mav_mission_type::rally);
    const auto count = server_.plan(mavlink::mav_mission_type::mission).items.size();
    now.total = count == 0 ? 65'535 : static_cast<std::uint16_t>(count);
    if (!is_vehicle_down_)
      for (const auto& each : stations_)
        each->line.send(simulated_line::down, frame_size(now),
                        [this, to = each.get(), now] { execute(*to, to->client.on(now, time_.now_ns())); });
    report_mission_every_second();
  });
}

bool transfer_world::is_same(const std::vector<mavlink::mission_item_int>& a,
                             const std::vector<mavlink::mission_item_int>& b) {
  return !mavlink::first_difference(a, b, false);
}

void transfer_world::restart_our_client() {
  auto* client = &ours().client;
  std::destroy_at(client);
  std::construct_at(client, our_id, vehicle_id, profile_, time_.now_ns());
}

void transfer_world::reboot_vehicle(std::int64_t duration_ns) {
  is_vehicle_down_ = true;
  time_.at(time_.now_ns() + duration_ns, [this] {
    is_vehicle_down_ = false;
    server_.restart();
  });
}

std::vector<mavlink::mission_item_int> mission_of(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed + 1);
  std::uniform_int_distribution<std::int32_t> offset(-500'000, 500'000);
  std::vector<mavlink::mission_item_int> result(static_cast<std::size_t>(count));
  for (auto& each : result) {
    each.command = mavlink::number(mavlink::mav_cmd::nav_waypoint);
    each.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
    each.autocontinue = 1;
    each.x = 500'000'000 + offset(random);
    each.y = 364'000'000 + offset(random);
    each.z = static_cast<float>(30 + std::abs(offset(random)) % 100);
  }
  return result;
}

bool holds(const mission_server::server& vehicle, const std::vector<mavlink::mission_item_int>& plan,
           mavlink::mav_mission_type type) {
  return !mavlink::first_difference(plan, vehicle.plan(type).items, type == mavlink::mav_mission_type::mission);
}

} // namespace godwit::tests
