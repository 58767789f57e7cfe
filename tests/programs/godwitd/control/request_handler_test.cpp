// The control request_handler: who answers it, who does not.
#include "programs/godwitd/control/request_handler.hpp"

#include <gtest/gtest.h>

#include <sys/eventfd.h>

#include "runtime/actor_base.hpp"
#include "runtime/simulation/simulation.hpp"

namespace request_handler_test {

using namespace godwit;
using namespace godwit::control;
using namespace std::chrono_literals;
using nlohmann::json;

// Answers all that the request_handler asks, or nothing at all.
using everybody_handle = runtime::mailbox<runtime::asks<mission_client::retry_outbox, mission_client::retry_answer>,
                                          runtime::asks<mission_client::get_service, mission_client::service_status>,
                                          runtime::asks<vehicle_link::get_connection, vehicle_link::connection>,
                                          runtime::asks<vehicle_link::set_up_signing, vehicle_link::signing_answer>,
                                          runtime::asks<ground_run::get_run, ground_run::run_status>,
                                          runtime::asks<operators::command, operators::answer>,
                                          runtime::asks<executor::get_flight, executor::flight_status>,
                                          runtime::asks<failsafe::override_rule, failsafe::override_answer>,
                                          runtime::asks<scan_controller::get_points, scan_controller::points>,
                                          runtime::asks<scan_controller::decide_point, scan_controller::decide_answer>>;

class everybody final : public runtime::actor_base<everybody_handle> {
public:
  everybody(runtime::spawn_context context, bool answers) : actor_base(std::move(context)), answers_(answers) {}

private:
  template <class Q, class F>
  auto late(F make) {
    using answer = std::invoke_result_t<F, const Q&>;
    return on_deferred<Q, answer>([this, make](const Q& question, std::uint64_t request) {
      if (answers_)
        answer_later(request, make(question));
    });
  }

protected:
  behavior_type handlers() override {
    return {
        late<mission_client::retry_outbox>([](const auto& m) {
          return mission_client::retry_answer{2, 1, m.key};
        }),
        late<mission_client::get_service>([](const auto&) { return mission_client::service_status{}; }),
        late<vehicle_link::get_connection>([](const auto&) { return vehicle_link::connection{}; }),
        late<vehicle_link::set_up_signing>([](const auto& m) {
          return vehicle_link::signing_answer{!m.off, m.off ? "not while the vehicle is armed" : ""};
        }),
        late<ground_run::get_run>([](const auto&) { return ground_run::run_status{}; }),
        late<operators::command>([](const auto& m) {
          if (m.kind == operators::command_kind::insert)
            return operators::answer{m.place && m.place->latitude == 47.5 && m.place->altitude_m == 40, "elsewhere"};
          const bool is_start = m.kind == operators::command_kind::start;
          return operators::answer{is_start, is_start ? "" : "not now"};
        }),
        late<executor::get_flight>([](const auto&) { return executor::flight_status{}; }),
        late<failsafe::override_rule>([](const auto& m) {
          return failsafe::override_answer{m.until_ns > 0, m.reason};
        }),
        late<scan_controller::get_points>([](const auto&) {
          scan_controller::points result;
          auto& confirmed = result.confirmed.emplace_back();
          confirmed.number = 3;
          confirmed.position = {47.5, 8.5, 500.0};
          result.shown.emplace_back().number = 4;
          return result;
        }),
        late<scan_controller::decide_point>([](const auto& m) {
          return scan_controller::decide_answer{m.number == 4, "no such point"};
        })};
  }

private:
  bool answers_;
};

class map_stand_in final : public runtime::actor_base<mapobjects_store::operator_handle> {
public:
  using actor_base::actor_base;

protected:
  behavior_type handlers() override {
    namespace ms = mapobjects_store;
    return {on<ms::operator_verdict>([](const ms::operator_verdict&) { return ms::verdict_answer{}; }),
            on<ms::acknowledge_fallback>([](const ms::acknowledge_fallback&) { return ms::map_answer{}; }),
            on<ms::requeue_mission>([](const ms::requeue_mission&) { return ms::moved_rows{}; }),
            on<ms::get_owed>([](const ms::get_owed&) { return ms::owed_list{}; }),
            on<ms::get_map>([](const ms::get_map&) { return ms::map_status{}; })};
  }
};

// Asks the executor, as the real one does, or is silent.
class bridge_stand_in final : public runtime::actor_base<operator_bridge::handler_handle> {
public:
  using executor_handle = runtime::mailbox<runtime::asks<operators::command, operators::answer>>;
  bridge_stand_in(runtime::spawn_context context, const bool* answers, executor_handle executor,
                  std::vector<operator_bridge::audit_note>* notes)
      : actor_base(std::move(context)), answers_(answers), executor_(std::move(executor)), notes_(notes) {}

protected:
  behavior_type handlers() override {
    namespace ob = operator_bridge;
    return {on_deferred<ob::operator_command, ob::command_answer>(
                [this](const ob::operator_command& m, std::uint64_t request) { take(m, request); }),
            on<ob::change_control>([](const ob::change_control& m) {
              return ob::control_answer{true, {}, m.by.name};
            }),
            on<ob::get_operators>([](const ob::get_operators&) { return ob::operators_view{}; }),
            on<ob::read_audit>(
                [](const ob::read_audit& m) { return ob::audit_leave{m.by.name == "anna" ? "" : "not for you"}; }),
            on<ob::audit_note>([this](const ob::audit_note& m) { notes_->push_back(m); }),
            on<ob::make_link>([](const ob::make_link&) {
              return ob::link_answer{true, {}, 1};
            }),
            on_deferred<ob::ask_leave, ob::leave>([this](const ob::ask_leave& m, std::uint64_t request) {
              if (*answers_)
                answer_later(request, m.by.name == "bob" ? ob::leave{ob::verdict::no_control, "anna has control"}
                                                         : ob::leave{ob::verdict::taken, {}});
            })};
  }

private:
  void take(const operator_bridge::operator_command& m, std::uint64_t request) {
    using operator_bridge::verdict;
    if (!*answers_)
      return;
    ask(
        executor_, 1s, m.what,
        [this, request](const operators::answer& answer) {
          answer_later(request, operator_bridge::command_answer{answer.is_taken ? verdict::taken : verdict::refused,
                                                                answer.reason});
        },
        [](const runtime::ask_error&) {});
  }

