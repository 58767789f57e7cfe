// What an actor sends: held back until its handler returns.
#include "runtime/frame_parts.hpp"

#include <algorithm>
#include <utility>

#include "runtime/internal_messages.hpp"

namespace godwit::runtime {

// -- sending --------------------------------------------------------------------------------------

header actor_frame::stamp() { return {address().next_id(), current_.id, 0, 0, address().number()}; }

void actor_frame::send(const actor_ref& to, const message_type& type, message_body body) {
  auto head = stamp();
  if (sending_effect_.event != 0 && to) {
    head.effect_event = sending_effect_.event;
    head.effect_n = sending_effect_.n;
    effect_receivers_.push_back(address_of(to).number());
  }
  hold({strong(to), make_mail(strong(context_.address), caf::make_message_id(), {head, &type, std::move(body)}), 0, 0});
}

void actor_frame::send_after(std::chrono::nanoseconds delay, const actor_ref& to, const message_type& type,
                             message_body body) {
  hold({strong(to), make_mail(strong(context_.address), caf::make_message_id(), {stamp(), &type, std::move(body)}),
        delay.count(), 0});
}

void actor_frame::hold(held_message message) {
  held_.push_back(std::move(message));
  if (!in_handler_)
    send_held();
}

void actor_frame::send_held() {
  auto& host = *context_.host;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    auto& each = held_[i];
    if (each.answers != 0)
      each.to = address().take_requester(each.answers).who; // null: it has been answered meanwhile
    if (!each.to)
      continue;
    if (outside().replayed != nullptr) [[unlikely]] {
      outside().replayed->take(*each.to.get(), *each.element, each.delay_ns, each.answer_type);
      continue;
    }
    if (each.delay_ns <= 0)
      each.to->enqueue(std::move(each.element), host.context());
    else
      host.clock().schedule_message(host.clock().now() + std::chrono::nanoseconds(each.delay_ns), std::move(each.to),
                                    std::move(each.element));
  }
  held_.clear();
}

void actor_frame::send_at_once(const std::function<void()>& send) {
  if (!address().is_current(context_.number)) // it was replaced while it hung, and must not act any more
    return;
  auto earlier = std::exchange(held_, {});
  send();
  send_held();
  held_ = std::move(earlier);
}

std::vector<std::uint32_t> actor_frame::send_as_effect(effect_id effect, const std::function<void()>& send) {
  sending_effect_ = effect;
  effect_receivers_.clear();
  send();
  sending_effect_ = {};
  return std::exchange(effect_receivers_, {});
}

void actor_frame::forget_held() {
  held_.clear();
  ends_.clear();
}

// -- the journal ----------------------------------------------------------------------------------

std::function<void(const commit_result&)> actor_frame::tell_me_when_durable(std::int64_t event) const {
  return [address = strong(context_.address), event, incarnation = context_.number](const commit_result& result) {
    address->enqueue(result ? make_internal_mail(durable{event})
                            : make_internal_mail(write_failed{incarnation, result.error().message()}),
                     nullptr);
  };
}

void actor_frame::mark_committed() {
  committed_ = true;
  is_done_for_good_ = true;
  if (has_submitted_)
    address().keep_from_return(current_.id);
}

void actor_frame::note_submitted(std::int64_t event) {
  const bool is_noted = std::exchange(has_submitted_, true) || is_done_for_good_;
  committed_ = true;
  unwritten_message noted;
  noted.event = event;
  noted.incarnation = context_.number;
  if (!is_noted && handling_ != nullptr && delivering_->is_mail && address().policy() == on_crash::redeliver) {
    noted.sender = delivering_->requester.who ? delivering_->requester.who : delivering_->effect_sender;
    noted.mid = delivering_->requester.mid;
    noted.content = *handling_;
    if (current_.effect_event != 0)
      noted.seen_before = address().mark_seen(current_.sender, {current_.effect_event, current_.effect_n});
  }
  address().submitted(std::move(noted));
}

void actor_frame::note_written(std::int64_t upto) { address().written(upto); }

void actor_frame::retry_write_after(std::chrono::nanoseconds delay) {
  send_after(delay, context_.address, type_of<retry_write>(), message_body::of(retry_write{}));
}

