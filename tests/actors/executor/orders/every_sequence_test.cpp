// Around each order that moves a vehicle, every sequence of up to six of eight things that can happen, none twice:
// 28,960 for each order and vehicle. The executor's own parts decide (task, watch, recovery); the vehicle is a mode and
// an armed flag, which tell the truth when they are looked at.
//
// What must hold: the order goes out once; after a person's act nothing that moves the vehicle goes out; who was heard
// to command the vehicle has it.
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "actors/executor/flight/recovery.hpp"
#include "actors/executor/flight/vehicle_steps.hpp"
#include "io/mavlink/enums.hpp"
#include "tests/actors/executor/flight_checks.hpp"
#include "tests/actors/executor/flight_world.hpp"
#include "tests/support/vehicle_modes.hpp"

namespace godwit::executor {
namespace every_sequence_test {

using io::mavlink::mav_cmd;
using io::mavlink::number;
using sim::personality;
using tests::flight_world;

constexpr std::int64_t ms = 1'000'000;

enum class which { guided, arm, start, resume, jump };
enum class event { answer, older_heartbeat, newer_heartbeat, persons_act, answer_to_another, text, loss, kill };
constexpr std::array all_events{event::answer,
                                event::older_heartbeat,
                                event::newer_heartbeat,
                                event::persons_act,
                                event::answer_to_another,
                                event::text,
                                event::loss,
                                event::kill};
constexpr std::array names{
    "answer", "older heartbeat", "newer heartbeat", "person", "answer to another", "text", "loss", "kill"};

struct vehicle_truth {
  std::uint32_t mode = 0;
  bool is_armed = false;
};

// Where a flight stands when the order is about to be given.
struct beginning {
  personality who = personality::px4;
  state durable;
  vehicle_truth truth;
  flight::mode_owner owner;
  bool is_in_air = false;
};

beginning before(which order, personality who) {
  const bool flies = order == which::resume || order == which::jump;
  flight_world world({.who = who, .start = flies ? start_policy::automatic : start_policy::on_command});
  beginning result;
  result.who = who;
  if (!flies) {
    world.load(tests::short_mission(who));
    EXPECT_TRUE(world.run_until_phase(phase::ready, 120)) << world.story();
  } else {
    EXPECT_TRUE(tests::fly_to(world, tests::short_mission(who), mission::progress_kind::started, "w2"));
    EXPECT_TRUE(order == which::jump || world.say(operators::command_kind::pause).is_taken);
    EXPECT_TRUE(order == which::jump || world.run_until_phase(phase::paused, 20)) << world.story();
    world.run_for(2);
  }
  result.durable = world.durable();
  result.truth = {world.heard_mode().value_or(0), flies};
  result.owner = world.owner();
  result.is_in_air = flies;
  return result;
}

class order_world {
public:
  order_world(const beginning& from, which order) : from_(from), truth_(from.truth), durable_(from.durable) {
    begin_parts();
    recovery_->begin(false);
    hear_vehicle(truth_);
    effects out;
    if (recovery_->look(out, now())) // as found, without what a restart does about it
      durable_ = from.durable;
    flight_->authority.begin(*flight_->view.mode());
    is_begun_ = true;
    out.clear();
    begin_task(out, order);
    execute(out);
    for (int i = 0; i < 200 && orders_ == 0; ++i)
      pass(5 * ms);
  }

  [[nodiscard]] bool is_given() const { return orders_ > 0; }
  [[nodiscard]] const std::string& story() const { return story_; }

