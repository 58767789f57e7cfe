#include <gtest/gtest.h>

#include "runtime/actor_base.hpp"
#include "tests/actors/failsafe/actor_world.hpp"

#include <algorithm>

namespace godwit::tests {

using namespace std::chrono_literals;
using failsafe::ns_per_ms;
using vehicle_link::command_outcome;
using vehicle_link::command_verdict;
using vehicle_link::send_command;

namespace {

constexpr std::int64_t step_ms = 10;

class link_double final : public runtime::actor_base<failsafe::vehicle_handle> {
public:
  link_double(runtime::spawn_context context, flown_vehicle* vehicle, flight_log* log)
      : actor_base(std::move(context)), vehicle_(vehicle), log_(log) {}

protected:
  behavior_type handlers() override {
    return {on_deferred<send_command, command_outcome>(
                [this](const send_command& what, std::uint64_t request_id) { take(what, request_id); }),
            on<vehicle_link::set_mode>([this](const vehicle_link::set_mode& what) { log_->modes.push_back(what); })};
  }

private:
  void take(const send_command& what, std::uint64_t request_id) {
    const bool is_look = what.command == mavlink::number(mavlink::mav_cmd::request_message);
    (is_look ? log_->looks : log_->commands).push_back({now_ns(), what.command, what.param1});
    if (!is_look)
      log_->order.emplace_back("command");
    if (!vehicle_->is_silent)
      answer_later(request_id, command_outcome{.command = what.command,
                                               .verdict = vehicle_->verdict.value_or(command_verdict::accepted)});
  }

