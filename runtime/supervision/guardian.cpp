#include "runtime/supervision/guardian.hpp"

#include <algorithm>
#include <utility>

#include "runtime/caf_mail.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/planted_bug.hpp"
#include "runtime/supervision/child_list.hpp"

namespace godwit::runtime {

namespace {

std::vector<child_policy> policies_of(const std::vector<child_spec>& children) {
  std::vector<child_policy> result;
  result.reserve(children.size());
  for (const auto& each : children)
    result.push_back(each.policy);
  return result;
}

class guardian final : public caf::event_based_actor {
public:
  guardian(caf::actor_config& config, const services& outside, std::vector<child_spec> children,
           guardian_options options, supervisor_handle supervisor, std::shared_ptr<guardian_status> status)
      : caf::event_based_actor(config), outside_(outside), options_(std::move(options)),
        supervisor_(std::move(supervisor)), status_(std::move(status)),
        core_(options_.how, policies_of(children), outside.seed), pings_(options_.ping, children.size()),
        children_(std::move(children)) {
    apply(options_.first_table);
    set_down_handler([this](caf::down_msg& message) { on_down(message); });
    set_default_handler(caf::drop);
  }

  const char* name() const override { return "guardian"; }

  caf::behavior make_behavior() override {
    return {[this](const envelope& m) { receive(m); }};
  }

  void on_exit() override { children_.clear(); }

private:
  // -- mail ---------------------------------------------------------------------------------------

  void receive(const envelope& m) {
    if (m.is<start_children>()) {
      tick();
      execute(core_.start());
    } else if (m.is<stop_children>()) {
      execute(core_.shutdown());
    } else if (m.is<guardian_tick>()) {
      tick();
    } else if (m.is<pong>()) {
      on_pong(m.as<pong>());
    } else if (m.is<child_up>()) {
      on_up(m.as<child_up>());
    } else if (m.is<recovery_ready>()) {
      on_recovered(m.as<recovery_ready>());
    } else if (m.is<restart_due>()) {
      execute(core_.restart_due(m.as<restart_due>().child));
    } else if (m.is<stop_overdue>()) {
      on_stop_overdue(m.as<stop_overdue>());
    } else {
      receive_of_supervisor(m);
    }
  }

  void receive_of_supervisor(const envelope& m) {
    if (m.is<get_children>()) {
      auto promise = make_response_promise();
      promise.deliver(envelope::of(stamp(m.head.id), children_.report(core_, *outside_.health)));
    } else if (m.is<supervise>()) {
      take_table(m.as<supervise>());
      auto promise = make_response_promise();
      promise.deliver(envelope::of(stamp(m.head.id), supervised{epoch_}));
    } else {
      outside_.health->post("guardian", health_colour::yellow,
                            "was sent " + std::string(m.type->name) + ", which it does not take");
    }
  }

  // An entry that says what holds already changes nothing: crash histories and waits go on.
  void take_table(const supervise& table) {
    if (table.epoch <= epoch_)
      return;
    const bool is_first = epoch_ == table_epoch{};
    epoch_ = table.epoch;
    apply(table.list);
    if (std::exchange(revivals_, std::max(revivals_, table.revivals)) >= table.revivals || is_first)
      return;
    for (std::size_t i = 0; i < children_.size(); ++i)
      execute(core_.revive(i));
  }

  [[nodiscard]] bool is_of_floor(const std::string& name) const {
    return std::ranges::find(options_.floor, name) != options_.floor.end();
  }

  void apply(const std::vector<child_entry>& table) {
    for (const auto& each : table) {
      const auto i = find_or_tell(each.name);
      if (i >= children_.size())
        continue;
      core_.set_policy(i, each.policy);
      if (const bool wanted = each.wanted || is_of_floor(each.name); wanted != core_.is_wanted(i))
        execute(core_.want(i, wanted));
    }
  }

  // -- carrying out -------------------------------------------------------------------------------

  void execute(const supervision_core::actions& actions) {
    for (const auto& each : actions)
      std::visit([this](const auto& action) { act(action); }, each);
    for (std::size_t i = 0; i < children_.size(); ++i)
      if (!core_.shutting_down() && (!core_.is_wanted(i) || core_.phase(i) == child_phase::given_up))
        children_[i].address().go_away();
    if (core_.has_begun())
      status_->has_begun.store(true, std::memory_order_relaxed);
  }

