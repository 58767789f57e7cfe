// What happens around a handler. What an actor sends: actor_frame_sending.cpp; how an incarnation ends:
// actor_frame_end.cpp.
#include "runtime/actor_frame.hpp"

#include "io/fields/utf8.hpp"
#include "runtime/frame_parts.hpp"
#include "runtime/internal_messages.hpp"

namespace godwit::runtime {

actor_frame::actor_frame(spawn_context context) : context_(std::move(context)) {}

actor_frame::~actor_frame() = default;

stable_address& actor_frame::address() const { return address_of(context_.address); }

const std::string& actor_frame::actor_name() const { return address().actor_name(); }

void actor_frame::hit(crash_point point) {
  if (outside().crashes != nullptr) [[unlikely]]
    outside().crashes->hit(point, address().number(), current_.id);
}

void actor_frame::on_deadline() {}

void actor_frame::submit_decisions() {}

void actor_frame::handler_has_ended() {}

bool actor_frame::takes_mail() const { return true; }

void actor_frame::retry_refused_write() {}

std::int64_t actor_frame::submitted_upto() const { return 0; }

void actor_frame::durable_upto(std::int64_t) {}

void actor_frame::effect_taken_by(std::uint32_t, effect_id) {}

void actor_frame::forget_what_is_gated() {}

std::vector<std::uint64_t> actor_frame::durable_answers() const { return {}; }

// -- around a handler -----------------------------------------------------------------------------

actor_frame::delivery actor_frame::begin_internal(const header& head) {
  delivery d;
  current_ = head;
  in_handler_ = true;
  handler_time_.reset();
  committed_ = false;
  has_submitted_ = false;
  is_done_for_good_ = false;
  d.is_mail = false;
  if (outside().trace != nullptr)
    d.began = outside().trace->ticks();
  return d;
}

actor_frame::moment actor_frame::handler_time() const {
  if (!in_handler_ || !handler_time_)
    handler_time_ = {outside().time->monotonic_ns(), outside().time->wall_ns()};
  return *handler_time_;
}

actor_frame::delivery actor_frame::begin(const header& head, caf::mailbox_element& element) {
  auto d = begin_internal(head);
  // CAF must not answer by itself: a request that crashes its handler is put back and answered by the next incarnation.
  if (element.mid.is_request()) {
    d.requester = {element.sender, element.mid};
    element.mid = caf::make_message_id();
  }
  if (head.effect_event != 0)
    d.effect_sender = element.sender;
  d.is_mail = !element.mid.is_response();
  return d;
}

void actor_frame::receive(const envelope& m) {
  const auto* row = handlers_.find(m.type);
  if (row == nullptr) {
    if (m.is<deadline>())
      deliver(begin(m.head, *context_.host->current_mailbox_element()), m, [this](const envelope& due) { hear(due); });
    else if (!handle_runtime_message(m))
      refuse_unknown(m);
  } else if ((kept_.empty() && takes_mail()) || m.head.sender == address().number()) {
    deliver(begin(m.head, *context_.host->current_mailbox_element()), m, row->call);
  } else {
    keep_off(m);
  }
}

void actor_frame::hear(const envelope& due) {
  if (due.as<deadline>().number != deadline_number_)
    return;
  deadline_ns_.reset();
  on_deadline();
}

void actor_frame::deliver(delivery d, const envelope& m, const std::function<void(const envelope&)>& handle) {
  if (is_repetition(m.head)) [[unlikely]] {
    end_unhandled(d, m, outcome::repetition, &address_counters::repeated);
    return;
  }
  delivering_ = &d;
  handling_ = &m;
  address().begins_handling(m.head.id);
  try {
    hit(crash_point::before_handler);
    handle(m);
    hit(crash_point::after_handler);
    finish_handler();
  } catch (...) {
    delivering_ = nullptr;
    handling_ = nullptr;
    end_crashed(d, m);
    throw;
  }
  delivering_ = nullptr;
  handling_ = nullptr;
  end_handled(d, m);
}

// The decisions first, as one write; then what waited for the end.
void actor_frame::finish_handler() {
  submit_decisions();
  if (ends_.empty() || !address().is_current(context_.number))
    return;
  while (!ends_.empty()) {
    for (std::size_t i = 0; i < ends_.size(); ++i) { // one may add another
      const auto run = std::move(ends_[i]);
      run();
    }
    ends_.clear();
    submit_decisions(); // which may add one
  }
}

void actor_frame::run_internal(const envelope& m, const std::function<void()>& f) {
  const auto d = begin_internal(m.head);
  try {
    f();
    finish_handler();
  } catch (...) {
    end_crashed(d, m);
    throw;
  }
  end_handled(d, m);
}

// -- while the journal takes nothing more ---------------------------------------------------------

// Asks are refused; streams are dropped, and counted; the rest waits, in order.
void actor_frame::keep_off(const envelope& m) {
  auto& element = *context_.host->current_mailbox_element();
  if (element.mid.is_request()) {
    const auto d = begin(m.head, element);
    end_unhandled(d, m, outcome::not_accepted, &address_counters::refused);
    address().answer_failure(d.requester, caf::sec::request_receiver_down,
                             "takes nothing more now: what it has decided waits for the journal");
  } else if (address().policy() == on_crash::lose) {
    end_unhandled(begin(m.head, element), m, outcome::not_accepted, &address_counters::lost);
  } else {
    kept_.push_back({make_mail(element.sender, element.mid, m)});
  }
}

void actor_frame::take_kept() {
  std::size_t taken = 0;
  try {
    for (; taken < kept_.size() && takes_mail() && address().is_current(context_.number); ++taken) {
      const auto m = *envelope_in(*kept_[taken].element);
      deliver(begin(m.head, *kept_[taken].element), m, handlers_.find(m.type)->call);
    }
  } catch (...) {
    kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(taken) + 1);
    throw;
  }
  kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(taken));
}