  flown_vehicle* vehicle_;
  flight_log* log_;
};

class executor_double final : public runtime::actor_base<failsafe::failsafe_status_ear> {
public:
  executor_double(runtime::spawn_context context, flight_log* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    return {on<failsafe::failsafe_status>([this](const failsafe::failsafe_status& what) {
      log_->failsafe_statuses.push_back(what);
      log_->order.emplace_back("stance");
    })};
  }

private:
  flight_log* log_;
};

class people_double final : public runtime::actor_base<failsafe::people_handle> {
public:
  people_double(runtime::spawn_context context, flight_log* log) : actor_base(std::move(context)), log_(log) {}

protected:
  behavior_type handlers() override {
    return {on<ground_port::status_text>(
        [this](const ground_port::status_text& what) { log_->texts.push_back(what.text); })};
  }

private:
  flight_log* log_;
};

std::optional<std::uint32_t> mode_after(std::uint16_t command) {
  switch (static_cast<mavlink::mav_cmd>(command)) {
  case mavlink::mav_cmd::nav_return_to_launch:
    return px4_return;
  case mavlink::mav_cmd::nav_land:
    return px4_land;
  case mavlink::mav_cmd::do_set_mode:
    return px4_hold;
  default:
    return std::nullopt;
  }
}

} // namespace

int flight_log::returns() const {
  return static_cast<int>(std::count_if(commands.begin(), commands.end(), [](const command& each) {
    return each.number == mavlink::number(mavlink::mav_cmd::nav_return_to_launch);
  }));
}

runtime::child_policy patient() {
  runtime::child_policy result;
  result.restart = {.intensity = 100'000, .backoff_initial = 1ms, .backoff_max = 10ms};
  return result;
}

runtime::child_policy mortal() {
  runtime::child_policy result;
  result.restart.intensity = 0;
  return result;
}

failsafe_process::failsafe_process(runtime::simulated_disk& disk, flown_vehicle& vehicle, flight_log& log,
                                   const failsafe::settings& configured)
    : world(disk, 1), vehicle_(vehicle), log_(log), obeyed_(log.commands.size()), looked_(log.looks.size()) {
  const auto others = std::make_shared<failsafe::peers>();
  auto& actors = world.actors();
  const auto link = actors.add<link_double>({.name = "vehicle_link"}, patient(), &vehicle, &log);
  failsafe = actors.add<failsafe::actor>({.name = "failsafe"}, patient(), configured, failsafe::vehicle_handle(link),
                                         std::shared_ptr<const failsafe::peers>(others));
  others->ears.emplace_back(actors.add<executor_double>({.name = "executor"}, mortal(), &log));
  others->people.emplace_back(actors.add<people_double>({.name = "people"}, patient(), &log));
  others->log = [&log](const failsafe::warning& said) { log.logged.push_back(said.text); };
  world.start();
  world.run_until_idle();
}

void failsafe_process::say_heartbeat() {
  world.tell(failsafe, mavlink::heartbeat{.type = mavlink::number(vehicle_.type),
                                          .autopilot = mavlink::number(mavlink::mav_autopilot::px4),
                                          .base_mode = 128 | 1,
                                          .custom_mode = vehicle_.mode});
}

void failsafe_process::say_position() {
  const auto there = place_at(vehicle_.east_m, 0).at;
  world.tell(failsafe, mavlink::global_position_int{.time_boot_ms = static_cast<std::uint32_t>(now_ms()),
                                                    .lat = static_cast<std::int32_t>(there.latitude_deg * 1e7),
                                                    .lon = static_cast<std::int32_t>(there.longitude_deg * 1e7),
                                                    .relative_alt = 50'000,
                                                    .vy = 300});
}

void failsafe_process::speak() {
  const auto ms = now_ms();
  if (vehicle_.operator_there)
    heard_ms_ = ms;
  if (ms % 1'000 == 0)
    world.tell(failsafe, ground_port::operator_link{heard_ms_ >= 0, heard_ms_ >= 0 ? ms - heard_ms_ : -1, 1});
  if (!vehicle_.streams)
    return;
  if (ms % 1'000 == 0) {
    say_heartbeat();
    world.tell(failsafe, mavlink::extended_sys_state{.landed_state = 2});
    world.tell(failsafe, mavlink::sys_status{.battery_remaining = static_cast<std::int8_t>(vehicle_.battery_percent)});
  }
  if (ms % vehicle_.position_every_ms == 0)
    say_position();
}

void failsafe_process::answer_looks() {
  for (; looked_ < log_.looks.size(); ++looked_) {
    const auto wanted = static_cast<std::uint32_t>(log_.looks[looked_].param1);
    if (!vehicle_.answers_looks)
      continue;
    if (wanted == mavlink::heartbeat::message_id)
      say_heartbeat();
    else if (wanted == mavlink::extended_sys_state::message_id)
      world.tell(failsafe, mavlink::extended_sys_state{.landed_state = 2});
    else if (wanted == mavlink::global_position_int::message_id)
      say_position();
  }
}

void failsafe_process::obey() {
  while (obeyed_ < log_.commands.size()) {
    const auto& next = log_.commands[obeyed_];
    if (next.at_ns + vehicle_.obeys_after_ms * ns_per_ms > world.now_ns())
      return;
    ++obeyed_;
    if (const auto mode = mode_after(next.number); mode && !vehicle_.is_silent && !vehicle_.verdict)
      vehicle_.mode = *mode;
  }
}

void failsafe_process::run_ms(std::int64_t ms) {
  for (std::int64_t i = 0; i < ms; i += step_ms) {
    obey();
    speak();
    answer_looks();
    world.advance(std::chrono::milliseconds(step_ms));
  }
}

failsafe::guard_answer failsafe_process::guard() {
  const auto asked =
      world.ask(failsafe, 1s, failsafe::guard_mission{{fence_of(mission::fence_kind::inclusion, square(100))}, {}, {}});
  world.run_until_idle();
  EXPECT_EQ(asked->answers, 1);
  return asked->answer;
}

failsafe::failsafe_status failsafe_process::stands() {
  const auto asked = world.ask(failsafe, 1s, failsafe::get_failsafe_status{});
  world.run_until_idle();
  EXPECT_EQ(asked->answers, 1);
  return asked->answer;
}

runtime::health_entry failsafe_process::health() {
  for (const auto& each : world.health().entries())
    if (each.component == "failsafe")
      return each;
  return {};
}

} // namespace godwit::tests