  void act(const start_child& action) {
    auto& child = children_[action.child];
    child.number = child.address().begin_incarnation();
    if (!child.spec.is_durable || outside_.durable == nullptr) {
      make_incarnation(action.child, {});
      return;
    }
    child.recovers_since_ns = now_ns();
    outside_.durable->recover(child.name(), child.number,
                              [slot = child.slot, self = caf::strong_actor_ptr(ctrl()), index = action.child,
                               number = child.number](tl::expected<recovered, journal_error> result) {
                                {
                                  const std::lock_guard guard(slot->mutex);
                                  slot->by_incarnation.insert_or_assign(number, std::move(result));
                                }
                                self->enqueue(make_internal_mail(recovery_ready{index, number}), nullptr);
                              });
  }

  void act(const stop_child& action) {
    auto& child = children_[action.child];
    pings_.forget(action.child);
    if (!child.incarnation) { // its recovery is still under way
      child.number = 0;
      child.recovers_since_ns.reset();
      execute(core_.down(action.child, now_ns()));
      return;
    }
    // In order: a stop for good lets the actor finish its mail first, one for a restart does not wait for it.
    const auto mid =
        caf::make_message_id(action.for_good ? caf::message_priority::normal : caf::message_priority::high);
    child.incarnation->enqueue(
        caf::make_mailbox_element(nullptr, mid, {}, caf::exit_msg{address_of_self(), caf::exit_reason::user_shutdown}),
        context());
    later(options_.stop_timeout, stop_overdue{action.child, child.number, false});
  }

  void act(const await_restart& action) {
    post_health(action.child, health_colour::yellow,
                "crashed: " + children_[action.child].address().last_crash() + "; it starts again in " +
                    std::to_string(action.delay_ns / 1'000'000) + " ms");
    later(std::chrono::nanoseconds(action.delay_ns), restart_due{action.child});
  }

  void act(const give_up_child& action) {
    auto& child = children_[action.child];
    const auto reason = child.address().last_crash();
    tell_event(action.child, child_event_kind::gave_up, reason);
    post_health(action.child, health_colour::red, "given up: " + reason);
  }

  void act(const bring_down& action) {
    const auto& child = children_[action.child];
    end_process(action.child, exit_cause::essential_given_up,
                child.name() + " is essential and was given up: " + child.address().last_crash());
  }

  void act(const all_stopped&) {
    for (auto& each : children_)
      each.address().close();
    quit(caf::exit_reason::user_shutdown);
  }

  void make_incarnation(std::size_t index, recovered restored) {
    auto& child = children_[index];
    try {
      spawn_context born{&outside_, child.spec.address, child.number, actor_ref(ctrl()), std::move(restored)};
      auto made = caf::actor_cast<caf::strong_actor_ptr>(system().spawn<incarnation>(std::move(born), child.spec.make));
      monitor(caf::actor_cast<caf::actor>(made));
      if (child.number > 1 && GODWIT_PLANTED(restart_twice))
        system().spawn<incarnation>(spawn_context{&outside_, child.spec.address, child.number, actor_ref(ctrl()), {}},
                                    child.spec.make);
      child.incarnation = made;
      pings_.watch(index, now_ns());
      child.address().bind(std::move(made), context());
    } catch (const std::exception& thrown) {
      child.address().note_crash(thrown.what());
      tell_event(index, child_event_kind::crashed, thrown.what());
      execute(core_.down(index, now_ns()));
    }
  }

  // -- what happens to children -------------------------------------------------------------------

  void on_recovered(const recovery_ready& ready) {
    auto& child = children_[ready.child];
    tl::expected<recovered, journal_error> result;
    {
      const std::lock_guard guard(child.slot->mutex);
      const auto found = child.slot->by_incarnation.find(ready.incarnation);
      if (found == child.slot->by_incarnation.end())
        return;
      result = std::move(found->second);
      child.slot->by_incarnation.erase(found);
    }
    if (child.number != ready.incarnation || core_.phase(ready.child) != child_phase::starting)
      return; // stopped meanwhile
    child.recovers_since_ns.reset();
    if (result) {
      make_incarnation(ready.child, std::move(*result));
      return;
    }
    child.address().note_crash(result.error().message());
    tell_event(ready.child, child_event_kind::crashed, result.error().message());
    execute(core_.down(ready.child, now_ns()));
  }

