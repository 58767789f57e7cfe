// How a handler ends badly, and what becomes of the mail of an incarnation that ends.
#include "runtime/frame_parts.hpp"

#include "runtime/internal_messages.hpp"
#include "runtime/planted_bug.hpp"
#include "runtime/stored_state.hpp"

namespace godwit::runtime {

namespace {

std::string current_exception_text() {
  try {
    throw;
  } catch (const std::exception& thrown) {
    return thrown.what();
  } catch (...) {
    return "unknown exception";
  }
}

// Of the exception being handled.
bool is_commit_refusal() {
  try {
    throw;
  } catch (const commit_refused&) {
    return true;
  } catch (...) {
    return false;
  }
}

} // namespace

// -- a handler that threw, or whose incarnation was replaced ---------------------------------------

// What the journal had taken before is the successor's to dispatch; of anything else the sender hears that it is not
// known.
void actor_frame::end_fenced(const delivery& d, const envelope& m) {
  if (d.is_mail && !committed_) {
    (void)address().take_requester(current_.id);
    address().answer_failure(d.requester, caf::sec::runtime_error, "was replaced while it had this request");
  }
  end_unhandled(d, m, outcome::fenced, &address_counters::lost);
  context_.host->quit(caf::exit_reason::user_shutdown);
}

void actor_frame::end_crashed(const delivery& d, const envelope& m) {
  const bool not_its_fault = is_commit_refusal();
  forget_held();
  in_handler_ = false;
  record(d, m, outcome::crashed);
  if (committed_) { // the journal has it: the message did its work, only the incarnation is lost
    if (d.is_mail) {
      if (!has_submitted_)
        address().resolved(current_.id);
      address().count_handled();
      confirm_effect(d);
    }
    return;
  }
  if (!d.is_mail) // the callback went with the incarnation; who asks again gets a new answer
    return;
  (void)address().take_requester(current_.id); // on_deferred may have noted it; from here on D owns it
  if (address().policy() == on_crash::lose) {
    address().count_unhandled(&address_counters::lost);
    address().answer_failure(d.requester, caf::sec::runtime_error, "crashed on this request");
    return;
  }
  address().count_unhandled(nullptr);
  int crashes = 0;
  // A message is not to blame for a journal that takes nothing.
  if (not_its_fault || address().may_retry(current_.id, crashes) ||
      !write_dead_letter(m, crashes, current_exception_text())) {
    if (GODWIT_PLANTED(drop_redelivery))
      return;
    // The sender goes along: what is put back is confirmed to it in the end.
    requeued_.push_back({make_mail(d.requester.who ? d.requester.who : d.effect_sender, d.requester.mid, m)});
    return;
  }
  confirm_effect(d);
  address().answer_failure(d.requester, caf::sec::unexpected_message,
                           "gave this request up after it crashed its handler " + std::to_string(crashes) + " times");
}

// False: the journal takes none now. A message is not given up without a trace.
bool actor_frame::write_dead_letter(const envelope& m, int crashes, const std::string& reason) {
  if (outside().durable == nullptr) {
    address().given_up(m.head.id);
    return true;
  }
  journal_write write;
  write.actor = actor_name();
  write.incarnation = context_.number;
  write.dead_letters.push_back(make_dead_letter(m, wall_ns(), outside().names->name(current_.sender), crashes, reason));
  if (auto taken = outside().durable->submit(std::move(write)); !taken) {
    outside().health->post("dead_letters", health_colour::red, taken.error().message());
    address().put_back_all_the_same();
    return false;
  }
  address().given_up(m.head.id);
  return true;
}

std::string actor_frame::crash_reason(std::exception_ptr& thrown) {
  std::string text;
  try {
    std::rethrow_exception(thrown);
  } catch (const state_unreadable& refused) {
    text = refused.what();
    address().note_beyond_restart();
  } catch (...) {
    text = current_exception_text();
  }
  address().note_crash(text);
  return text;
}

// -- a write that can never commit ----------------------------------------------------------------

// What led to it and to the later ones is put back. The first message is to blame, and given up after max_crashes. One
// that comes late, when all of that has happened to an earlier incarnation, says nothing new.
void actor_frame::end_for_failed_write(const write_failed& why) {
  auto messages = address().take_returned();
  if (messages.empty() && why.incarnation != context_.number)
    return;
  forget_what_is_gated();
  is_broken_ = true;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    auto& each = messages[i];
    const auto& m = each.content;
    if (m.type == nullptr) // of the runtime's own, a stream's, or one that can not be taken back
      continue;
    current_ = m.head;
    int crashes = 0;
    if (i > 0 || address().may_retry(m.head.id, crashes) || !write_dead_letter(m, crashes, why.what)) {
      requeued_.push_back({make_mail(std::move(each.sender), each.mid, m)});
      continue;
    }
    delivery d;
    if (m.head.effect_event != 0)
      d.effect_sender = each.sender;
    confirm_effect(d);
    address().answer_failure({std::move(each.sender), each.mid}, caf::sec::unexpected_message,
                             "gave this request up: what it decided can not be written");
  }
  throw std::runtime_error(why.what);
}

// -- the end of an incarnation --------------------------------------------------------------------

namespace {

// Mail that means the same to the next incarnation: not answers, not CAF's own signals, not the runtime's.
bool is_ordinary(const caf::mailbox_element& element) {
  const auto& content = element.content();
  return !element.mid.is_response() && !content.match_elements<caf::exit_msg>() &&
         !content.match_elements<caf::timeout_msg>() && !content.match_elements<caf::down_msg>() &&
         !is_runtime_message(element);
}

} // namespace

void actor_frame::leave() {
  if (std::exchange(left_, true))
    return;
  auto& host = *context_.host;
  // First: else mail could still arrive after the last look into the mailbox.
  address().park_from_now(host.ctrl(), context_.number);
  std::vector<caf::mailbox_element_ptr> mail;
  const auto put_back_all = [&](std::deque<unwritten_message> messages) {
    for (auto& each : messages)
      if (each.content.type != nullptr)
        mail.push_back(make_mail(std::move(each.sender), each.mid, std::move(each.content)));
  };
  auto lost = address().take_unwritten(context_.number, is_broken_ ? 0 : submitted_upto());
  if (!is_broken_) { // else requeued_ has what is older
    put_back_all(address().take_returned());
    put_back_all(std::exchange(lost, {}));
  }
  for (auto& each : requeued_)
    mail.push_back(std::move(each.element));
  put_back_all(std::move(lost));
  const auto requeued = mail.size();
  for (auto& each : kept_)
    mail.push_back(std::move(each.element));
  std::size_t runtime_messages = 0;
  auto take_all = [&](auto& queue) {
    while (auto element = queue.take_front()) {
      if (is_ordinary(*element))
        mail.push_back(std::move(element));
      else if (is_runtime_message(*element))
        ++runtime_messages;
    }
  };
  host.mailbox().fetch_more();
  take_all(host.get_urgent_queue());
  take_all(host.get_normal_queue());
  address().count_runtime_messages(runtime_messages);
  address().give_back(std::move(mail), requeued);
  address().give_up_answers(durable_answers(), context_.number);
}

} // namespace godwit::runtime
