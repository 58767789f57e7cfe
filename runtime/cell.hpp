// Base of every actor: what happens around a handler.
//
//   class odometer : public runtime::cell<odometer_handle> {
//   public:
//     using cell::cell;
//   protected:
//     behavior_type handlers() override {
//       return {on<moved>([this](const moved& m) { metres_ += m.distance_m; }),
//               on<get_total>([this](const get_total&) { return total{metres_}; })};
//     }
//   };
//
// The rules that it keeps:
// - Any exception ends the incarnation. With policy redeliver the message is put back in front of the others, up to
// max_crashes.
// - All that a handler sends (tell, ask, tell_after, its answer) is held back until it returns. A handler that throws
// has sent
//   nothing, so handling the message again sends nothing twice.
// - Others hold the stable address, never the incarnation; timers go to the address too.
// - Each delivery is one trace record with the id of the message that caused it.
// - An incarnation that was replaced while its handler hung sends nothing when it wakes up.
// Thread: an actor is never run by two threads at once; its members need no lock.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <caf/all.hpp>

#include "runtime/ask_error.hpp"
#include "runtime/clock.hpp"
#include "runtime/mail.hpp"
#include "runtime/message_type.hpp"
#include "runtime/seam.hpp"
#include "runtime/services.hpp"
#include "runtime/stable_address.hpp"

namespace godwit::runtime {

// What an incarnation is born with.
struct birth {
  const services* outside = nullptr;
  caf::strong_actor_ptr address;    // a stable_address
  std::uint64_t incarnation = 0;    // from 1
  caf::strong_actor_ptr supervisor; // the guardian
  recovered restored;               // empty for actors without durable state
};

// The part of cell that does not depend on the mailbox type. Not for direct use.
class cell_frame {
public:
  cell_frame(const cell_frame&) = delete;
  cell_frame& operator=(const cell_frame&) = delete;

  [[nodiscard]] const std::string& actor_name() const { return address().actor_name(); }
  [[nodiscard]] std::uint64_t incarnation() const { return birth_.incarnation; }

protected:
  cell_frame(caf::scheduled_actor* self, birth born);
  ~cell_frame() = default;

  [[nodiscard]] stable_address& address() const { return address_of(birth_.address); }
  [[nodiscard]] const services& outside() const { return *birth_.outside; }
  [[nodiscard]] std::int64_t now_ns() const { return outside().time->monotonic_ns(); }
  [[nodiscard]] std::int64_t wall_ns() const { return outside().time->wall_ns(); }
  [[nodiscard]] const header& current() const { return current_; } // of the message being handled

  // One message on its way through a handler.
  struct delivery {
    std::int64_t began = 0;              // in ticks of the trace
    stable_address::requester requester; // empty for a tell
    bool is_mail = true;                 // came through the address; an answer or a call of the runtime did not
  };
  [[nodiscard]] delivery begin(const header& head);
  [[nodiscard]] delivery begin_internal(const header& head);
  [[nodiscard]] bool is_repetition(const header& head) const;
  void end_handled(const delivery& d, const message_type& type, const void* body);
  void end_unhandled(const delivery& d, const message_type& type, const void* body, outcome how);
  void end_fenced(const delivery& d, const message_type& type, const void* body);
  void end_crashed(delivery& d, const message_type& type, const void* body, caf::mailbox_element_ptr copy);
  void hit(crash_point point) {
    if (outside().crashes != nullptr) [[unlikely]]
      outside().crashes->hit(point, address().number(), current_.id);
  }

