// Whatever happens in whatever order: no report is lost, none counts twice, the order is kept, and one key never has
// two bodies.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "tests/actors/mission_client/client_world.hpp"

namespace actor_property_test {

using namespace godwit;
using namespace godwit::mission_client;
using namespace godwit::mission_client::test;
using namespace std::chrono_literals;
using runtime::crash_point;

enum class op {
  send_report,
  say_insert,
  assign,
  see,
  push,
  break_service,
  mend,
  crash,
  kill_actor,
  kill_process,
  wait,
  retry
};
constexpr int ops = 12;

const std::vector<planned_fault>& faults() {
  static const std::vector<planned_fault> all{
      {.what = fault::no_connection},
      {.what = fault::lost_answer},
      {.what = fault::silence, .times = 3},
      {.what = fault::cut_answer, .posts_only = true},
      {.what = fault::status_answer, .status = 503},
      {.what = fault::status_answer, .status = 429, .retry_after_ns = 5 * second_ns, .times = 2},
      {.where = "/progress", .what = fault::status_answer, .status = 401},
      {.where = "/mapobjects", .what = fault::status_answer, .status = 404, .posts_only = true},
      {.where = "/progress", .what = fault::status_answer, .status = 404, .times = 1},
      {.where = "/mapobjects", .what = fault::lost_answer, .posts_only = true}};
  return all;
}

class sequence {
public:
  sequence() {
    around.service.add(sample_mission(mission_a));
    begin_process();
  }

  void take(op what, int number) {
    switch (what) {
    case op::send_report:
      return say([n = ++reports](process& p) { p.say(report(mission_a, n)); });
    case op::say_insert:
      return say([n = ++inserts, base = around.service.at(mission_a).document.revision](process& p) {
        p.say(insert(mission_a, base, n));
      });
    case op::assign:
      around.service.assign(mission_a, sample_assignment(around.service.at(mission_a).document, ++assignments));
      return;
    case op::see:
      seen += static_cast<std::size_t>(number % 700);
      around.store.owe(mission_a, number % 700);
      return;
    case op::push:
      return p_->say(push_map{mission_a});
    case op::break_service:
      around.service.faults = {faults().at(static_cast<std::size_t>(number) % faults().size())};
      return;
    case op::mend:
      around.service.faults.clear();
      return;
    case op::crash: // one at a time: a message that crashes its handler three times becomes a dead letter
      p_->world.forget_planned_crashes();
      p_->advance(100ms);
      p_->world.crash_at("mission_client", static_cast<crash_point>(number % 4));
      return;
    case op::kill_actor:
      p_->world.kill("mission_client");
      return;
    case op::kill_process:
      p_.reset();
      return begin_process();
    case op::wait:
      return p_->advance(std::chrono::milliseconds(number));
    case op::retry:
      (void)p_->retry();
      return;
    }
  }

  // All is well again, and a person queues again what had to wait for one.
  void end() {
    around.service.faults.clear();
    p_->world.forget_planned_crashes();
    for (int i = 0; i < 3; ++i) {
      p_->advance(15s);
      p_->say(begin_mission{mission_a}); // it may have been refused
      p_->say(push_map{mission_a});
      (void)p_->retry();
    }
    p_->advance(60s);
  }

  [[nodiscard]] service_status status() { return p_->status(); }

  outside around;
  std::uint32_t reports = 0;
  std::uint64_t inserts = 0;
  int assignments = 0;
  std::size_t seen = 0;

private:
  void begin_process() {
    p_ = std::make_unique<process>(around);
    p_->say(begin_mission{mission_a});
    for (const auto& each : said_) // as one does whose effects are durable
      each(*p_);
  }
  void say(std::function<void(process&)> what) {
    what(*p_);
    said_.push_back(std::move(what));
  }

  std::unique_ptr<process> p_;
  std::vector<std::function<void(process&)>> said_;
};

RC_GTEST_PROP(mission_client_property, nothing_is_lost_nothing_doubled_and_order_is_kept, ()) {
  const auto steps = *rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange<int>(0, ops), rc::gen::inRange<int>(0, 5'000)));
  sequence s;
  for (const auto& [what, number] : steps)
    s.take(static_cast<op>(what), number);
  s.end();
  const auto& m = s.around.service.at(mission_a);
  RC_ASSERT(m.reports.size() == s.reports);
  for (std::uint32_t i = 0; i < s.reports; ++i)
    RC_ASSERT(m.reports[i].report_no == i + 1);
  RC_ASSERT(m.observations.size() == s.seen);
  RC_ASSERT(s.around.store.owed() == 0U);
  RC_ASSERT(s.around.service.other_bodies == 0);
  RC_ASSERT(s.around.service.at_once <= 1);
  RC_ASSERT(m.changes <= static_cast<int>(s.inserts));
  const auto done = std::ranges::count(s.around.listener.outcomes, change_verdict::done, &change_outcome::verdict);
  RC_ASSERT(m.changes >= 1 || done == 0);
  RC_ASSERT(s.status().pending == 0U);
  RC_ASSERT(s.status().orphaned == 0U);
  // Whoever listens has the newest mission.
  std::int32_t newest = 0;
  for (const auto& each : s.around.listener.loaded)
    newest = std::max(newest, each.document.revision);
  RC_ASSERT(newest == m.document.revision);
}

} // namespace actor_property_test