  void on_up(const child_up& up) {
    const auto index = children_.find(up.actor);
    if (index >= children_.size() || children_[index].number != up.incarnation)
      return;
    if (up.incarnation > 1)
      status_->restarts.fetch_add(1, std::memory_order_relaxed);
    tell_event(index, child_event_kind::up, {});
    post_health(index, health_colour::green, {});
    tell_alive(index);
    execute(core_.up(index));
  }

  void on_down(const caf::down_msg& message) {
    const auto index = children_.find(message.source);
    if (index >= children_.size()) { // one that was left behind has come to its end after all
      if (status_->hanging.load() > 0)
        status_->hanging.fetch_sub(1);
      post_hanging();
      return;
    }
    auto& child = children_[index];
    child.incarnation = nullptr;
    pings_.forget(index);
    const bool stopping = core_.phase(index) == child_phase::stopping;
    if (!stopping && message.reason != caf::sec::runtime_error)
      child.address().note_crash("killed");
    tell_event(index, stopping ? child_event_kind::stopped : child_event_kind::crashed, child.address().last_crash());
    execute(core_.down(index, now_ns(), child.address().is_beyond_restart()));
  }

  void on_stop_overdue(const stop_overdue& overdue) {
    auto& child = children_[overdue.child];
    if (child.number != overdue.incarnation || core_.phase(overdue.child) != child_phase::stopping)
      return;
    if (overdue.killed) {
      leave_behind(overdue.child);
      execute(core_.down(overdue.child, now_ns()));
      return;
    }
    kill(*child.incarnation);
    later(options_.stop_timeout, stop_overdue{overdue.child, overdue.incarnation, true});
  }

  // It ends before it looks at any other mail.
  void kill(caf::actor_control_block& incarnation) { incarnation.enqueue(kill_message(address_of_self()), context()); }

  // -- pings --------------------------------------------------------------------------------------

  void tick() {
    const auto now = now_ns();
    status_->last_tick_ns.store(now, std::memory_order_relaxed);
    const auto verdict = pings_.tick(now);
    for (const auto i : verdict.to_ping)
      strong(children_[i].spec.address)->enqueue(make_internal_mail(ping{pings_.key_of(i)}), context());
    for (const auto i : verdict.late) {
      tell_event(i, child_event_kind::late, {});
      post_health(i, health_colour::yellow, "does not answer pings");
    }
    for (const auto i : verdict.silent)
      on_silent(i);
    look_at_recoveries(now);
    if (!core_.shutting_down())
      later(options_.ping.period / 4, guardian_tick{});
  }

  void look_at_recoveries(std::int64_t now) {
    for (std::size_t i = 0; i < children_.size(); ++i) {
      auto& since = children_[i].recovers_since_ns;
      if (!since || now - *since <= std::chrono::nanoseconds(options_.recovery_limit).count())
        continue;
      since.reset();
      const auto reason =
          "the journal has not given its state back for " + std::to_string(options_.recovery_limit.count()) + " ms";
      post_health(i, health_colour::red, reason);
      end_process(i, exit_cause::recovery_overdue, children_[i].name() + ": " + reason);
    }
  }

  void on_pong(const pong& answer) {
    const auto index = children_.find(answer.actor);
    if (index >= children_.size())
      return;
    const auto how = pings_.answered(index, answer.key);
    if (how == ping_ledger::answer::stale)
      return;
    if (how == ping_ledger::answer::late)
      post_health(index, health_colour::green, {});
    tell_alive(index);
  }

  // A handler that does not return can not be stopped inside a process. The incarnation is left behind with what it had
  // in its mailbox, and a new one takes over; for an essential actor the process ends instead, and starts clean.
  void on_silent(std::size_t index) {
    const std::string reason = "did not answer a ping for " + std::to_string(options_.ping.fatal.count()) + " ms";
    const auto stranded = leave_behind(index);
    children_[index].address().note_crash(reason);
    tell_event(index, child_event_kind::silent, reason + "; " + std::to_string(stranded) + " messages are stranded");
    post_health(index, health_colour::red, reason);
    if (core_.policy(index).essential)
      end_process(index, exit_cause::essential_silent, children_[index].name() + " is essential and " + reason);
    execute(core_.down(index, now_ns()));
  }

