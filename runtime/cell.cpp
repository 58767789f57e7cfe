#include "runtime/cell.hpp"

#include "runtime/internal_messages.hpp"
#include "runtime/journal_exceptions.hpp"

namespace godwit::runtime {

cell_frame::cell_frame(caf::scheduled_actor* self, birth born) : birth_(std::move(born)), self_(self) {}

void cell_frame::durable_upto(std::int64_t) {}

void cell_frame::effect_taken_by(std::uint32_t, effect_id) {}

void cell_frame::forget_what_is_gated() {}

std::vector<std::uint64_t> cell_frame::durable_answers() const { return {}; }

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

// -- around a handler -----------------------------------------------------------------------------

cell_frame::delivery cell_frame::begin_internal(const header& head) {
  delivery d;
  current_ = head;
  in_handler_ = true;
  committed_ = false;
  d.is_mail = false;
  if (outside().trace != nullptr)
    d.began = outside().trace->ticks();
  return d;
}

cell_frame::delivery cell_frame::begin(const header& head) {
  auto d = begin_internal(head);
  // CAF must not answer by itself: a request that crashes its handler is put back and answered by the next incarnation.
  auto* element = self_->current_mailbox_element();
  if (element->mid.is_request()) {
    d.requester = {element->sender, element->mid};
    element->mid = caf::make_message_id();
  }
  d.is_mail = !element->mid.is_response();
  return d;
}

bool cell_frame::is_repetition(const header& head) const {
  return head.effect_event != 0 && address().has_seen(head.sender, {head.effect_event, head.effect_n});
}

void cell_frame::end_handled(const delivery& d, const message_type& type, const void* body) {
  if (!address().is_current(birth_.incarnation)) [[unlikely]] {
    end_fenced(d, type, body);
    return;
  }
  send_held();
  confirm_effect();
  if (d.is_mail) {
    address().settled(current_.id);
    address().count_handled();
  }
  in_handler_ = false;
  record(d, type, body, outcome::handled);
}

void cell_frame::end_unhandled(const delivery& d, const message_type& type, const void* body, outcome how) {
  held_.clear();
  in_handler_ = false;
  if (how == outcome::repetition)
    confirm_effect();
  if (d.is_mail && committed_)
    address().count_handled();
  else if (d.is_mail)
    address().count_unhandled(how == outcome::repetition ? &address_counters::repeated : &address_counters::lost);
  record(d, type, body, how);
}

// What the journal had taken before is the successor's to let out; of anything else the sender hears that it is not
// known.
void cell_frame::end_fenced(const delivery& d, const message_type& type, const void* body) {
  if (d.is_mail && !committed_) {
    (void)address().take_requester(current_.id);
    answer_failure(d.requester, caf::sec::runtime_error, "was replaced while it had this request");
  }
  end_unhandled(d, type, body, outcome::fenced);
  self_->quit(caf::exit_reason::user_shutdown);
}

void cell_frame::end_crashed(delivery& d, const message_type& type, const void* body, caf::mailbox_element_ptr copy) {
  const bool not_its_fault = is_commit_refusal();
  held_.clear();
  in_handler_ = false;
  record(d, type, body, outcome::crashed);
  if (committed_) { // the journal has it: the message did its work, only the incarnation is lost
    if (d.is_mail) {
      address().settled(current_.id);
      address().count_handled();
      confirm_effect();
    }
    return;
  }
  if (!d.is_mail) // the callback went with the incarnation; who asks again gets a new answer
    return;
  (void)address().take_requester(current_.id); // on_deferred may have noted it; from here on D owns it
  if (address().policy() == on_crash::lose) {
    address().count_unhandled(&address_counters::lost);
    answer_failure(d.requester, caf::sec::runtime_error, "crashed on this request");
    return;
  }
  address().count_unhandled(nullptr);
  int crashes = 0;
  // A message is not to blame for a journal that takes nothing.
  if (not_its_fault || address().may_retry(current_.id, crashes)) {
    put_back_ = std::move(copy);
    return;
  }
  write_dead_letter(type, body, crashes);
  confirm_effect();
  answer_failure(d.requester, caf::sec::unexpected_message,
                 "gave this request up after it crashed its handler " + std::to_string(crashes) + " times");
}

// Tells the sender of a durable effect that it arrived. Whatever this actor wrote because of it stands in the journal's
// queue before the sender's mark, so the mark can not reach the disk first.
void cell_frame::confirm_effect() {
  if (current_.effect_event == 0)
    return;
  address().mark_seen(current_.sender, {current_.effect_event, current_.effect_n});
  if (const auto& source = self_->current_mailbox_element()->sender)
    source->enqueue(caf::make_mailbox_element(
                        nullptr, caf::make_message_id(), {},
                        mail<effect_taken>{{}, {current_.effect_event, current_.effect_n, address().number()}}),
                    self_->context());
}

void cell_frame::answer_failure(const stable_address::requester& r, caf::sec code, const std::string& what) {
  if (r.who)
    r.who->enqueue(nullptr, r.mid.response_id(), caf::make_message(caf::make_error(code, actor_name() + ' ' + what)),
                   self_->context());
}

void cell_frame::write_dead_letter(const message_type& type, const void* body, int crashes) {
  if (outside().durable == nullptr)
    return;
  constexpr std::size_t longest_body = 64 * 1024; // encoded bytes of a message that are kept for people to read
  std::vector<std::byte> memory(longest_body);
  io::byte_sink sink(memory);
  type.encode(sink, body);
  std::string text;
  if (!sink.overflow()) {
    io::byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
    type.append_decoded(text, source);
  } else {
    text = R"({"too_long":true})";
  }
  journal_write write;
  write.actor = actor_name();
  write.incarnation = birth_.incarnation;
  write.dead_letters.push_back({current_.id, current_.cause, wall_ns(), outside().names->name(current_.sender),
                                std::string(type.name), std::move(text), crashes, current_exception_text()});
  if (auto taken = outside().durable->submit(std::move(write)); !taken)
    outside().health->post("dead_letters", health_colour::red, taken.error().message());
}

caf::error cell_frame::crash_reason(std::exception_ptr& thrown) {
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
  return caf::make_error(caf::sec::runtime_error, std::move(text));
}

// -- sending --------------------------------------------------------------------------------------

header cell_frame::stamp() { return {address().next_id(), current_.id, 0, 0, address().number()}; }

header cell_frame::stamp_tell(const caf::strong_actor_ptr& to) {
  auto head = stamp();
  if (sending_effect_.event != 0 && to) {
    head.effect_event = sending_effect_.event;
    head.effect_n = sending_effect_.n;
    effect_receivers_.push_back(address_of(to).number());
  }
  return head;
}

void cell_frame::send_later(caf::strong_actor_ptr to, caf::mailbox_element_ptr element, std::int64_t delay_ns) {
  held_.push_back({std::move(to), std::move(element), delay_ns, 0});
  if (!in_handler_)
    send_held();
}

void cell_frame::send_held() {
  for (auto& each : held_) {
    if (each.answers != 0)
      each.to = address().take_requester(each.answers).who; // null: it has been answered meanwhile
    if (!each.to)
      continue;
    if (each.delay_ns <= 0)
      each.to->enqueue(std::move(each.element), self_->context());
    else
      self_->clock().schedule_message(self_->clock().now() + std::chrono::nanoseconds(each.delay_ns),
                                      std::move(each.to), std::move(each.element));
  }
  held_.clear();
}

void cell_frame::answer(std::uint64_t request_id,
                        const std::function<caf::mailbox_element_ptr(caf::message_id)>& make) {
  const auto mid = address().awaited_mid(request_id);
  if (!mid)
    return; // nobody waits any more
  held_.push_back({nullptr, make(*mid), 0, request_id});
  if (!in_handler_)
    send_held();
}

void cell_frame::report_up() {
  birth_.supervisor->enqueue(caf::make_mailbox_element(nullptr, caf::make_message_id(), {},
                                                       mail<child_up>{{}, {address().number(), birth_.incarnation}}),
                             self_->context());
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

void cell_frame::leave() {
  if (std::exchange(left_, true))
    return;
  address().park_from_now(
      self_->ctrl(), birth_.incarnation); // first: else mail could still arrive behind the last look into the mailbox
  std::vector<caf::mailbox_element_ptr> mail;
  if (put_back_)
    mail.push_back(std::move(put_back_));
  const auto put_back = mail.size();
  std::size_t runtime_messages = 0;
  auto take_all = [&](auto& queue) {
    while (auto element = queue.take_front()) {
      if (is_ordinary(*element))
        mail.push_back(std::move(element));
      else if (is_runtime_message(*element))
        ++runtime_messages;
    }
  };
  self_->mailbox().fetch_more();
  take_all(self_->get_urgent_queue());
  take_all(self_->get_normal_queue());
  address().count_runtime_messages(runtime_messages);
  address().give_back(std::move(mail), put_back);
  address().give_up_answers(durable_answers(), birth_.incarnation);
}

// -- the trace ------------------------------------------------------------------------------------

void cell_frame::record_in(trace_sink& sink, const delivery& d, const message_type& type, const void* body,
                           outcome how) {
  trace_entry entry;
  entry.began = d.began;
  entry.ended = sink.ticks();
  entry.id = current_.id;
  entry.cause = current_.cause;
  entry.actor = address().number();
  entry.sender = current_.sender;
  entry.incarnation = static_cast<std::uint32_t>(birth_.incarnation);
  entry.how = how;
  sink.record(entry, type, body);
}

// -- the runtime's own messages -------------------------------------------------------------------

namespace {

// How a message that the mailbox type does not have appears in the trace.
struct unknown_message {
  static constexpr auto fields = io::table("runtime.unknown_message");
};
constexpr unknown_message no_such_word;

} // namespace

caf::result<caf::message> cell_frame::handle_runtime_message(caf::message_view& view) {
  const auto& content = view.content();
  if (content.match_elements<mail<ping>>()) {
    const auto key = content.get_as<mail<ping>>(0).body.key;
    address().count_runtime_messages(1);
    birth_.supervisor->enqueue(
        caf::make_mailbox_element(nullptr, caf::make_message_id(), {}, mail<pong>{{}, {address().number(), key}}),
        self_->context());
  } else if (content.match_elements<mail<durable>>()) {
    address().count_runtime_messages(1);
    durable_upto(content.get_as<mail<durable>>(0).body.upto);
  } else if (content.match_elements<mail<effect_taken>>()) {
    address().count_runtime_messages(1);
    const auto& taken = content.get_as<mail<effect_taken>>(0).body;
    effect_taken_by(taken.receiver, {taken.event, taken.n});
  } else if (content.match_elements<mail<write_failed>>()) {
    address().count_runtime_messages(1);
    forget_what_is_gated();
    throw std::runtime_error(content.get_as<mail<write_failed>>(0).body.what);
  } else {
    current_ = {};
    record({outside().trace != nullptr ? outside().trace->ticks() : 0, {}, true}, type_of<unknown_message>,
           &no_such_word, outcome::not_accepted);
    address().count_unhandled(&address_counters::not_accepted);
    return caf::make_error(caf::sec::unexpected_message, actor_name() + " does not accept this message");
  }
  return caf::message{};
}

// -- errors of asks -------------------------------------------------------------------------------

ask_error describe(const caf::error& why) {
  std::string text;
  if (why.context().match_elements<std::string>())
    text = why.context().get_as<std::string>(0);
  if (why == caf::sec::request_timeout)
    return {ask_errc::timeout, "no answer in time"};
  if (why == caf::sec::request_receiver_down)
    return {ask_errc::not_taken, text.empty() ? "the receiver has stopped" : text};
  if (why == caf::sec::unexpected_message)
    return {ask_errc::given_up, text};
  return {ask_errc::outcome_unknown, text.empty() ? to_string(why) : text};
}

} // namespace godwit::runtime
