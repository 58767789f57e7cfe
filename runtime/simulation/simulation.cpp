#include "runtime/simulation/simulation.hpp"

#include <algorithm>

#include "runtime/assert.hpp"

namespace godwit::runtime {

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
  services outside;
  outside.time = &time_;
  outside.names = &names_;
  outside.health = &health_;
  outside.durable = &journal_;
  outside.trace = traced ? &trace_ : nullptr;
  outside.crashes = &crashes_;
  outside.seed = seed;
  options.simulated = true;
  system_ = std::make_unique<runtime::system>(outside, options);
  scheduler_ = dynamic_cast<caf::scheduler::test_coordinator*>(&system_->actors().scheduler());
  GODWIT_ASSERT(scheduler_ != nullptr, "a simulated system runs on CAF's test coordinator");
  time_.follow(*scheduler_);
  gateway_ = system_->make_gateway("test");
  const auto asker = system_->actors().spawn<caf::event_based_actor>();
  asker_alive_ = caf::actor_cast<caf::strong_actor_ptr>(asker);
  asker_ = static_cast<caf::event_based_actor*>(caf::actor_cast<caf::abstract_actor*>(asker));
  asker_->become([](int) {}); // it only receives answers; without a behaviour it would end
}

simulation::~simulation() {
  crashes_.clear();
  system_->kill_all();
  if (asker_alive_)
    asker_alive_->enqueue(kill_message(), nullptr);
  asker_alive_ = nullptr;
  while (scheduler_->try_run_once()) {
  }
  system_.reset();
}

void simulation::start() { system_->start(); }

bool simulation::step(std::uint64_t choice) {
  auto& jobs = scheduler_->jobs;
  const auto candidates = jobs.size() + (journal_.waiting() > 0 ? 1 : 0);
  if (candidates == 0)
    return false;
  const auto chosen = choice % candidates;
  if (chosen == jobs.size())
    return journal_.step() || !jobs.empty();
  const auto at = jobs.begin() + static_cast<std::ptrdiff_t>(chosen);
  std::rotate(jobs.begin(), at, at + 1);
  return scheduler_->try_run_once();
}

void simulation::settle() {
  while (scheduler_->try_run_once() || journal_.step()) {
  }
}

void simulation::advance(std::chrono::nanoseconds duration) {
  constexpr std::chrono::nanoseconds stride = std::chrono::milliseconds(10); // timers see time in steps of this
  settle();
  while (duration.count() > 0) {
    const auto now = std::min(duration, stride);
    scheduler_->advance_time(now);
    settle();
    duration -= now;
  }
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