  const bool* answers_;
  executor_handle executor_;
  std::vector<operator_bridge::audit_note>* notes_;
};

struct process {
  explicit process(bool answers, bool has_service = true, bool flies = false) : world(disk, 1) {
    const auto all = world.actors().add<everybody>({.name = "everybody"}, {}, answers);
    peers others;
    others.store = world.actors().add<map_stand_in>({.name = "map"}, {});
    others.vehicle = all;
    others.guardian = world.actors().guardian();
    if (flies) {
      others.flight = all;
      others.bridge = world.actors().add<bridge_stand_in>({.name = "bridge"}, {}, &bridge_answers, all, &notes);
      others.read_audit = [](const operator_bridge::audit_query& wanted, const auto& then) {
        if (wanted.before == 404)
          return then(tl::make_unexpected(std::string("the disk is gone")));
        then(operator_bridge::audit_page{std::vector<operator_bridge::audit_row>(wanted.most), wanted.before == 9});
      };
      others.failsafe = all;
      others.points = all;
      others.crash = [](const std::string& name) { return name == "executor"; };
    } else {
      others.run = all;
    }
    if (has_service)
      others.client = all;
    who = world.actors().add<request_handler>({.name = "control_handler"}, {}, others, box);
    world.start();
    world.run_until_idle();
  }
  json ask(control_request asked) {
    asked.ticket = 7;
    world.tell(who, std::move(asked));
    world.advance(5s);
    const auto answers = box->take();
    EXPECT_EQ(answers.size(), 1U);
    return answers.size() == 1 && answers.front().ticket == 7 ? json::parse(answers.front().line) : json();
  }
  bool bridge_answers = true;
  std::vector<operator_bridge::audit_note> notes;
  std::shared_ptr<response_queue> box =
      std::make_shared<response_queue>(io::link::descriptor(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)));
  runtime::simulated_disk disk;
  runtime::simulation world;
  request_handle who;
};

TEST(control_requests, a_status_is_the_word_of_all_parts) {
  const auto answer = process(true).ask({});
  for (const auto* part : {"run", "map", "vehicle", "service", "actors"})
    EXPECT_TRUE(answer.contains(part)) << part;
  EXPECT_EQ(answer.at("ok"), true);
  EXPECT_FALSE(process(true, false).ask({}).contains("service"));
}

