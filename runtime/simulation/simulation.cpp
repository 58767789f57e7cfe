#include "runtime/simulation/simulation.hpp"

#include <algorithm>
#include <set>

#include <caf/scheduler/test_coordinator.hpp>

#include "runtime/address/stable_address.hpp"
#include "runtime/assert.hpp"
#include "runtime/caf_mail.hpp"
#include "runtime/internal_messages.hpp"

namespace godwit::runtime {

// CAF's side of a simulation: the coordinator that runs one job at a time, and an actor that asks for the test.
class simulated_scheduler {
public:
  explicit simulated_scheduler(caf::actor_system& system)
      : coordinator_(dynamic_cast<caf::scheduler::test_coordinator*>(&system.scheduler())) {
    GODWIT_ASSERT(coordinator_ != nullptr, "a simulated system runs on CAF's test coordinator");
    const auto asker = system.spawn<caf::event_based_actor>();
    asker_alive_ = caf::actor_cast<caf::strong_actor_ptr>(asker);
    asker_ = static_cast<caf::event_based_actor*>(caf::actor_cast<caf::abstract_actor*>(asker));
    asker_->become([](int) {}); // it only receives answers; without a behaviour it would end
  }
  simulated_scheduler(const simulated_scheduler&) = delete;
  simulated_scheduler& operator=(const simulated_scheduler&) = delete;
  ~simulated_scheduler() = default;

  [[nodiscard]] std::int64_t now_ns() const { return coordinator_->clock().now().time_since_epoch().count(); }
  // Those that can run.
  [[nodiscard]] auto& jobs() {
    set_hanging_aside();
    return coordinator_->jobs;
  }
  bool run_once() {
    set_hanging_aside();
    return coordinator_->try_run_once();
  }
  void hang(const std::string& actor) { to_hang_.insert(actor); }
  void end_hanging() {
    to_hang_.clear();
    hanging_.clear();
    coordinator_->jobs.insert(coordinator_->jobs.end(), aside_.begin(), aside_.end());
    aside_.clear();
  }
  [[nodiscard]] std::optional<std::int64_t> next_timer_ns() const {
    const auto& due = coordinator_->clock().schedule();
    return due.empty() ? std::nullopt : std::optional(due.begin()->first.time_since_epoch().count());
  }
  void advance(std::chrono::nanoseconds duration) { coordinator_->advance_time(duration); }
  void end_asker() {
    if (asker_alive_)
      asker_alive_->enqueue(kill_message(), nullptr);
    asker_alive_ = nullptr;
  }

  void request(const actor_ref& to, std::chrono::nanoseconds timeout, envelope question,
               std::function<void(const envelope&)> on_answer, std::function<void(const ask_error&)> on_error) {
    asker_->context(nullptr); // the one that it was last run with is gone
    const auto id = asker_->new_request_id(caf::message_priority::normal);
    asker_->add_multiplexed_response_handler(
        id.response_id(),
        caf::behavior{[on_answer = std::move(on_answer)](const envelope& m) { on_answer(m); },
                      [on_error = std::move(on_error)](const caf::error& why) { on_error(describe(why)); }});
    asker_->request_response_timeout(caf::duration{timeout}, id);
    strong(to)->enqueue(make_mail(asker_->ctrl(), id, std::move(question)), nullptr);
  }

private:
  void set_hanging_aside() {
    if (to_hang_.empty() && hanging_.empty())
      return;
    std::erase_if(coordinator_->jobs, [this](caf::resumable* each) {
      const auto* who = dynamic_cast<caf::local_actor*>(each);
      if (who != nullptr && to_hang_.erase(who->name()) > 0)
        hanging_.insert(each);
      const bool hangs = hanging_.contains(each);
      if (hangs)
        aside_.push_back(each); // with its reference, so that no other incarnation gets its place in memory
      return hangs;
    });
  }

