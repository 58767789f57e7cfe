// The health actor among peers that answer, or do not.
#include "actors/health/actor.hpp"

#include <gtest/gtest.h>

#include "runtime/simulation/simulation.hpp"

namespace health_actor_test {

using namespace godwit;
using namespace godwit::health;
using namespace std::chrono_literals;

using everybody_handle = runtime::mailbox<runtime::asks<vehicle_link::get_connection, vehicle_link::connection>,
                                          runtime::asks<executor::get_flight, executor::flight_status>>;

class everybody final : public runtime::actor_base<everybody_handle> {
public:
  everybody(runtime::spawn_context context, bool answers) : actor_base(std::move(context)), answers_(answers) {}

protected:
  behavior_type handlers() override {
    return {on_deferred<vehicle_link::get_connection, vehicle_link::connection>(
                [this](const vehicle_link::get_connection&, std::uint64_t request) {
                  if (answers_)
                    answer_later(request, vehicle_link::connection{});
                }),
            on<executor::get_flight>([](const executor::get_flight&) { return executor::flight_status{}; })};
  }

private:
  bool answers_;
};

using told = std::vector<health_status>;

class listener final : public runtime::actor_base<listener_handle> {
public:
  listener(runtime::spawn_context context, told* heard) : actor_base(std::move(context)), heard_(heard) {}

protected:
  behavior_type handlers() override {
    return {on<health_status>([this](const health_status& m) { heard_->push_back(m); })};
  }

private:
  told* heard_;
};

class ill_handle_holder final : public runtime::actor_base<runtime::mailbox<runtime::tells<make_report>>> {
public:
  using actor_base::actor_base;

protected:
  behavior_type handlers() override {
    return {on<make_report>([this](const make_report&) { show_health({runtime::health_colour::red, "it hurts"}); })};
  }
};

struct process {
  explicit process(bool answers) : world(disk, 1) {
    auto& actors = world.actors();
    const auto others = std::make_shared<peers>();
    const auto all = actors.add<everybody>({.name = "everybody"}, {}, answers);
    others->guardian = actors.guardian();
    others->vehicle = all;
    others->flight = all;
    others->listeners.emplace_back(actors.add<listener>({.name = "listener"}, {}, &heard));
    ill = actors.add<ill_handle_holder>({.name = "ill"}, {});
    who = actors.add<actor>({.name = "health", .policy = runtime::on_crash::lose}, {},
                            std::shared_ptr<const peers>(others), outside_world{[this] {
                              ++reads;
                              return host_figures();
                            }},
                            port);
    world.start();
    world.run_until_idle();
  }
  std::shared_ptr<report_port> port = std::make_shared<report_port>();
  told heard;
  int reads = 0;
  runtime::simulated_disk disk;
  runtime::simulation world;
  own_handle who;
  runtime::mailbox<runtime::tells<make_report>> ill;
};

TEST(health_actor, nobody_is_asked_before_somebody_wants_a_report) {
  process p(true);
  p.world.advance(10s);
  EXPECT_EQ(p.port->newest(), nullptr);
  EXPECT_EQ(p.reads, 0);
  EXPECT_GT(p.port->newest_health().at_ns, std::chrono::nanoseconds(9s).count());
}

TEST(health_actor, a_report_has_what_was_answered_and_no_part_that_there_is_none_of) {
  process p(true);
  int published = 0;
  p.port->on_published([&] { ++published; });
  p.world.tell(p.who, make_report{});
  p.world.run_until_idle();
  const auto made = p.port->newest();
  ASSERT_TRUE(made);
  EXPECT_EQ(published, 1);
  EXPECT_TRUE(made->vehicle && made->flight && !made->map && made->unanswered.empty());
  EXPECT_EQ(made->actors.size(), 4U);
  EXPECT_EQ(p.reads, 1);
}

TEST(health_actor, all_who_ask_while_a_report_is_made_get_that_one) {
  process p(false);
  int published = 0;
  p.port->on_published([&] { ++published; });
  for (int i = 0; i < 100; ++i)
    p.world.tell(p.who, make_report{});
  p.world.advance(3s);
  EXPECT_EQ(published, 1);
  ASSERT_EQ(p.port->newest()->unanswered.size(), 1U);
  EXPECT_EQ(p.port->newest()->unanswered.front().part, "vehicle");
}

TEST(health_actor, listeners_are_told_once_of_what_has_changed_within_a_second) {
  process p(true);
  p.world.advance(3s);
  const auto before = p.heard.size();
  p.world.tell(p.ill, make_report{});
  p.world.advance(5s);
  ASSERT_EQ(p.heard.size(), before + 1);
  EXPECT_EQ(p.heard.back().worst, colour::red);
  EXPECT_EQ(p.heard.back().parts.front().part, "ill");
  EXPECT_EQ(p.heard.back().parts.front().reason, "it hurts");
}

TEST(health_actor, who_asks_is_answered_with_the_board_as_it_is_now) {
  process p(true);
  p.world.tell(p.ill, make_report{});
  p.world.run_until_idle();
  const auto asked = p.world.ask(p.who, 1s, get_health{});
  p.world.run_until_idle();
  ASSERT_EQ(asked->answers, 1);
  EXPECT_EQ(asked->answer.worst, colour::red);
}

TEST(health_actor, a_crash_costs_one_report_and_the_next_incarnation_goes_on) {
  process p(true);
  p.world.crash_at("health", runtime::crash_point::after_handler);
  p.world.tell(p.who, make_report{});
  p.world.advance(1s);
  EXPECT_EQ(p.world.counters("health").crashes, 1U);
  p.world.tell(p.who, make_report{});
  p.world.run_until_idle();
  EXPECT_NE(p.port->newest(), nullptr);
}

} // namespace health_actor_test