  void happen(event what, which order, bool is_first) {
    story_ += std::string(names.at(static_cast<std::size_t>(what))) + ", ";
    switch (what) {
    case event::answer:
      if (!is_answer_lost_)
        answer(vehicle_link::command_verdict::accepted);
      break;
    case event::older_heartbeat:
      hear_vehicle(before_);
      break;
    case event::newer_heartbeat:
      hear_vehicle(truth_);
      break;
    case event::persons_act:
      if (order == which::arm)
        truth_.is_armed = false;
      else
        truth_.mode = tests::hold_mode(from_.who);
      acted_ = moving_;
      has_acted_ = true;
      break;
    case event::answer_to_another:
      watch_->on_foreign({vehicle_link::foreign_kind::command, number(mav_cmd::do_set_mode), 255, 190, now_ns_});
      is_somebody_heard_ = true;
      break;
    case event::text:
      flight_->authority.on_text(from_.owner, "Disarmed by external command", now_ns_);
      break;
    case event::loss:
      if (is_first)
        truth_ = before_; // the order itself
      is_answer_lost_ = true;
      break;
    case event::kill:
      is_killed_ = true;
      begin_parts();
      recovery_->begin(true);
      break;
    }
    pass(60 * ms);
  }

  // Empty: all rules held.
  [[nodiscard]] std::string end() {
    answer(vehicle_link::command_verdict::timed_out);
    for (int i = 0; i < 12; ++i) {
      hear_vehicle(truth_);
      for (int part = 0; part < 4; ++part)
        pass(250 * ms);
    }
    if (orders_ > 1)
      return "the order was given " + std::to_string(orders_) + " times";
    if (has_acted_ && moving_ > acted_)
      return "after the person's act the vehicle was sent on";
    if (is_somebody_heard_ && !is_killed_ && durable_.status.cause != pause_cause::taken_over)
      return "who was heard to command the vehicle does not have it";
    return {};
  }

private:
  [[nodiscard]] instant now() const { return {now_ns_, 1'790'000'000'000'000'000 + now_ns_}; }

  void begin_parts() {
    recovery_.reset();
    watch_.reset();
    tasks_.reset();
    phases_.reset();
    due_.clear();
    settings configured;
    configured.arm_on_start = true;
    configured.start = start_policy::on_command;
    flight_ = std::make_unique<flight_context>(configured, durable_);
    phases_ = std::make_unique<phase_machine>(*flight_);
    tasks_ = std::make_unique<task_control>(*flight_, *phases_);
    watch_ = std::make_unique<control_watch>(*flight_, *phases_, *tasks_);
    recovery_ = std::make_unique<recovery>(*flight_, *phases_, *tasks_, *watch_);
    flight_->failsafe_status = failsafe::failsafe_status{};
    flight_->view.take(vehicle_link::connection_changed{vehicle_link::connection_phase::connected, {}});
  }

  void begin_task(effects& out, which order) {
    wanted_ = order;
    if (order == which::resume) {
      tasks_->begin(out, task_kind::resume, tasks_->guarded(going_on_steps(*flight_)));
    } else if (order == which::jump) {
      const auto sequence = static_cast<std::uint16_t>(durable_.progress.plan->generation.current + 1);
      tasks_->begin(out, task_kind::resume, tasks_->guarded(jump_steps(*flight_, sequence)));
    } else {
      phases_->go(out, trigger::start_begun);
      watch_->begin_start(out);
      tasks_->begin_start(out, {}, durable_.progress.plan->map.start_sequence);
    }
  }

  void hear_vehicle(const vehicle_truth& what) {
    io::mavlink::heartbeat m;
    m.autopilot = number(from_.owner.autopilot);
    m.type = from_.owner.vehicle == flight::vehicle_class::rover        ? 10
             : from_.owner.vehicle == flight::vehicle_class::fixed_wing ? 1
                                                                        : 2;
    m.custom_mode = what.mode;
    m.base_mode = static_cast<std::uint8_t>(1 | (what.is_armed ? 128 : 0));
    m.system_status = 4;
    flight_->view.take(m, now_ns_);
    io::mavlink::extended_sys_state landed;
    landed.landed_state = from_.is_in_air ? 2 : 1;
    flight_->view.take(landed);
    if (recovery_->has_looked())
      watch_->on_mode(now());
    decide();
  }