TEST(control_requests, a_status_has_each_actor_as_the_guardian_sees_it) {
  const auto actors = process(true).ask({}).at("actors").at("list");
  ASSERT_EQ(actors.size(), 3U);
  EXPECT_EQ(actors[2].at("name"), "control_handler");
  EXPECT_EQ(actors[2].at("phase"), "running");
  EXPECT_EQ(actors[2].at("incarnation"), 1);
  EXPECT_EQ(actors[2].at("health"), "green");
}

TEST(control_requests, a_part_that_does_not_answer_holds_up_nobody_and_is_said) {
  const auto answer = process(false).ask({});
  EXPECT_EQ(answer.at("map").at("sync"), "fresh_boot");
  EXPECT_TRUE(answer.at("vehicle").contains("error"));
}

control_request retry(const std::string& key) {
  control_request result;
  result.what = request_kind::outbox_retry;
  result.key = key;
  return result;
}

TEST(control_requests, a_retry_is_mission_clients_answer) {
  const auto all = process(true).ask(retry(""));
  EXPECT_EQ(all.at("ok"), true);
  EXPECT_EQ(all.at("tried_now"), 2);
  EXPECT_EQ(process(true).ask(retry("no such row")).at("ok"), false);
  EXPECT_EQ(process(false).ask(retry("")).at("ok"), false);
  EXPECT_EQ(process(true, false).ask(retry("")).at("ok"), false);
}

control_request command(operators::command_kind what) {
  control_request result;
  result.what = request_kind::command;
  result.said.kind = what;
  return result;
}

TEST(control_requests, a_word_is_taken_or_refused_with_the_executors_reason) {
  EXPECT_EQ(process(true, true, true).ask(command(operators::command_kind::start)).at("ok"), true);
  const auto refused = process(true, true, true).ask(command(operators::command_kind::pause));
  EXPECT_EQ(refused.at("ok"), false);
  EXPECT_EQ(refused.at("error"), "not now");
  EXPECT_EQ(process(false, true, true).ask(command(operators::command_kind::start)).at("ok"), false) << "no answer";
}

TEST(control_requests, a_hold_and_a_return_reach_the_executor_also_when_operator_bridge_does_not_answer) {
  for (const auto kind : {operators::command_kind::pause, operators::command_kind::come_home}) {
    process p(true, true, true);
    p.bridge_answers = false;
    EXPECT_EQ(p.ask(command(kind)).at("error"), "not now") << "the executor's own words";
    ASSERT_EQ(p.notes.size(), 1U);
    EXPECT_NE(p.notes[0].what.find("past operator_bridge"), std::string::npos);
  }
}

TEST(control_requests, any_other_command_is_not_taken_past_operator_bridge) {
  process p(true, true, true);
  p.bridge_answers = false;
  const auto answer = p.ask(command(operators::command_kind::start));
  EXPECT_EQ(answer.at("ok"), false);
  EXPECT_NE(answer.at("error").get<std::string>().find("operator_bridge"), std::string::npos);
}

TEST(control_requests, control_and_the_audit_are_asked_of_operator_bridge) {
  control_request asked;
  asked.by = "anna";
  asked.what = request_kind::control;
  EXPECT_EQ(process(true, true, true).ask(asked).at("holder"), "anna");
  EXPECT_EQ(process(true).ask(asked).at("ok"), false);
  asked.what = request_kind::login;
  EXPECT_EQ(process(true, true, true).ask(asked).at("valid_until_ns"), 1);
  EXPECT_EQ(process(true).ask(asked).at("ok"), false);
  asked.what = request_kind::audit;
  asked.rows = 7;
  asked.before = 9;
  const auto page = process(true, true, true).ask(asked);
  EXPECT_EQ(page.at("rows").size(), 7U);
  EXPECT_EQ(page.at("has_older"), true);
  EXPECT_EQ(page.at("ok"), true);
  asked.before = 404;
  EXPECT_EQ(process(true, true, true).ask(asked).at("error"), "the disk is gone");
  asked.by = "eve";
  EXPECT_EQ(process(true, true, true).ask(asked).at("error"), "not for you");
  EXPECT_EQ(process(true).ask(asked).at("ok"), false);
}

TEST(control_requests, who_runs_on_the_ground_takes_no_word) {
  EXPECT_EQ(process(true).ask(command(operators::command_kind::start)).at("ok"), false);
  control_request override_it;
  override_it.what = request_kind::override_rule;
  EXPECT_EQ(process(true).ask(override_it).at("ok"), false);
}