envelope actor_frame::own_message_of(const message_type& type, message_body body) {
  return {{address().next_id(), 0, 0, 0, address().number()}, &type, std::move(body)};
}

void actor_frame::mark_seen(std::uint32_t source, effect_id id) { (void)address().mark_seen(source, id); }

void actor_frame::wake_at(std::int64_t due_ns) {
  if (due_ns == never_due || (deadline_ns_ && *deadline_ns_ <= due_ns))
    return;
  deadline_ns_ = due_ns;
  const auto delay = std::max<std::int64_t>(due_ns - outside().time->monotonic_ns(), 0); // the handler took its time
  send_after(std::chrono::nanoseconds(delay), context_.address, type_of<deadline>(),
             message_body::of(deadline{++deadline_number_}));
}

void actor_frame::show_health(condition how) {
  if (shown_ == how)
    return;
  outside().health->post(actor_name(), how.how, how.reason);
  shown_ = std::move(how);
}

void actor_frame::report_up() {
  strong(context_.supervisor)
      ->enqueue(make_internal_mail(child_up{address().number(), context_.number}), context_.host->context());
}

// -- questions and answers ------------------------------------------------------------------------

void actor_frame::request(const actor_ref& to, std::chrono::nanoseconds timeout, const message_type& type,
                          message_body body, const message_type& answer_type,
                          std::function<void(const envelope&)> on_answer,
                          const std::function<void(const ask_error&)>& on_error) {
  auto& host = *context_.host;
  const auto id = host.new_request_id(caf::message_priority::normal);
  const auto head = stamp();
  host.add_multiplexed_response_handler(
      id.response_id(),
      caf::behavior{[this, &answer_type, on_answer = std::move(on_answer), on_error](const envelope& m) {
                      receive_answer(m, answer_type, on_answer, on_error);
                    },
                    [this, head, on_error](caf::error& why) { receive_failure(head, describe(why), on_error); }});
  host.request_response_timeout(caf::duration{timeout}, id);
  hold({strong(to), make_mail(host.ctrl(), id, {head, &type, std::move(body)}), 0, 0, &answer_type});
}

void actor_frame::receive_answer(const envelope& m, const message_type& expected,
                                 const std::function<void(const envelope&)>& on_answer,
                                 const std::function<void(const ask_error&)>& on_error) {
  if (m.type == &expected) {
    deliver(begin(m.head, *context_.host->current_mailbox_element()), m, on_answer);
    return;
  }
  const std::string sentence =
      "was answered with " + std::string(m.type->name) + " where it had asked for " + std::string(expected.name);
  address().count_wrong_answer();
  outside().health->post(actor_name(), health_colour::yellow, sentence);
  receive_failure({m.head.cause, 0, 0, 0, m.head.sender}, {ask_errc::outcome_unknown, actor_name() + ' ' + sentence},
                  on_error);
}

void actor_frame::receive_failure(const header& asked, ask_error why,
                                  const std::function<void(const ask_error&)>& on_error) {
  const auto m = envelope::of({asked.id, asked.id, 0, 0, address().number()}, ask_failed{std::move(why)});
  deliver(begin(m.head, *context_.host->current_mailbox_element()), m,
          [&](const envelope& failed) { on_error(failed.as<ask_failed>().why); });
}

void actor_frame::answer_now(const message_type& type, message_body body) {
  const auto& requester = delivering_->requester;
  if (requester.who)
    hold({requester.who,
          make_mail(strong(context_.address), requester.mid.response_id(), {stamp(), &type, std::move(body)}), 0, 0});
}

bool actor_frame::defer_answer() { return address().expect_answer(current_.id, delivering_->requester); }

void actor_frame::answer_deferred(std::uint64_t request_id, const message_type& type, message_body body) {
  const auto mid = address().awaited_mid(request_id);
  if (!mid)
    return; // nobody waits any more
  auto head = stamp();
  head.cause = request_id;
  hold({nullptr, make_mail(strong(context_.address), mid->response_id(), {head, &type, std::move(body)}), 0,
        request_id});
}

} // namespace godwit::runtime