  void answer(vehicle_link::command_verdict how) {
    if (!waiting_)
      return;
    vehicle_link::command_outcome outcome;
    outcome.verdict = how;
    effects out;
    flight_->runner.on_command(flight_->world(now(), out), *std::exchange(waiting_, std::nullopt), outcome);
    execute(out);
  }

  void pass(std::int64_t ns) {
    now_ns_ += ns;
    for (auto due = std::exchange(due_, {}); auto& each : due)
      each();
    decide();
  }

  // The first rules of the executor's arbiter, in its order.
  void decide() {
    if (!is_begun_)
      return;
    for (int i = 0; i < 100; ++i) {
      effects out;
      if (!recovery_->look(out, now()) && !watch_->check_authority(out, now()) && !recovery_->resolve(out, now()))
        static_cast<void>(tasks_->run(out, now()));
      if (out.empty())
        return;
      execute(out);
    }
  }

  void execute(const effects& wanted) {
    for (const auto& each : wanted)
      if (const auto* kept = std::get_if<note>(&each)) {
        for (const auto& news : durable_core::apply(durable_, kept->what, now().wall_ns))
          if (const auto* start = std::get_if<progress::resolve_start>(&news))
            recovery_->on_news(*start, now());
      } else if (const auto* given = std::get_if<order>(&each)) {
        std::visit([&](const auto& what) { send(given->number, what); }, given->what);
      }
  }

  void send(std::uint64_t number_of, const failsafe::guard_mission&) {
    due_.emplace_back([this, number_of] {
      effects out;
      flight_->runner.on_guarded(flight_->world(now(), out), number_of, {}, true);
      execute(out);
    });
  }
  void send(std::uint64_t number_of, const vehicle_link::look&) {
    due_.emplace_back([this, number_of] {
      hear_vehicle(truth_);
      effects out;
      flight_->runner.on_looked(flight_->world(now(), out), number_of, {true, now_ns_, {}});
      execute(out);
    });
  }
  void send(std::uint64_t number_of, const vehicle_link::download_plan&) {
    due_.emplace_back([this, number_of] {
      vehicle_link::transfer::outcome outcome;
      outcome.verdict = vehicle_link::transfer::verdict::accepted;
      outcome.proof = vehicle_link::transfer::proof::read_back;
      outcome.items = durable_.flown->items;
      effects out;
      flight_->runner.on_transfer(flight_->world(now(), out), number_of, outcome);
      execute(out);
    });
  }
  void send(std::uint64_t, const vehicle_link::upload_plan&) { ADD_FAILURE() << "nothing is uploaded here"; }
  void send(std::uint64_t number_of, const vehicle_link::set_current_item&) {
    give(number_of, which::jump, {truth_.mode, truth_.is_armed});
  }
  void send(std::uint64_t number_of, const vehicle_link::send_command& what) {
    const auto mode = static_cast<std::uint32_t>(what.param2);
    const bool is_mode = what.command == number(mav_cmd::do_set_mode);
    const auto px4_mode =
        (static_cast<std::uint32_t>(what.param2) << 16U) | (static_cast<std::uint32_t>(what.param3) << 24U);
    const auto to = from_.owner.autopilot == io::mavlink::mav_autopilot::px4 ? px4_mode : mode;
    const auto mission = tests::mission_mode(from_.who);
    if (what.command == number(mav_cmd::component_arm_disarm) && what.param1 == 1)
      give(number_of, which::arm, {truth_.mode, true});
    else if (what.command == number(mav_cmd::mission_start))
      give(number_of, which::start, {mission, truth_.is_armed});
    else if (is_mode && to == mission)
      give(number_of, flight_->is_starting() ? which::start : which::resume, {mission, truth_.is_armed});
    else if (is_mode && flight::mode_of(from_.owner, to).kind == flight::mode_kind::guided)
      give(number_of, which::guided, {to, truth_.is_armed});
    else
      obey_at_once(number_of, to, is_mode);
  }

  // Holds, disarms, what moves nothing.
  void obey_at_once(std::uint64_t number_of, std::uint32_t to, bool is_mode) {
    if (is_mode)
      truth_.mode = to;
    else
      truth_.is_armed = false;
    accept_soon(number_of);
  }