  std::size_t leave_behind(std::size_t index) {
    auto& child = children_[index];
    kill(*child.incarnation); // should its handler return after all, its mail goes to the successor untouched
    child.incarnation = nullptr;
    status_->hanging.fetch_add(1);
    post_hanging();
    return child.address().abandon();
  }

  // -- small things -------------------------------------------------------------------------------

  [[nodiscard]] std::int64_t now_ns() const { return outside_.time->monotonic_ns(); }
  [[nodiscard]] caf::actor_addr address_of_self() { return caf::event_based_actor::address(); }

  template <class Duration, class T>
  void later(Duration delay, T body) {
    clock().schedule_message(clock().now() + delay, caf::strong_actor_ptr(ctrl()), make_internal_mail(std::move(body)));
  }

  [[nodiscard]] std::size_t find_or_tell(const std::string& wanted) const {
    const auto index = children_.find(wanted);
    if (index >= children_.size())
      outside_.health->post("guardian", health_colour::yellow,
                            "received an event of " + wanted + ", which is no child of it");
    return index;
  }
  void tell_event(std::size_t index, child_event_kind kind, std::string reason) {
    const auto& child = children_[index];
    child_event event{child.name(), kind, child.number, std::move(reason)};
    if (outside_.trace != nullptr) {
      trace_entry entry;
      entry.began = outside_.trace->ticks();
      entry.ended = entry.began;
      entry.actor = child.address().number();
      entry.incarnation = static_cast<std::uint32_t>(child.number);
      outside_.trace->record(entry, type_of<child_event>(), &event);
    }
    if (supervisor_)
      tell(supervisor_.ref(), std::move(event));
  }

  void tell_alive(std::size_t index) {
    const auto& name = children_[index].name();
    if (options_.alive.who && std::ranges::find(options_.alive.of, name) != options_.alive.of.end())
      tell(options_.alive.who.ref(), child_alive{name});
  }

  template <class T>
  void tell(const actor_ref& to, T body) {
    strong(to)->enqueue(make_mail(nullptr, caf::make_message_id(), envelope::of(stamp(0), std::move(body))), context());
  }

  [[nodiscard]] header stamp(std::uint64_t cause) const {
    auto& self = address_of(options_.self);
    return {self.next_id(), cause, 0, 0, self.number()};
  }

  void post_health(std::size_t index, health_colour colour, std::string reason) {
    outside_.health->post(children_[index].name(), colour, std::move(reason));
  }

  void post_hanging() {
    const auto hanging = status_->hanging.load();
    outside_.health->post("workers", hanging == 0 ? health_colour::green : health_colour::yellow,
                          hanging == 0 ? "" : std::to_string(hanging) + " hang in handlers that do not return");
  }

  // In flight a second end within minutes would cure nothing: what still runs goes on.
  void end_process(std::size_t because_of, exit_cause cause, std::string reason) {
    if (core_.policy(because_of).end == process_end::in_order)
      request_exit(cause, std::move(reason));
    else if (options_.may_end_fast)
      request_exit(exit_cause::given_up_in_flight, std::move(reason));
  }

  void request_exit(exit_cause cause, std::string reason) {
    if (options_.on_exit_request)
      options_.on_exit_request({cause, std::move(reason)});
  }

  const services outside_;
  const guardian_options options_;
  const supervisor_handle supervisor_;
  const std::shared_ptr<guardian_status> status_;
  supervision_core core_;
  ping_ledger pings_;
  child_list children_;
  table_epoch epoch_; // of the last table
  std::uint64_t revivals_ = 0;
};

} // namespace

caf::strong_actor_ptr spawn_guardian(caf::actor_system& system, const services& outside,
                                     std::vector<child_spec> children, guardian_options options,
                                     supervisor_handle supervisor, std::shared_ptr<guardian_status> status) {
  return caf::actor_cast<caf::strong_actor_ptr>(system.spawn<guardian>(outside, std::move(children), std::move(options),
                                                                       std::move(supervisor), std::move(status)));
}

void tell_guardian_to_start(const caf::strong_actor_ptr& guardian) {
  guardian->enqueue(make_internal_mail(start_children{}), nullptr);
}

void tell_guardian_to_stop(const caf::strong_actor_ptr& guardian) {
  guardian->enqueue(make_internal_mail(stop_children{}), nullptr);
}

} // namespace godwit::runtime
