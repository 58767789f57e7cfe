// One process's actors: the scheduler, the stable addresses, the guardian, and the way in for other threads.
//
//   system actors(outside, options);
//   auto log = actors.add<flight_log>({.name = "flight_log"}, child_policy{});           // addresses first: each can
//   know the others auto link = actors.add<link_actor>({.name = "link"}, {.essential = true}, log); actors.start(); //
//   in this order auto why = actors.wait_for_exit_request();                                           // or
//   request_exit from a signal actors.stop();                                                                       //
//   reverse order, bounded in time
//
// When an actor hangs in a handler for good, stop() returns false: then close the journal and the trace and leave with
// std::_Exit, since the hanging thread can not be joined. Thread: one owner; gateways, request_exit and counters from
// any thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/actor_frame.hpp"
#include "runtime/address/address_options.hpp"
#include "runtime/gateway.hpp"
#include "runtime/services.hpp"
#include "runtime/supervision/child_spec.hpp"

namespace caf {
class actor_system;
class actor_system_config;
} // namespace caf

namespace godwit::runtime {

struct system_options {
  std::size_t workers = 0; // 0 = cores + 1: one handler may hang without stopping the others
  std::size_t max_throughput =
      20; // messages before an actor gives its worker to another; bounds waiting, see docs/performance.md
  strategy how = strategy::one_for_one;
  ping_policy ping;
  milliseconds stop_timeout{2'000};
  bool simulated = false; // CAF's test coordinator: no threads, virtual time; see runtime/simulation
};

class system {
public:
  system(services outside, system_options options);
  system(const system&) = delete;
  system& operator=(const system&) = delete;
  ~system();

  // Declares a child; started by start() in the order of declaration. ARGS go to the constructor of each incarnation,
  // after its spawn_context.
  template <class Actor, class... Args>
  typename Actor::handle_type add(address_options address, child_policy policy, Args... args) {
    return typename Actor::handle_type(
        add_child(std::move(address), policy, Actor::is_durable, [args...](spawn_context context) {
          return std::unique_ptr<actor_frame>(std::make_unique<Actor>(std::move(context), args...));
        }));
  }

  // The child that hears of all others and says by its table who runs. Before start().
  void set_supervisor(supervisor_handle supervisor) { supervisor_ = std::move(supervisor); }
  // A child that hears, once in each period of the pings, that the children NAMES live. Before start().
  void tell_who_lives(liveness_handle to, std::vector<std::string> names) {
    alive_ = {std::move(to), std::move(names)};
  }
  // Children that run whatever a table says. Before start().
  void set_floor(std::vector<std::string> names) { floor_ = std::move(names); }
  // What holds until the supervisor has said something, where it is not what add() was given. Before start().
  void begin_with(std::vector<child_entry> table) { first_table_ = std::move(table); }
  // An essential child that can not be kept up in flight ends the process; else the rest goes on. Before start().
  void let_end_fast(bool may) { may_end_fast_ = may; }
  // For the supervisor; usable in ARGS of add: it is a stable address too.
  [[nodiscard]] guardian_handle guardian() const { return guardian_handle(guardian_address_); }

  void start();
  void request_exit(exit_request why);
  [[nodiscard]] exit_request wait_for_exit_request();
  [[nodiscard]] bool stop();

  // The parts of stop(), for a simulation, which has to run the actors itself.
  void begin_stop();
  [[nodiscard]] bool has_stopped();
  [[nodiscard]] std::optional<exit_request> exit_requested();
  void kill_all(); // every actor, at once, in no order: as if the process was killed

  // A way in for a thread that is not an actor; one for each thread.
  [[nodiscard]] gateway make_gateway(const std::string& name);

  // Of all that were declared, in that order. Thread: any, once they are started.
  [[nodiscard]] std::vector<std::string> names() const;
  // For drills: ends the incarnation of NAME between two messages, as a crash would. False: there is none. Thread: any.
  bool kill_child(std::string_view name);
  bool kill_child(std::size_t child);
  // Of the stable address, as trace and crash points name it.
  [[nodiscard]] std::uint32_t number(std::size_t child) const;

  // Each actor has been up once, or was given up.
  [[nodiscard]] bool has_begun() const { return status_->has_begun.load(); }
  // The guardian has its turns, and sees no reason to end the process: all essential actors answer their pings.
  // Between start() and stop().
  [[nodiscard]] bool is_responsive();

  [[nodiscard]] std::uint64_t restarts() const { return status_->restarts.load(); }
  [[nodiscard]] address_counters counters(std::size_t child) const;
  [[nodiscard]] const std::vector<child_spec>& declared() const { return children_; }
  [[nodiscard]] caf::actor_system& actors() { return *actors_; } // for runtime/ and its tests

private:
  [[nodiscard]] std::uint64_t run() const; // of the journal
  actor_ref make_address(address_options options);
  actor_ref add_child(address_options address, child_policy policy, bool is_durable, actor_maker make);
  void watch();

  services outside_;
  system_options options_;
  std::unique_ptr<caf::actor_system_config> config_;
  std::unique_ptr<caf::actor_system> actors_;
  std::vector<child_spec> children_;
  supervisor_handle supervisor_;
  liveness_listener alive_;
  std::vector<std::string> floor_;
  std::vector<child_entry> first_table_;
  bool may_end_fast_ = false;
  actor_ref guardian_address_;
  actor_ref guardian_;
  std::shared_ptr<guardian_status> status_ = std::make_shared<guardian_status>();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<exit_request> exit_request_;
  bool guardian_gone_ = false;
  bool watching_ = false;
  bool killing_ = false;
  bool clean_ = true;
  std::thread watcher_;
};

} // namespace godwit::runtime