  void give(std::uint64_t number_of, which kind, vehicle_truth after) {
    ++moving_;
    const bool is_the_one = kind == wanted_;
    before_ = truth_;
    truth_ = after;
    if (!is_the_one)
      return accept_soon(number_of);
    if (++orders_ == 1)
      waiting_ = number_of;
    else
      accept_soon(number_of);
  }

  void accept_soon(std::uint64_t number_of) {
    due_.emplace_back([this, number_of] {
      vehicle_link::command_outcome outcome;
      outcome.verdict = vehicle_link::command_verdict::accepted;
      effects out;
      flight_->runner.on_command(flight_->world(now(), out), number_of, outcome);
      execute(out);
      hear_vehicle(truth_);
    });
  }

  const beginning& from_;
  vehicle_truth truth_;
  vehicle_truth before_; // the order
  state durable_;
  std::unique_ptr<flight_context> flight_;
  std::unique_ptr<phase_machine> phases_;
  std::unique_ptr<task_control> tasks_;
  std::unique_ptr<control_watch> watch_;
  std::unique_ptr<recovery> recovery_;
  std::vector<std::function<void()>> due_;
  std::int64_t now_ns_ = 1'000 * 1'000 * ms;
  which wanted_ = which::arm;
  std::optional<std::uint64_t> waiting_; // the order, for its answer
  int orders_ = 0;                       // so often it was given
  int moving_ = 0;                       // orders that move the vehicle, all
  int acted_ = 0;                        // of these, before the person's act
  bool is_begun_ = false;
  bool has_acted_ = false;
  bool is_somebody_heard_ = false;
  bool is_answer_lost_ = false;
  bool is_killed_ = false;
  std::string story_;
};

class every_sequence : public testing::TestWithParam<std::tuple<personality, which>> {};

TEST_P(every_sequence, around_an_order_that_moves_the_vehicle_keeps_the_rules) {
  const auto [who, order] = GetParam();
  const auto from = before(order, who);
  int tried = 0;
  int failed = 0;
  std::vector<event> sequence;
  const std::function<void()> explore = [&] {
    if (!sequence.empty()) {
      order_world world(from, order);
      ASSERT_TRUE(world.is_given()) << "the order never goes out";
      for (std::size_t i = 0; i < sequence.size(); ++i)
        world.happen(sequence[i], order, i == 0);
      ++tried;
      if (const auto why = world.end(); !why.empty() && ++failed <= 5)
        ADD_FAILURE() << world.story() << why;
    }
    if (sequence.size() == 6)
      return;
    for (const auto next : all_events)
      if (std::ranges::find(sequence, next) == sequence.end()) {
        sequence.push_back(next);
        explore();
        sequence.pop_back();
        if (HasFatalFailure())
          return;
      }
  };
  explore();
  EXPECT_EQ(tried, 28'960);
  EXPECT_EQ(failed, 0);
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<personality, which>>& info) {
  constexpr std::array vehicles{"rover", "px4", "copter", "plane"}; // by personality
  constexpr std::array orders{"guided", "arm", "start", "resume", "jump"};
  return std::string(vehicles.at(static_cast<std::size_t>(std::get<0>(info.param)))) + "_" +
         orders.at(static_cast<std::size_t>(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(vehicles, every_sequence,
                         testing::Combine(testing::Values(personality::px4, personality::ardupilot, personality::plane),
                                          testing::Values(which::arm, which::start, which::resume, which::jump)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(rover, every_sequence,
                         testing::Combine(testing::Values(personality::rover),
                                          testing::Values(which::arm, which::start)),
                         name_of_case);
INSTANTIATE_TEST_SUITE_P(copter, every_sequence,
                         testing::Combine(testing::Values(personality::ardupilot), testing::Values(which::guided)),
                         name_of_case);

} // namespace every_sequence_test
} // namespace godwit::executor
