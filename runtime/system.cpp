#include "runtime/system.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "runtime/address/stable_address.hpp"
#include "runtime/assert.hpp"
#include "runtime/caf_mail.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/supervision/guardian.hpp"

namespace godwit::runtime {

system::system(services outside, system_options options) : outside_(outside), options_(options) {
  if (options_.workers == 0)
    options_.workers = std::max(2U, std::thread::hardware_concurrency()) + 1;
  config_ = std::make_unique<caf::actor_system_config>();
  // Work stealing polls and wakes late; without a bound on throughput two busy actors starve all others.
  config_->set("scheduler.policy", options_.simulated ? caf::atom("testing") : caf::atom("sharing"));
  config_->set("scheduler.max-threads", options_.workers);
  config_->set("scheduler.max-throughput", options_.max_throughput);
  actors_ = std::make_unique<caf::actor_system>(*config_);
  guardian_address_ = make_address({.name = "guardian", .mailbox_bound = std::numeric_limits<std::size_t>::max()});
}

system::~system() {
  if (guardian_ && !options_.simulated)
    (void)stop();
  if (clean_) {
    for (auto& each : children_)
      address_of(each.address).close();
    address_of(guardian_address_).close();
    children_.clear();
    supervisor_ = nullptr;
    alive_ = {};
    guardian_address_ = {};
    return;
  }
  // A worker hangs in a handler and would be waited for without end; the process is about to leave with std::_Exit.
  (void)actors_.release();
  (void)config_.release();
}

actor_ref system::add_child(address_options address, child_policy policy, bool is_durable, actor_maker make) {
  auto ref = make_address(std::move(address));
  children_.push_back({ref, policy, is_durable, std::move(make)});
  return ref;
}

address_counters system::counters(std::size_t child) const { return address_of(children_[child].address).counters(); }

actor_ref system::make_address(address_options options) {
  const auto number = outside_.names->add(options.name);
  GODWIT_ASSERT(number < directory::max_addresses, "a process has at most directory::max_addresses actors");
  options.run = run();
  return ref_of(make_stable_address(*actors_, number, std::move(options)));
}

std::uint64_t system::run() const { return outside_.durable == nullptr ? 1 : outside_.durable->status().run; }

gateway system::make_gateway(const std::string& name) {
  const auto number = outside_.names->add(name);
  GODWIT_ASSERT(number < directory::max_addresses,
                "a process has at most directory::max_addresses actors and gateways");
  return {number, ids_before_run(run())};
}

void system::start() {
  GODWIT_ASSERT(!guardian_, "a system starts once");
  guardian_options options;
  options.self = guardian_address_;
  options.how = options_.how;
  options.ping = options_.ping;
  options.stop_timeout = options_.stop_timeout;
  options.floor = floor_;
  options.first_table = first_table_;
  options.may_end_fast = may_end_fast_;
  options.alive = alive_;
  options.on_exit_request = [this](exit_request why) { request_exit(std::move(why)); };
  const auto spawned = spawn_guardian(*actors_, outside_, children_, std::move(options), supervisor_, status_);
  guardian_ = ref_of(spawned);
  spawned->get()->attach_functor([this](const caf::error& why) {
    const std::lock_guard guard(mutex_);
    guardian_gone_ = true;
    if (why != caf::exit_reason::user_shutdown && !killing_ && !exit_request_)
      exit_request_ = {exit_cause::guardian_died, "the guardian died: " + caf::to_string(why)};
    changed_.notify_all();
  });
  (void)address_of(guardian_address_).begin_incarnation();
  address_of(guardian_address_).bind(spawned, nullptr);
  status_->last_tick_ns.store(outside_.time->monotonic_ns());
  if (!options_.simulated) {
    watching_ = true;
    watcher_ = std::thread([this] { watch(); });
  }
  tell_guardian_to_start(spawned);
}

// Outside the workers, so that it notices when none of them is free: then the guardian does not tick any more.
void system::watch() {
  const auto limit_ns = std::chrono::nanoseconds(options_.ping.fatal).count();
  auto looked_ns = outside_.time->monotonic_ns();
  auto stood_still_ns = looked_ns; // until then the whole process did not run (SIGSTOP, a suspended machine)
  std::unique_lock guard(mutex_);
  while (watching_) {
    changed_.wait_for(guard, options_.ping.period / 2);
    const auto now_ns = outside_.time->monotonic_ns();
    if (now_ns - looked_ns > limit_ns / 2)
      stood_still_ns = now_ns;
    looked_ns = now_ns;
    const auto silent_ns = now_ns - std::max(stood_still_ns, status_->last_tick_ns.load(std::memory_order_relaxed));
    if (watching_ && !guardian_gone_ && silent_ns > limit_ns && !exit_request_)
      exit_request_ = {exit_cause::no_free_worker,
                       "all " + std::to_string(options_.workers) + " workers hang in handlers that do not return"};
    if (exit_request_)
      changed_.notify_all();
  }
}

void system::request_exit(exit_request why) {
  const std::lock_guard guard(mutex_);
  if (!exit_request_)
    exit_request_ = std::move(why);
  changed_.notify_all();
}

exit_request system::wait_for_exit_request() {
  std::unique_lock guard(mutex_);
  changed_.wait(guard, [this] { return exit_request_.has_value(); });
  return *exit_request_;
}

std::optional<exit_request> system::exit_requested() {
  const std::lock_guard guard(mutex_);
  return exit_request_;
}

void system::begin_stop() {
  if (guardian_)
    tell_guardian_to_stop(strong(guardian_));
}

bool system::has_stopped() {
  const std::lock_guard guard(mutex_);
  return guardian_gone_;
}

bool system::is_responsive() {
  const std::lock_guard guard(mutex_);
  const auto silent_ns = outside_.time->monotonic_ns() - status_->last_tick_ns.load(std::memory_order_relaxed);
  return guardian_ && !guardian_gone_ && !exit_request_ &&
         silent_ns <= std::chrono::nanoseconds(options_.ping.fatal).count();
}

std::vector<std::string> system::names() const {
  std::vector<std::string> result;
  for (const auto& each : children_)
    result.push_back(address_of(each.address).actor_name());
  return result;
}

bool system::kill_child(std::string_view name) {
  for (const auto& each : children_)
    if (address_of(each.address).actor_name() == name)
      return address_of(each.address).kill();
  return false;
}

bool system::kill_child(std::size_t child) { return address_of(children_[child].address).kill(); }

std::uint32_t system::number(std::size_t child) const { return address_of(children_[child].address).number(); }

void system::kill_all() {
  {
    const std::lock_guard guard(mutex_);
    killing_ = true;
  }
  if (guardian_)
    strong(guardian_)->enqueue(kill_message(), nullptr);
  guardian_ = {};
  for (auto& each : children_) {
    (void)address_of(each.address).kill();
    address_of(each.address).close();
  }
}

bool system::stop() {
  if (!guardian_)
    return clean_;
  begin_stop();
  // Each child has twice stop_timeout at most; the guardian itself needs one free worker.
  const auto bound = options_.stop_timeout * 2 * static_cast<int>(children_.size() + 1);
  {
    std::unique_lock guard(mutex_);
    const bool no_worker = exit_request_ && exit_request_->cause == exit_cause::no_free_worker;
    changed_.wait_for(guard, no_worker ? options_.stop_timeout : bound, [this] { return guardian_gone_; });
    clean_ = guardian_gone_ && status_->hanging.load() == 0;
    watching_ = false;
    changed_.notify_all();
  }
  watcher_.join();
  guardian_ = {};
  return clean_;
}

} // namespace godwit::runtime