TEST(control_requests, an_override_goes_to_the_failsafe_with_its_end) {
  control_request asked;
  asked.what = request_kind::override_rule;
  asked.lasts_s = 60;
  EXPECT_EQ(process(true, true, true).ask(asked).at("ok"), true);
}

TEST(control_requests, the_signing_key_is_given_to_the_vehicle_and_the_audit_has_who_said_so) {
  control_request asked;
  asked.what = request_kind::sign;
  asked.by = "anna";
  process p(true, true, true);
  EXPECT_EQ(p.ask(asked).at("ok"), true);
  asked.ends_signing = true;
  EXPECT_EQ(p.ask(asked).at("error"), "not while the vehicle is armed");
  ASSERT_EQ(p.notes.size(), 2U);
  EXPECT_EQ(p.notes[0].what, "give the signing key");
  EXPECT_EQ(p.notes[0].outcome, "taken");
  EXPECT_EQ(p.notes[0].who.name, "anna");
  EXPECT_EQ(p.notes[1].what, "end signing");
  EXPECT_EQ(p.notes[1].outcome, "refused");
  EXPECT_EQ(process(true).ask(asked).at("ok"), false) << "on the ground there is no audit";
}

TEST(control_requests, a_flight_is_a_part_of_the_status) {
  const auto answer = process(true, true, true).ask({});
  EXPECT_TRUE(answer.contains("flight"));
  EXPECT_EQ(answer.at("points").at("shown").at(0).at("number"), 4);
  EXPECT_FALSE(answer.contains("run"));
}

TEST(control_requests, points_are_listed_and_decided_about) {
  const auto listed = process(true, true, true).ask({0, request_kind::points, "", {}, {}, 0});
  EXPECT_EQ(listed.at("ok"), true);
  EXPECT_EQ(listed.at("shown").at(0).at("number"), 4);
  control_request decision;
  decision.what = request_kind::decide_point;
  decision.decided = {4, scan_controller::decision::confirm, "anna"};
  process p(true, true, true);
  EXPECT_EQ(p.ask(decision).at("ok"), true);
  ASSERT_EQ(p.notes.size(), 1U) << "the audit has it";
  EXPECT_EQ(p.notes[0].what, "confirm point 4");
  EXPECT_EQ(p.notes[0].outcome, "taken");
  decision.decided.number = 9;
  EXPECT_EQ(process(true, true, true).ask(decision).at("error"), "no such point");
  EXPECT_EQ(process(true).ask(decision).at("ok"), false) << "on the ground nobody looks for points";
}

TEST(control_requests, about_a_point_decides_who_may_command_and_nobody_while_operator_bridge_does_not_answer) {
  control_request decision;
  decision.what = request_kind::decide_point;
  decision.decided = {4, scan_controller::decision::confirm, "bob"};
  decision.by = "bob";
  process p(true, true, true);
  EXPECT_EQ(p.ask(decision).at("error"), "anna has control");
  EXPECT_TRUE(p.notes.empty()) << "operator_bridge has written its row";
  decision.by = "anna";
  p.bridge_answers = false;
  EXPECT_NE(p.ask(decision).at("error").get<std::string>().find("operator_bridge"), std::string::npos);
}

TEST(control_requests, a_waypoint_is_inserted_at_a_point_that_a_person_has_confirmed_and_at_no_other) {
  auto insert = command(operators::command_kind::insert);
  insert.said.place.emplace().altitude_m = 40;
  insert.point = 3;
  EXPECT_EQ(process(true, true, true).ask(insert).at("ok"), true);
  insert.point = 4;
  const auto refused = process(true, true, true).ask(insert);
  EXPECT_EQ(refused.at("ok"), false);
  EXPECT_NE(refused.at("error").get<std::string>().find("not confirmed"), std::string::npos);
  EXPECT_EQ(process(false, true, true).ask(insert).at("ok"), false) << "no answer";
}

TEST(control_requests, a_crash_is_for_drills_and_of_an_actor_that_runs) {
  control_request crash;
  crash.what = request_kind::crash;
  crash.key = "executor";
  EXPECT_EQ(process(true).ask(crash).at("ok"), false) << "not allowed";
  EXPECT_EQ(process(true, true, true).ask(crash).at("ok"), true);
  crash.key = "nobody";
  EXPECT_EQ(process(true, true, true).ask(crash).at("ok"), false);
}

} // namespace request_handler_test