// -- how a handler ends ---------------------------------------------------------------------------

bool actor_frame::is_repetition(const header& head) const {
  return head.effect_event != 0 && address().has_seen(head.sender, {head.effect_event, head.effect_n});
}

void actor_frame::end_handled(const delivery& d, const envelope& m) {
  if (!address().is_current(context_.number)) [[unlikely]] {
    end_fenced(d, m);
    return;
  }
  send_held();
  handler_has_ended();
  confirm_effect(d);
  if (d.is_mail) {
    if (!has_submitted_) // else it is resolved when that is on the disk
      address().resolved(current_.id);
    address().count_handled();
  }
  in_handler_ = false;
  record(d, m, outcome::handled);
}

void actor_frame::end_unhandled(const delivery& d, const envelope& m, outcome how,
                                std::uint64_t address_counters::*why) {
  forget_held();
  in_handler_ = false;
  if (how == outcome::repetition)
    confirm_effect(d);
  if (d.is_mail && committed_)
    address().count_handled();
  else if (d.is_mail)
    address().count_unhandled(why);
  record(d, m, how);
}

// Tells the sender of a durable effect that it arrived, when all that this actor has decided is on the disk.
void actor_frame::confirm_effect(const delivery& d) {
  if (current_.effect_event == 0)
    return;
  address().mark_seen(current_.sender, {current_.effect_event, current_.effect_n});
  if (d.effect_sender)
    address().confirm({d.effect_sender,
                       make_internal_mail(effect_taken{current_.effect_event, current_.effect_n, address().number()})},
                      context_.host->context());
}

// -- the trace ------------------------------------------------------------------------------------

void actor_frame::record(const delivery& d, const envelope& m, outcome how) {
  auto* sink = outside().trace;
  if (sink == nullptr)
    return;
  trace_entry entry;
  entry.began = d.began;
  entry.ended = sink->ticks();
  if (handler_time_) {
    entry.clock_ns = handler_time_->monotonic_ns;
    entry.wall_ns = handler_time_->wall_ns;
  }
  entry.id = current_.id;
  entry.cause = current_.cause;
  entry.actor = address().number();
  entry.sender = current_.sender;
  entry.incarnation = static_cast<std::uint32_t>(context_.number);
  entry.how = how;
  sink->record(entry, *m.type, m.body.data());
}

trace_entry actor_frame::entry_without_id() const {
  trace_entry entry;
  entry.began = outside().trace->ticks();
  entry.ended = entry.began;
  entry.actor = address().number();
  entry.sender = entry.actor;
  entry.incarnation = static_cast<std::uint32_t>(context_.number);
  return entry;
}

void actor_frame::record_observed(const message_type& type, const void* value) {
  auto entry = entry_without_id();
  entry.cause = current_.id;
  outside().trace->record(entry, type, value);
}

void actor_frame::note_call(std::string what, std::uint64_t hash) {
  const outside_call call{std::move(what), hash};
  if (outside().replayed != nullptr)
    outside().replayed->called(call);
  else if (is_traced())
    record_observed(type_of<outside_call>(), &call);
}

void actor_frame::record_restored(const std::string& document) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; document.size() <= max_restored_bytes && at < document.size();) {
    const auto rest = std::string_view(document).substr(at);
    parts.emplace_back(rest.substr(0, io::whole_characters(rest, restored_part_bytes)));
    at += parts.back().size();
  }
  restored each{0, static_cast<std::uint32_t>(parts.size()), document.size(), {}};
  do {
    if (!parts.empty())
      each.text = std::move(parts[each.part]);
    outside().trace->record(entry_without_id(), type_of<restored>(), &each);
  } while (++each.part < each.parts);
}

// -- the runtime's own messages, and what nobody takes --------------------------------------------

bool actor_frame::handle_runtime_message(const envelope& m) {
  if (!is_runtime_message(m))
    return false;
  address().count_runtime_messages(1);
  if (m.is<ping>()) {
    strong(context_.supervisor)
        ->enqueue(make_internal_mail(pong{address().number(), m.as<ping>().key}), context_.host->context());
  } else if (m.is<durable>()) {
    durable_upto(m.as<durable>().upto);
    take_kept();
  } else if (m.is<effect_taken>()) {
    const auto& taken = m.as<effect_taken>();
    effect_taken_by(taken.receiver, {taken.event, taken.n});
    take_kept();
  } else if (m.is<retry_write>()) {
    run_internal(own_message(retry_write{}), [this] { retry_refused_write(); });
    take_kept();
  } else {
    end_for_failed_write(m.as<write_failed>());
  }
  return true;
}

void actor_frame::refuse_unknown(const envelope& m) {
  const auto d = begin(m.head, *context_.host->current_mailbox_element());
  in_handler_ = false;
  record(d, m, outcome::not_accepted);
  address().count_unhandled(&address_counters::not_accepted);
  outside().health->post(actor_name(), health_colour::yellow,
                         "was sent " + std::string(m.type->name) + ", which it does not take");
  address().answer_failure(d.requester, caf::sec::unexpected_message, "does not accept this message");
}

// Something that is no envelope: nothing in godwit sends such a thing.
void actor_frame::receive_unknown() {
  address().count_unhandled(&address_counters::not_accepted);
  outside().health->post(actor_name(), health_colour::yellow, "was sent something that is no message of godwit's");
}

} // namespace godwit::runtime
