// A process of actors for tests: one thread, virtual time, every step chosen by the test, every run repeatable from its
// seed.
//
//   simulated_disk disk;
//   simulation world(disk, seed);
//   auto counter = world.actors().add<counter_actor>({.name = "counter"}, {});
//   world.start();
//   world.tell(counter, add{1});
//   world.crash_at("counter", crash_point::after_handler);  // the next message there throws
//   world.step(k) / world.run_until_idle() / world.advance(1s);
//
// Destroying it without stop() is the process being killed: mailboxes and what was not committed are gone, the disk
// stays. Thread: one.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/fields/binary.hpp"
#include "runtime/ask_error.hpp"
#include "runtime/clock.hpp"
#include "runtime/directory.hpp"
#include "runtime/envelope.hpp"
#include "runtime/random.hpp"
#include "runtime/simulation/simulated_journal.hpp"
#include "runtime/system.hpp"
#include "runtime/trace/trace_sink.hpp"

namespace godwit::runtime {

// A trace in memory: lines of text, for tests that compare runs or ask what an actor did. Thread: one.
class memory_trace final : public trace_sink {
public:
  memory_trace(const directory& names, const time_source& time) : names_(names), time_(time) {}

  [[nodiscard]] std::int64_t ticks() const noexcept override { return time_.monotonic_ns(); }

  // One line: "1200 ns counter/2 <- outside #17 because #3 add{"by":1} crashed"
  void record(const trace_entry& entry, const message_type& type, const void* body) noexcept override {
    std::array<std::byte, 4096> memory{};
    io::byte_sink sink(memory);
    type.encode(sink, body);
    io::byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
    std::string line = std::to_string(entry.began) + " ns " + names_.name(entry.actor) + '/' +
                       std::to_string(entry.incarnation) + " <- " + names_.name(entry.sender) + " #" +
                       std::to_string(entry.id) + " because #" + std::to_string(entry.cause) + ' ' +
                       std::string(type.name);
    type.append_decoded(line, source);
    line += ' ';
    line += io::name_of(entry.how);
    lines_.push_back(std::move(line));
  }

  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

private:
  const directory& names_;
  const time_source& time_;
  std::vector<std::string> lines_;
};

class stable_address;

class simulated_scheduler; // CAF's test coordinator

class simulated_time final : public time_source {
public:
  void follow(const simulated_scheduler& scheduler) { scheduler_ = &scheduler; }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override;
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return start_ns + ahead_ns_ + monotonic_ns(); }
  void set_wall_ahead(std::int64_t ns) { ahead_ns_ = ns; }

  static constexpr std::int64_t start_ns = 1'800'000'000'000'000'000; // 2027-01-15, a round number

private:
  const simulated_scheduler* scheduler_ = nullptr;
  std::int64_t ahead_ns_ = 0; // of the wall clock, before the true time
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
  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();

  simulation(simulated_disk& disk, std::uint64_t seed, system_options options = {}, bool traced = true);
  // RECORD takes the deliveries in place of trace(); null: nobody does. It outlives the simulation.
  simulation(simulated_disk& disk, std::uint64_t seed, trace_sink* record, system_options options = {});
  simulation(const simulation&) = delete;
  simulation& operator=(const simulation&) = delete;
  ~simulation();

  [[nodiscard]] runtime::system& actors() { return *system_; }
  [[nodiscard]] simulated_journal& journal() { return journal_; }
  [[nodiscard]] const health_board& health() const { return health_; }
  [[nodiscard]] const memory_trace& trace() const { return trace_; }
  [[nodiscard]] const directory& names() const { return names_; }
  [[nodiscard]] std::optional<exit_request> exit() const { return system_->exit_requested(); }
  [[nodiscard]] std::int64_t now_ns() const { return time_.monotonic_ns(); }
  [[nodiscard]] const time_source& time() const { return time_; }

  void start();
  // Runs one thing that can happen now, chosen by CHOICE: an actor's next message or a step of the journal. False: none
  // can.
  bool step(std::uint64_t choice);
  void run_until_idle(); // until nothing can happen without time passing
  void advance(std::chrono::nanoseconds duration);
  // When the next timer is due; never_ns: there is none.
  [[nodiscard]] std::int64_t next_timer_ns() const;
  // Lets time pass; what becomes due by then waits for step(). For worlds that have more than actors in them.
  void pass_time_until(std::int64_t when_ns);
  [[nodiscard]] bool stop(); // in order; true when all ended

  void crash_at(const std::string& actor, crash_point point) { crashes_.plan(actor, point); }
  void forget_planned_crashes() { crashes_.clear(); }
  // Ends the incarnation between two messages. False: there is none now.
  bool kill(const std::string& actor);
  // The incarnation of ACTOR that would run next never comes out of a handler again: it takes no message, and nothing
  // ends it.
  void hang(const std::string& actor);
  // Somebody has set the wall clock: so far ahead of the true time, or behind it.
  void set_wall_ahead(std::int64_t ns) { time_.set_wall_ahead(ns); }
  [[nodiscard]] address_counters counters(const std::string& actor) const;

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell(const Handle& to, T body) { gateway_->tell(to, std::move(body)); }

  template <class Handle, class Q>
  requires accepts<Handle, Q> std::shared_ptr<asked<answer_t<Handle, Q>>>
  ask(const Handle& to, std::chrono::nanoseconds timeout, Q question) {
    using answer_type = answer_t<Handle, Q>;
    auto result = std::make_shared<asked<answer_type>>();
    request(
        to.ref(), timeout, envelope::of({++asked_, 0, 0, 0, 0}, std::move(question)),
        [result](const envelope& m) {
          ++result->answers;
          result->answer = m.as<answer_type>();
        },
        [result](const ask_error& why) {
          ++result->failures;
          result->failure = why;
        });
    return result;
  }

private:
  void begin(const simulated_disk& disk, std::uint64_t seed, system_options options, trace_sink* record);
  [[nodiscard]] stable_address* find(const std::string& actor) const;
  void request(const actor_ref& to, std::chrono::nanoseconds timeout, envelope question,
               std::function<void(const envelope&)> on_answer, std::function<void(const ask_error&)> on_error);

  directory names_;
  health_board health_;
  simulated_time time_;
  simulated_journal journal_;
  memory_trace trace_;
  planned_crashes crashes_;
  std::unique_ptr<runtime::system> system_;
  std::unique_ptr<simulated_scheduler> scheduler_;
  std::optional<gateway> gateway_;
  std::uint64_t asked_ = 0;
};

} // namespace godwit::runtime
