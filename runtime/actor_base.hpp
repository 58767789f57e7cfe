// Base of every actor.
//
//   class odometer : public runtime::actor_base<odometer_handle> {
//   public:
//     using actor_base::actor_base;
//   protected:
//     behavior_type handlers() override {
//       return {on<moved>([this](const moved& m) { metres_ += m.distance_m; }),
//               on<get_total>([this](const get_total&) { return total{metres_}; })};
//     }
//   };
//
// What happens around a handler, and the rules that it keeps: actor_frame.hpp. Thread: an actor is never run by two
// threads at once; its members need no lock.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "runtime/actor_frame.hpp"
#include "runtime/content_hash.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/seam.hpp"

namespace godwit::runtime {

template <class Mailbox>
class actor_base : public actor_frame {
public:
  using handle_type = Mailbox;
  using behavior_type = handlers_of<Mailbox>;
  static constexpr bool is_durable = false;

  explicit actor_base(spawn_context context) : actor_frame(std::move(context)) {}

protected:
  // The handlers, one `on` for each word of the mailbox.
  virtual behavior_type handlers() = 0;
  // Called once before the first message.
  virtual void started() {}

  void start() override {
    run_internal(own_message(begun{}), [this] { begin_life(); });
  }
  void begin_life() {
    set_handlers(handlers());
    started();
    report_up();
  }

  [[nodiscard]] Mailbox me() const { return Mailbox(context().address); }

  // An input that comes by no mailbox (facts of the host, of the process): recorded where it differs from LAST. Where
  // the actor is replayed, VALUE becomes what was recorded.
  template <io::has_fields T>
  void observe(T& value, std::optional<T>& last) {
    if (outside().replayed != nullptr) {
      outside().replayed->observed(type_of<T>(), &value);
    } else if (is_traced() && !(last && io::equal(*last, value))) {
      record_observed(type_of<T>(), &value);
      last = value;
    }
  }

  // As note_call, of something with a field table.
  template <io::has_fields T>
  void note_call_with(std::string what, const T& content) {
    if (!is_recorded())
      return;
    std::string text;
    type_of<T>().append_json(text, &content);
    note_call(std::move(what), content_hash(text));
  }

  // The next input from a queue beside the mailbox: what TAKE gives, as an optional, recorded. Where the actor is
  // replayed it comes from the record, and TAKE is not called.
  template <io::has_fields T, class Take>
  std::optional<T> take_beside(Take take) {
    if (outside().replayed != nullptr) {
      T value;
      return outside().replayed->taken(type_of<T>(), &value) ? std::optional(std::move(value)) : std::nullopt;
    }
    std::optional<T> result = take();
    if (result && is_traced())
      record_observed(type_of<T>(), &*result);
    return result;
  }

  // A handler for a tell (F returns nothing) or an ask (F returns the answer).
  template <class T, class F>
  auto on(F handle) {
    using answer_type = std::invoke_result_t<F&, const T&>;
    if constexpr (std::is_void_v<answer_type>)
      return handler<tells<T>>{
          {&type_of<T>(), [handle = std::move(handle)](const envelope& m) mutable { handle(m.as<T>()); }}};
    else
      return handler<asks<T, answer_type>>{
          {&type_of<T>(), [this, handle = std::move(handle)](const envelope& m) mutable {
             answer_now(type_of<answer_type>(), message_body::of<answer_type>(handle(m.as<T>())));
           }}};
  }

  // A handler for an ask that is answered later, by answer_later(id, R). A crash in between answers "outcome unknown".
  template <class Q, class R, class F>
  handler<asks<Q, R>> on_deferred(F handle) {
    return {{&type_of<Q>(), [this, handle = std::move(handle)](const envelope& m) mutable {
               if (defer_answer())
                 handle(m.as<Q>(), m.head.id);
             }}};
  }

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell(const Handle& to, T body) { send(to.ref(), type_of<T>(), message_body::of(std::move(body))); }

  template <class Handle, class T>
  requires accepts<Handle, T>
  void tell_after(std::chrono::nanoseconds delay, const Handle& to, T body) {
    send_after(delay, to.ref(), type_of<T>(), message_body::of(std::move(body)));
  }

  // Both callbacks are required: ON_ANSWER(const answer&) or ON_ERROR(const ask_error&) is called, once, unless this
  // incarnation crashes first. Keep the time-out short: its timer holds the actor in memory until it expires.
  template <class Handle, class Q, class OnAnswer, class OnError>
  requires accepts<Handle, Q>
  void ask(const Handle& to, std::chrono::nanoseconds timeout, Q question, OnAnswer on_answer, OnError on_error) {
    using answer_type = answer_t<Handle, Q>;
    request(
        to.ref(), timeout, type_of<Q>(), message_body::of(std::move(question)), type_of<answer_type>(),
        [on_answer = std::move(on_answer)](const envelope& m) mutable { on_answer(m.as<answer_type>()); },
        std::move(on_error));
  }

  template <io::has_fields R>
  void answer_later(std::uint64_t request_id, R value) {
    answer_deferred(request_id, type_of<R>(), message_body::of(std::move(value)));
  }
};

} // namespace godwit::runtime