  [[nodiscard]] header stamp();
  // The header of a tell to TO: carries the id of the durable effect that is being let out, if any, and notes the
  // receiver.
  [[nodiscard]] header stamp_tell(const caf::strong_actor_ptr& to);
  void send_later(caf::strong_actor_ptr to, caf::mailbox_element_ptr element, std::int64_t delay_ns = 0);
  void send_held();
  void answer(std::uint64_t request_id, const std::function<caf::mailbox_element_ptr(caf::message_id)>& make);
  // Sends what SEND tells right now instead of when the handler returns.
  template <class F>
  void send_at_once(F send) {
    if (!address().is_current(birth_.incarnation)) // it was replaced while it hung, and must not act any more
      return;
    auto earlier = std::exchange(held_, {});
    send();
    send_held();
    held_ = std::move(earlier);
  }
  // The journal has taken what this message did: from here on it is not put back.
  void mark_committed() { committed_ = true; }
  void report_up();
  void leave();
  void record(const delivery& d, const message_type& type, const void* body, outcome how) {
    if (outside().trace != nullptr)
      record_in(*outside().trace, d, type, body, how);
  }
  void record_in(trace_sink& sink, const delivery& d, const message_type& type, const void* body, outcome how);
  caf::error crash_reason(std::exception_ptr& thrown);
  caf::result<caf::message> handle_runtime_message(caf::message_view& view);
  // Letting effects out once they are on the disk, and the requests whose answers are; both are persistent_cell's
  // business.
  virtual void durable_upto(std::int64_t event);
  virtual void effect_taken_by(std::uint32_t receiver, effect_id id);
  virtual void forget_what_is_gated(); // a write failed for good: none of it will become durable
  [[nodiscard]] virtual std::vector<std::uint64_t> durable_answers() const;

  birth birth_;
  header current_;
  effect_id sending_effect_;                    // stamped into what is told while a durable effect is let out
  std::vector<std::uint32_t> effect_receivers_; // whom it was told to

private:
  struct held_message {
    caf::strong_actor_ptr to;
    caf::mailbox_element_ptr element;
    std::int64_t delay_ns = 0;
    std::uint64_t answers = 0; // id of the request that this is the late answer to
  };

  void answer_failure(const stable_address::requester& r, caf::sec code, const std::string& what);
  void write_dead_letter(const message_type& type, const void* body, int crashes);
  void confirm_effect();

  caf::scheduled_actor* self_;
  std::vector<held_message> held_;
  caf::mailbox_element_ptr put_back_;
  bool in_handler_ = false;
  bool committed_ = false;
  bool left_ = false;
};

template <class Mailbox>
class cell : public Mailbox::base, public cell_frame {
public:
  using handle_type = Mailbox;
  using behavior_type = typename Mailbox::behavior_type;
  static constexpr bool is_persistent = false;

  cell(actor_config& config, birth born) : Mailbox::base(config), cell_frame(this, std::move(born)) {
    this->set_exception_handler(
        [this](caf::scheduled_actor*, std::exception_ptr& thrown) { return crash_reason(thrown); });
    this->set_default_handler(
        [this](caf::scheduled_actor*, caf::message_view& view) { return handle_runtime_message(view); });
  }

  const char* name() const override { return address().actor_name().c_str(); }
  void on_exit() override { leave(); }

protected:
  using cell_frame::address; // not CAF's, which is of the incarnation

  // The handlers, one `on` for each word of the mailbox.
  virtual behavior_type handlers() = 0;
  // Called once before the first message.
  virtual void started() {}

  behavior_type make_behavior() override {
    auto result = handlers();
    started();
    report_up();
    return result;
  }

  [[nodiscard]] Mailbox me() const { return caf::actor_cast<Mailbox>(birth_.address); }

  // A handler for a tell (F returns nothing) or an ask (F returns the answer).
  template <class T, class F>
  auto on(F handler) {
    if constexpr (std::is_void_v<std::invoke_result_t<F&, const T&>>) {
      return [this, handler = std::move(handler)](const mail<T>& m) mutable {
        deliver(m, [&](const delivery&) { handler(m.body); });
      };
    } else {
      using answer_type = std::invoke_result_t<F&, const T&>;
      return [this, handler = std::move(handler)](const mail<T>& m) mutable -> caf::delegated<mail<answer_type>> {
        deliver(m, [&](const delivery& d) { answer_now(d.requester, handler(m.body)); });
        return {};
      };
    }
  }

