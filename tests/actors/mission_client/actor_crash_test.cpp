// mission_client under crashes and kills: at every message and every crash point of a flight, enumerated.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>

#include "tests/actors/mission_client/client_world.hpp"

namespace actor_crash_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::crash_point;

constexpr std::uint32_t reports = 3;
constexpr int observations = 30;
constexpr int ignored_items = 5;

settings small_batches() {
  settings result;
  result.batch_limit = 10;
  result.page_limit = 10;
  return result;
}

// When something happens to mission_client: after so many of its messages.
struct injection {
  std::size_t after = 0;
  std::optional<crash_point> where; // none: the whole process is killed
};

// One flight from the fetch to the push, by somebody who says the next thing when he was told the last one, and who
// says all of it again to a new process, as one with durable effects does.
class flight {
public:
  explicit flight(injection what) : what_(what) {
    auto& m = around.service.add(sample_mission(mission_a));
    for (std::uint64_t i = 0; i < 25; ++i)
      m.map_objects.push_back(
          {uuid(i, 'c'), "vehicle", 47.4, 8.5, {}, 0.5, "2026-05-01T08:00:00Z", "2026-05-03T16:20:00Z"});
    around.store.owe(mission_a, observations, ignored_items);
    begin_process();
  }

  // False: it came to no end.
  [[nodiscard]] bool fly() {
    for (int i = 0; i < 100'000 && around.listener.resolved.empty(); ++i) {
      inject();
      if (p_->world.step(0))
        continue;
      say_next();
      p_->exchange();
      if (!p_->world.step(0))
        p_->world.advance(10ms);
    }
    p_->advance(2s);
    return !around.listener.resolved.empty();
  }
  [[nodiscard]] bool was_injected() const { return injected_; }
  [[nodiscard]] std::uint64_t crashes() const { return p_->world.counters("mission_client").crashes; }

  outside around;

private:
  void begin_process() {
    p_ = std::make_unique<process>(around, small_batches());
    for (int i = 0; i < said_; ++i)
      say(i);
  }
  [[nodiscard]] std::size_t messages() const {
    std::size_t result = 0;
    for (const auto& each : p_->world.trace().lines())
      result += each.find(" mission_client/") != std::string::npos ? 1 : 0;
    return result;
  }
  void inject() {
    if (injected_ || messages() < what_.after)
      return;
    injected_ = true;
    if (what_.where) {
      p_->world.crash_at("mission_client", *what_.where);
    } else {
      p_.reset();
      begin_process();
    }
  }
  void say_next() {
    const auto& told = around.listener;
    const std::array<bool, 5> may_say{true, !told.pulled.empty(), !told.pulled.empty(), !told.outcomes.empty(),
                                      !told.arrived.empty()};
    if (said_ < 6 &&
        (said_ == 5 ? !around.service.at(mission_a).responses.empty() : may_say[static_cast<std::size_t>(said_)])) {
      if (said_ == 3)
        around.service.assign(mission_a, sample_assignment(around.service.at(mission_a).document, 1));
      say(said_++);
    }
  }
  void say(int step) {
    switch (step) {
    case 0:
      return p_->say(begin_mission{mission_a});
    case 1:
      for (std::uint32_t i = 1; i <= reports; ++i)
        p_->say(report(mission_a, i));
      return;
    case 2:
      return p_->say(insert(mission_a, 1, 1));
    case 4:
      return p_->say(
          response(mission_a, around.listener.arrived.front().assignment, mission::assignment_outcome::accepted, 1));
    case 5:
      return p_->say(push_map{mission_a});
    default:
      return;
    }
  }

  injection what_;
  bool injected_ = false;
  int said_ = 0;
  std::unique_ptr<process> p_;
};

void expect_each_once(const flight& f) {
  const auto& m = f.around.service.missions.at(mission_a);
  ASSERT_EQ(m.reports.size(), reports);
  for (std::uint32_t i = 0; i < reports; ++i)
    EXPECT_EQ(m.reports[i].report_no, i + 1);
  EXPECT_EQ(m.changes, 1);
  EXPECT_EQ(m.responses.size(), 1U);
  EXPECT_EQ(m.observations.size(), static_cast<std::size_t>(observations));
  EXPECT_EQ(m.ignored.size(), static_cast<std::size_t>(ignored_items));
  EXPECT_EQ(f.around.store.owed(), 0U);
  EXPECT_EQ(f.around.store.objects.size(), 25U);
  EXPECT_EQ(f.around.service.other_bodies, 0);
  EXPECT_LE(f.around.service.at_once, 1);
  EXPECT_TRUE(f.around.disk.dead_letters.empty());
  EXPECT_EQ(f.around.listener.pulled.back().state, pull_state::synced);
  EXPECT_EQ(f.around.listener.outcomes.back().verdict, change_verdict::done);
  std::int32_t revision = 0;
  for (const auto& each : f.around.listener.loaded)
    revision = std::max(revision, each.document.revision);
  EXPECT_EQ(revision, 2);
}

TEST(mission_client_crashes, at_every_message_and_crash_point_of_a_flight_all_is_once_in_effect) {
  for (const auto where : {crash_point::before_handler, crash_point::after_handler, crash_point::after_commit,
                           crash_point::before_dispatch})
    for (std::size_t after = 0;; ++after) {
      flight f({after, where});
      ASSERT_TRUE(f.fly()) << after;
      expect_each_once(f);
      // Nobody has forgotten anything, so that nobody hears anything twice.
      EXPECT_EQ(f.around.listener.pulled.size(), 1U);
      EXPECT_EQ(f.around.listener.outcomes.size(), 1U);
      EXPECT_EQ(f.around.listener.resolved.size(), 1U);
      if (HasFailure() || !f.was_injected()) {
        EXPECT_FALSE(HasFailure()) << "crash point " << static_cast<int>(where) << " after message " << after;
        EXPECT_GT(after, 60U);
        break;
      }
      EXPECT_LE(f.crashes(), 1U);
    }
}

TEST(mission_client_crashes, a_process_killed_at_every_message_of_a_flight_goes_on_and_all_is_once_in_effect) {
  for (std::size_t after = 0;; ++after) {
    flight f({after, std::nullopt});
    ASSERT_TRUE(f.fly()) << after;
    expect_each_once(f);
    if (HasFailure() || !f.was_injected()) {
      EXPECT_FALSE(HasFailure()) << "killed after message " << after;
      EXPECT_GT(after, 60U);
      break;
    }
  }
}

} // namespace actor_crash_test