  caf::scheduler::test_coordinator* coordinator_;
  std::set<std::string, std::less<>> to_hang_; // actors
  std::set<caf::resumable*> hanging_;
  std::vector<caf::resumable*> aside_;
  caf::event_based_actor* asker_ = nullptr;
  caf::strong_actor_ptr asker_alive_;
};

std::int64_t simulated_time::monotonic_ns() const noexcept { return scheduler_ == nullptr ? 0 : scheduler_->now_ns(); }

void planned_crashes::hit(crash_point point, std::uint32_t actor, std::uint64_t) {
  const auto& name = names_.name(actor);
  const auto found = std::find_if(plans_.begin(), plans_.end(),
                                  [&](const plan_entry& each) { return each.point == point && each.actor == name; });
  if (found == plans_.end())
    return;
  plans_.erase(found);
  throw injected_crash("planned by the test");
}

simulation::simulation(simulated_disk& disk, std::uint64_t seed, system_options options, bool traced)
    : journal_(disk), trace_(names_, time_), crashes_(names_) {
  begin(disk, seed, options, traced ? &trace_ : nullptr);
}

simulation::simulation(simulated_disk& disk, std::uint64_t seed, trace_sink* record, system_options options)
    : journal_(disk), trace_(names_, time_), crashes_(names_) {
  begin(disk, seed, options, record);
}

void simulation::begin(const simulated_disk& disk, std::uint64_t seed, system_options options, trace_sink* record) {
  services outside;
  outside.time = &time_;
  outside.names = &names_;
  outside.health = &health_;
  outside.durable = &journal_;
  outside.trace = record;
  outside.crashes = &crashes_;
  outside.seed = seed;
  options.simulated = true;
  system_ = std::make_unique<runtime::system>(outside, options);
  scheduler_ = std::make_unique<simulated_scheduler>(system_->actors());
  time_.follow(*scheduler_);
  gateway_ = system_->make_gateway("test");
  asked_ = ids_before_run(disk.runs);
}

simulation::~simulation() {
  crashes_.clear();
  scheduler_->end_hanging();
  system_->kill_all();
  scheduler_->end_asker();
  while (scheduler_->run_once()) {
  }
  system_.reset();
}

void simulation::start() { system_->start(); }

bool simulation::step(std::uint64_t choice) {
  auto& jobs = scheduler_->jobs();
  const auto candidates = jobs.size() + (journal_.waiting() > 0 ? 1 : 0);
  if (candidates == 0)
    return false;
  const auto chosen = choice % candidates;
  if (chosen == jobs.size())
    return journal_.step() || !jobs.empty();
  const auto at = jobs.begin() + static_cast<std::ptrdiff_t>(chosen);
  std::rotate(jobs.begin(), at, at + 1);
  return scheduler_->run_once();
}

void simulation::run_until_idle() {
  while (scheduler_->run_once() || journal_.step()) {
  }
}

void simulation::advance(std::chrono::nanoseconds duration) {
  constexpr std::chrono::nanoseconds stride = std::chrono::milliseconds(10); // timers see time in steps of this
  run_until_idle();
  while (duration.count() > 0) {
    const auto now = std::min(duration, stride);
    scheduler_->advance(now);
    run_until_idle();
    duration -= now;
  }
}

void simulation::request(const actor_ref& to, std::chrono::nanoseconds timeout, envelope question,
                         std::function<void(const envelope&)> on_answer,
                         std::function<void(const ask_error&)> on_error) {
  scheduler_->request(to, timeout, std::move(question), std::move(on_answer), std::move(on_error));
}

std::int64_t simulation::next_timer_ns() const { return scheduler_->next_timer_ns().value_or(never_ns); }

void simulation::pass_time_until(std::int64_t when_ns) {
  if (const auto passes_ns = when_ns - now_ns(); passes_ns > 0)
    scheduler_->advance(std::chrono::nanoseconds(passes_ns));
}

bool simulation::stop() {
  system_->begin_stop();
  for (int strides = 0; strides < 10'000 && !system_->has_stopped(); ++strides)
    advance(std::chrono::milliseconds(10));
  return system_->has_stopped();
}

bool simulation::kill(const std::string& actor) {
  auto* found = find(actor);
  return found != nullptr && found->kill();
}

void simulation::hang(const std::string& actor) { scheduler_->hang(actor); }

address_counters simulation::counters(const std::string& actor) const {
  const auto* found = find(actor);
  return found == nullptr ? address_counters{} : found->counters();
}

stable_address* simulation::find(const std::string& actor) const {
  for (const auto& each : system_->declared())
    if (address_of(each.address).actor_name() == actor)
      return &address_of(each.address);
  return nullptr;
}

} // namespace godwit::runtime