  // A handler for an ask that is answered later, by answer_later(id, R). A crash in between answers "outcome unknown".
  template <class Q, class R, class F>
  auto on_deferred(F handler) {
    return [this, handler = std::move(handler)](const mail<Q>& m) mutable -> caf::delegated<mail<R>> {
      deliver(m, [&](const delivery& d) {
        if (address().expect_answer(m.head.id, d.requester))
          handler(m.body, m.head.id);
      });
      return {};
    };
  }

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell(const Handle& to, T body) {
    auto receiver = caf::actor_cast<caf::strong_actor_ptr>(to);
    auto content = element(stamp_tell(receiver), std::move(body));
    send_later(std::move(receiver), std::move(content));
  }

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell_after(std::chrono::nanoseconds delay, const Handle& to, T body) {
    send_later(caf::actor_cast<caf::strong_actor_ptr>(to), element(stamp(), std::move(body)), delay.count());
  }

  // Both callbacks are required: ON_ANSWER(const answer&) or ON_ERROR(const ask_error&) is called, once, unless this
  // incarnation crashes first. Keep the time-out short: its timer holds the actor in memory until it expires.
  template <class Handle, class Q, class OnAnswer, class OnError>
  requires accepts<Handle, Q>
  void ask(const Handle& to, std::chrono::nanoseconds timeout, Q question, OnAnswer on_answer, OnError on_error) {
    using answer_type = answer_t<Handle, Q>;
    const auto id = this->new_request_id(caf::message_priority::normal);
    const auto head = stamp();
    this->add_multiplexed_response_handler(
        id.response_id(),
        caf::behavior{[this, on_answer = std::move(on_answer)](const mail<answer_type>& m) mutable {
                        deliver(m, [&](const delivery&) { on_answer(m.body); });
                      },
                      [this, head, on_error = std::move(on_error)](caf::error& why) mutable {
                        const mail<ask_failed> m{{head.id, head.id, 0, 0, address().number()}, {describe(why)}};
                        deliver(m, [&](const delivery&) { on_error(m.body.why); });
                      }});
    this->request_response_timeout(caf::duration{timeout}, id);
    send_later(caf::actor_cast<caf::strong_actor_ptr>(to),
               caf::make_mailbox_element(this->ctrl(), id, {}, mail<Q>{head, std::move(question)}));
  }

  template <io::has_fields R>
  void answer_later(std::uint64_t request_id, R value) {
    answer(request_id, [&](caf::message_id mid) {
      return caf::make_mailbox_element(birth_.address, mid.response_id(), {}, mail<R>{stamp(), std::move(value)});
    });
  }

  // Runs F as the handling of a message of the runtime's own: held back, traced, but never put back.
  template <class T, class F>
  void run_internal(const mail<T>& m, F f) {
    delivery d = begin_internal(m.head);
    try {
      f();
    } catch (...) {
      end_crashed(d, type_of<T>, &m.body, nullptr);
      throw;
    }
    end_handled(d, type_of<T>, &m.body);
  }

private:
  template <class T>
  caf::mailbox_element_ptr element(const header& head, T body) {
    return caf::make_mailbox_element(birth_.address, caf::make_message_id(), {}, mail<T>{head, std::move(body)});
  }

  template <io::has_fields R>
  void answer_now(const stable_address::requester& r, R value) {
    if (r.who)
      send_later(r.who, caf::make_mailbox_element(birth_.address, r.mid.response_id(), {},
                                                  mail<R>{stamp(), std::move(value)}));
  }

  template <class T, class F>
  void deliver(const mail<T>& m, F handler) {
    auto d = begin(m.head);
    if (is_repetition(m.head)) [[unlikely]] {
      end_unhandled(d, type_of<T>, &m.body, outcome::repetition);
      return;
    }
    try {
      hit(crash_point::before_handler);
      handler(d);
      hit(crash_point::after_handler);
    } catch (...) {
      end_crashed(d, type_of<T>, &m.body, caf::make_mailbox_element(d.requester.who, d.requester.mid, {}, m));
      throw;
    }
    end_handled(d, type_of<T>, &m.body);
  }
};

} // namespace godwit::runtime
