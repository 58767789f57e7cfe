// A process of actors for tests: one thread, virtual time, every step chosen by the test, every run repeatable from its
// seed.
//
//   simulated_disk disk;
//   simulation world(disk, seed);
//   auto counter = world.actors().add<counter_actor>({.name = "counter"}, {});
//   world.start();
//   world.tell(counter, add{1});
//   world.crash_at("counter", crash_point::after_handler);  // the next message there throws
//   world.step(k) / world.settle() / world.advance(1s);
//
// Destroying it without stop() is the process being killed: mailboxes and what was not committed are gone, the disk
// stays. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <caf/scheduler/test_coordinator.hpp>

#include "runtime/random.hpp"
#include "runtime/simulation/simulated_journal.hpp"
#include "runtime/system.hpp"
#include "runtime/trace/memory_trace.hpp"

namespace godwit::runtime {

class simulated_time final : public time_source {
public:
  void follow(caf::scheduler::test_coordinator& scheduler) { scheduler_ = &scheduler; }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override {
    return scheduler_ == nullptr ? 0 : scheduler_->clock().now().time_since_epoch().count();
  }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return start_ns + monotonic_ns(); }

  static constexpr std::int64_t start_ns = 1'800'000'000'000'000'000; // 2027-01-15, a round number

private:
  caf::scheduler::test_coordinator* scheduler_ = nullptr;
};

// Crashes that the test asked for: the next time ACTOR passes POINT it throws.
class planned_crashes final : public crash_points {
public:
  explicit planned_crashes(const directory& names) : names_(names) {}
  void plan(std::string actor, crash_point point) { plans_.push_back({std::move(actor), point}); }
  void clear() { plans_.clear(); }
  void hit(crash_point point, std::uint32_t actor, std::uint64_t message) override;

private:
  struct plan_entry {
    std::string actor;
    crash_point point;
  };
  const directory& names_;
  std::vector<plan_entry> plans_;
};

// How an ask of the test went.
template <class R>
struct asked {
  int answers = 0;
  int failures = 0;
  R answer{};
  ask_error failure;
};

class simulation {
public:
  simulation(simulated_disk& disk, std::uint64_t seed, system_options options = {}, bool traced = true);
  simulation(const simulation&) = delete;
  simulation& operator=(const simulation&) = delete;
  ~simulation();

  [[nodiscard]] runtime::system& actors() { return *system_; }
  [[nodiscard]] simulated_journal& journal() { return journal_; }
  [[nodiscard]] const health_board& health() const { return health_; }
  [[nodiscard]] const memory_trace& trace() const { return trace_; }
  [[nodiscard]] std::optional<exit_request> exit() const { return system_->exit_requested(); }
  [[nodiscard]] std::int64_t now_ns() const { return time_.monotonic_ns(); }

  void start();
  // Runs one thing that can happen now, chosen by CHOICE: an actor's next message or a step of the journal. False: none
  // can.
  bool step(std::uint64_t choice);
  void settle(); // until nothing can happen without time passing
  void advance(std::chrono::nanoseconds duration);
  [[nodiscard]] bool stop(); // in order; true when all ended

  void crash_at(const std::string& actor, crash_point point) { crashes_.plan(actor, point); }
  void forget_planned_crashes() { crashes_.clear(); }
  // Ends the incarnation between two messages. False: there is none now.
  bool kill(const std::string& actor);
  [[nodiscard]] address_counters counters(const std::string& actor) const;

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell(const Handle& to, T body) { gateway_->tell(to, std::move(body)); }

  template <class Handle, class Q>
  requires accepts<Handle, Q> std::shared_ptr<asked<answer_t<Handle, Q>>>
  ask(const Handle& to, std::chrono::nanoseconds timeout, Q question) {
    using answer_type = answer_t<Handle, Q>;
    auto result = std::make_shared<asked<answer_type>>();
    const header head{++asked_, 0, 0, 0, 0};
    asker_->context(nullptr); // the one from its last turn is gone
    asker_->request(to, caf::duration{timeout}, mail<Q>{head, std::move(question)})
        .then(
            [result](const mail<answer_type>& m) {
              ++result->answers;
              result->answer = m.body;
            },
            [result](const caf::error& why) {
              ++result->failures;
              result->failure = describe(why);
            });
    return result;
  }

private:
  [[nodiscard]] stable_address* find(const std::string& actor) const;

  directory names_;
  health_board health_;
  simulated_time time_;
  simulated_journal journal_;
  memory_trace trace_;
  planned_crashes crashes_;
  std::unique_ptr<runtime::system> system_;
  caf::scheduler::test_coordinator* scheduler_ = nullptr;
  std::optional<gateway> gateway_;
  caf::event_based_actor* asker_ = nullptr;
  caf::strong_actor_ptr asker_alive_;
  std::uint64_t asked_ = 0;
};

} // namespace godwit::runtime
