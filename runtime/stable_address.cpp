#include "runtime/stable_address.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "runtime/internal_messages.hpp"
#include "runtime/kill_message.hpp"

namespace godwit::runtime {

namespace {

caf::error receiver_down(const std::string& name) {
  return caf::make_error(caf::sec::request_receiver_down, name + " takes no more messages");
}

caf::error outcome_unknown(const std::string& name) {
  return caf::make_error(caf::sec::runtime_error, name + " crashed before it answered; whether it acted is not known");
}

void answer_with(const stable_address::requester& r, caf::error why) {
  if (r.who && r.mid.is_request()) // a tell has nobody who waits
    r.who->enqueue(nullptr, r.mid.response_id(), caf::make_message(std::move(why)), nullptr);
}

bool is_durable_effect(const caf::mailbox_element& element) {
  const auto* m = envelope_in(element);
  return m != nullptr && m->head.effect_event != 0;
}

} // namespace

bool is_runtime_message(const envelope& m) {
  return m.is<ping>() || m.is<durable>() || m.is<effect_taken>() || m.is<write_failed>() || m.is<retry_write>();
}

bool is_runtime_message(const caf::mailbox_element& element) {
  const auto* m = envelope_in(element);
  return m != nullptr && is_runtime_message(*m);
}

stable_address::stable_address(caf::actor_config& config, std::uint32_t number, address_options options)
    : caf::monitorable_actor(config), number_(number), options_(std::move(options)),
      id_base_(std::uint64_t{number} << count_bits), ids_(ids_before_run(options_.run) + 1) {}

// -- senders --------------------------------------------------------------------------------------

void stable_address::enqueue(caf::mailbox_element_ptr element, caf::execution_unit* context) {
  // What the journal says counts from here on, whichever incarnation hears of it.
  if (const auto* m = element->sender ? nullptr : envelope_in(*element); m != nullptr) {
    if (m->is<durable>())
      written(m->as<durable>().upto);
    else if (m->is<write_failed>())
      return take_back_unwritten(std::move(element), context);
  }
  const auto forwarded = [&] { // under either lock
    if (!target_ || !has_room_for(*element))
      return false;
    enqueued_.fetch_add(1, std::memory_order_relaxed);
    hand_over(std::move(element), context);
    return true;
  };
  {
    // The shared lock covers the push: park_from_now() waits for pushes in flight, so that none lands in a mailbox
    // already emptied.
    const std::shared_lock guard(mutex_);
    if (forwarded())
      return;
  }
  std::unique_lock guard(mutex_);
  if (forwarded()) // an incarnation was bound meanwhile
    return;
  if (is_runtime_message(*element)) {
    keep_for_next(std::move(element));
    return;
  }
  const bool is_for_nobody = !target_ && !closed_ && away_ && !is_durable_effect(*element);
  if (is_for_nobody || target_ || closed_ || arrived_while_parked_ >= options_.parking_bound) {
    ++(is_for_nobody && !element->mid.is_request() ? counters_.dropped : counters_.refused);
    guard.unlock();
    refuse(std::move(element));
    return;
  }
  ++arrived_while_parked_;
  ++counters_.accepted;
  parked_.push_back(std::move(element));
}

void stable_address::hand_over(caf::mailbox_element_ptr element, caf::execution_unit* context) {
  if (is_durable_effect(*element)) [[unlikely]]
    unseen_.add(*element);
  target_->enqueue(std::move(element), context);
}

// Of what the runtime told an incarnation that is gone, or runs already and is not bound yet. What the journal said
// still counts, and so does what a receiver confirmed: the unbound incarnation lets effects out while it is born, and
// would wait for their confirmation for ever.
void stable_address::keep_for_next(caf::mailbox_element_ptr element) {
  const auto& m = *envelope_in(*element);
  if (m.is<durable>())
    durable_upto_ = std::max(durable_upto_, m.as<durable>().upto);
  else if (m.is<effect_taken>() && !closed_ && confirmations_.size() < max_confirmations)
    confirmations_.push_back(std::move(element));
}

void stable_address::refuse(caf::mailbox_element_ptr element) {
  if (element->mid.is_request())
    answer_with({element->sender, element->mid}, receiver_down(options_.name));
}

// -- the incarnation ------------------------------------------------------------------------------

bool stable_address::may_retry(std::uint64_t message_id, int& crashes_so_far) {
  const std::unique_lock guard(mutex_);
  crashes_so_far = ++crashes_of_[message_id];
  trouble_.store(true, std::memory_order_relaxed);
  if (crashes_so_far >= max_crashes)
    return false;
  ++counters_.requeued;
  return true;
}

void stable_address::given_up(std::uint64_t message_id) {
  const std::unique_lock guard(mutex_);
  crashes_of_.erase(message_id);
  ++counters_.dead_lettered;
}

void stable_address::put_back_all_the_same() {
  const std::unique_lock guard(mutex_);
  ++counters_.requeued;
}

void stable_address::resolved(std::uint64_t message_id) {
  if (!trouble_.load(std::memory_order_relaxed))
    return;
  const std::unique_lock guard(mutex_);
  crashes_of_.erase(message_id);
  trouble_.store(!crashes_of_.empty(), std::memory_order_relaxed);
}

void stable_address::count_unhandled(std::uint64_t address_counters::*why) {
  const std::unique_lock guard(mutex_);
  taken_.fetch_add(1, std::memory_order_relaxed);
  ++unhandled_;
  if (why != nullptr)
    ++(counters_.*why);
}

bool stable_address::has_seen(std::uint32_t source, effect_id id) const {
  const std::shared_lock guard(mutex_);
  const auto found = seen_.find(source);
  return found != seen_.end() && id <= found->second;
}

effect_id stable_address::mark_seen(std::uint32_t source, effect_id id) {
  unseen_.seen(source, id);
  const std::unique_lock guard(mutex_);
  auto& mark = seen_[source];
  return std::exchange(mark, std::max(mark, id));
}

void stable_address::submitted(unwritten_message message) {
  const std::unique_lock guard(mutex_);
  waiters_.submitted(std::move(message));
}

void stable_address::keep_from_return(std::uint64_t message_id) {
  const std::unique_lock guard(mutex_);
  waiters_.keep_from_return(message_id);
}

void stable_address::confirm(confirmation taken, caf::execution_unit* context) {
  {
    const std::unique_lock guard(mutex_);
    if (waiters_.newest() != 0) {
      waiters_.hold(std::move(taken));
      return;
    }
  }
  taken.to->enqueue(std::move(taken.mail), context);
}

void stable_address::written(std::int64_t upto) {
  disk_waiters::done done;
  {
    const std::unique_lock guard(mutex_);
    done = waiters_.written(upto);
    for (const auto each : done.messages)
      crashes_of_.erase(each);
    trouble_.store(!crashes_of_.empty(), std::memory_order_relaxed);
  }
  for (auto& each : done.confirmations)
    each.to->enqueue(std::move(each.mail), nullptr);
}

std::deque<unwritten_message> stable_address::take_unwritten(std::uint64_t incarnation, std::int64_t upto) {
  const std::unique_lock guard(mutex_);
  return unwritten_of(incarnation, upto);
}

std::deque<unwritten_message> stable_address::take_returned() {
  const std::unique_lock guard(mutex_);
  for (auto each = returned_.rbegin(); each != returned_.rend(); ++each) // seen again meanwhile, by a later one
    if (each->content.head.effect_event != 0)
      seen_[each->content.head.sender] = each->seen_before;
  return std::exchange(returned_, {});
}

std::deque<unwritten_message> stable_address::unwritten_of(std::uint64_t incarnation, std::int64_t upto) {
  auto result = waiters_.failed(incarnation, upto);
  for (auto each = result.rbegin(); each != result.rend(); ++each) {
    if (each->content.head.effect_event != 0)
      seen_[each->content.head.sender] = each->seen_before;
    if (const auto waiting = waiting_answers_.find(each->content.head.id); waiting != waiting_answers_.end()) {
      each->sender = std::move(waiting->second.from.who);
      each->mid = waiting->second.from.mid;
      waiting_answers_.erase(waiting);
    }
  }
  unhandled_ += static_cast<std::uint64_t>(
      std::ranges::count_if(result, [](const auto& each) { return each.content.type != nullptr; }));
  return result;
}

// A write can never commit. What led to it and to later ones is taken back at once; the incarnation that lives, or is
// on its way and may have the write in its state, hears of it first of all and ends.
void stable_address::take_back_unwritten(caf::mailbox_element_ptr failed, caf::execution_unit* context) {
  const std::unique_lock guard(mutex_);
  if (closed_)
    return;
  std::ranges::move(unwritten_of(envelope_in(*failed)->as<write_failed>().incarnation, 0),
                    std::back_inserter(returned_));
  if (!target_) {
    write_failed_ = std::move(failed);
    return;
  }
  enqueued_.fetch_add(1, std::memory_order_relaxed);
  target_->enqueue(std::move(failed), context);
}

void stable_address::answer_failure(const requester& r, caf::sec code, const std::string& what) const {
  answer_with(r, caf::make_error(code, options_.name + ' ' + what));
}

bool stable_address::expect_answer(std::uint64_t message_id, requester r) {
  {
    const std::unique_lock guard(mutex_);
    if (waiting_answers_.size() < max_waiting_answers) {
      waiting_answers_[message_id] = {std::move(r), incarnation_.load(std::memory_order_relaxed)};
      return true;
    }
    ++counters_.refused;
  }
  answer_with(r, receiver_down(options_.name));
  return false;
}

stable_address::requester stable_address::take_requester(std::uint64_t message_id) {
  const std::unique_lock guard(mutex_);
  const auto found = waiting_answers_.find(message_id);
  if (found == waiting_answers_.end())
    return {};
  auto result = std::move(found->second.from);
  waiting_answers_.erase(found);
  return result;
}

std::optional<caf::message_id> stable_address::awaited_mid(std::uint64_t message_id) const {
  const std::shared_lock guard(mutex_);
  const auto found = waiting_answers_.find(message_id);
  return found == waiting_answers_.end() ? std::nullopt : std::optional(found->second.from.mid);
}

void stable_address::give_up_answers(const std::vector<std::uint64_t>& keep, std::uint64_t incarnation) {
  std::vector<requester> abandoned;
  {
    const std::unique_lock guard(mutex_);
    for (auto each = waiting_answers_.begin(); each != waiting_answers_.end();) {
      if (each->second.incarnation > incarnation || std::find(keep.begin(), keep.end(), each->first) != keep.end()) {
        ++each;
        continue;
      }
      abandoned.push_back(std::move(each->second.from));
      each = waiting_answers_.erase(each);
    }
  }
  for (const auto& each : abandoned)
    answer_with(each, outcome_unknown(options_.name));
}

void stable_address::count_runtime_messages(std::size_t n) {
  const std::unique_lock guard(mutex_);
  taken_.fetch_add(n, std::memory_order_relaxed);
  runtime_messages_ += n;
}

void stable_address::count_wrong_answer() {
  const std::unique_lock guard(mutex_);
  ++counters_.not_accepted;
}

void stable_address::park_from_now(const caf::actor_control_block* dying, std::uint64_t incarnation) {
  caf::strong_actor_ptr old; // released after the lock: the last reference runs the actor's destructor
  std::unique_lock guard(mutex_);
  last_ended_ = std::max(last_ended_, incarnation);
  if (target_.get() == dying)
    old.swap(target_);
  // One that was left behind and came to its end after all: it holds its address, so the address must not go on holding
  // it.
  for (auto& each : stranded_)
    if (each.get() == dying)
      old.swap(each);
  std::erase(stranded_, nullptr);
  const bool gives_back = !target_;
  guard.unlock();
  if (gives_back)
    unseen_.forget();
}

void stable_address::give_back(std::vector<caf::mailbox_element_ptr> mail, std::size_t requeued) {
  {
    const std::unique_lock guard(mutex_);
    taken_.fetch_add(mail.size() - requeued, std::memory_order_relaxed);
    unhandled_ += mail.size() - requeued;
    if (options_.policy == on_crash::redeliver && !closed_) {
      if (target_) // the incarnation had been left behind, and has a successor
        forward_again(mail);
      else
        std::move(mail.rbegin(), mail.rend(), std::front_inserter(parked_));
      if (target_ || !away_)
        return;
      mail = sort_out(parked_);
    } else {
      (closed_ ? counters_.refused : counters_.lost) += mail.size();
    }
  }
  for (auto& each : mail)
    refuse(std::move(each));
}

std::vector<caf::mailbox_element_ptr> stable_address::sort_out(std::deque<caf::mailbox_element_ptr>& mail) {
  std::vector<caf::mailbox_element_ptr> refused;
  std::deque<caf::mailbox_element_ptr> kept;
  for (auto& each : mail) {
    if (is_durable_effect(*each)) {
      kept.push_back(std::move(each));
      continue;
    }
    ++(each->mid.is_request() ? counters_.refused : counters_.dropped);
    refused.push_back(std::move(each));
  }
  mail = std::move(kept);
  arrived_while_parked_ = mail.size();
  return refused;
}

void stable_address::forward_again(std::vector<caf::mailbox_element_ptr>& mail) {
  forwarded_again_ += mail.size();
  enqueued_.fetch_add(mail.size(), std::memory_order_relaxed);
  for (auto& each : mail)
    hand_over(std::move(each), nullptr);
}

void stable_address::note_crash(std::string reason) {
  const std::unique_lock guard(mutex_);
  ++counters_.crashes;
  last_crash_ = std::move(reason);
}

std::string stable_address::last_crash() const {
  const std::shared_lock guard(mutex_);
  return last_crash_;
}

// -- the guardian ---------------------------------------------------------------------------------

std::uint64_t stable_address::begin_incarnation() {
  const std::unique_lock guard(mutex_);
  away_ = false;
  return incarnation_.fetch_add(1, std::memory_order_acq_rel) + 1;
}

void stable_address::bind(caf::strong_actor_ptr incarnation, caf::execution_unit* context) {
  const std::unique_lock guard(mutex_);
  // Another worker may have run it already: mail for an incarnation that is gone waits for the next one.
  if (closed_ || last_ended_ == incarnation_.load(std::memory_order_relaxed))
    return;
  if (write_failed_) {
    enqueued_.fetch_add(1, std::memory_order_relaxed);
    incarnation->enqueue(std::move(write_failed_), context);
  }
  enqueued_.fetch_add(parked_.size(), std::memory_order_relaxed);
  forwarded_again_ += parked_.size();
  target_ = std::move(incarnation);
  for (; !parked_.empty(); parked_.pop_front())
    hand_over(std::move(parked_.front()), context);
  arrived_while_parked_ = 0;
  if (const auto upto = std::exchange(durable_upto_, 0); upto != 0) {
    enqueued_.fetch_add(1, std::memory_order_relaxed);
    target_->enqueue(make_internal_mail(durable{upto}), context);
  }
  enqueued_.fetch_add(confirmations_.size(), std::memory_order_relaxed);
  for (auto& each : std::exchange(confirmations_, {}))
    target_->enqueue(std::move(each), context);
}

std::size_t stable_address::abandon() {
  const std::unique_lock guard(mutex_);
  incarnation_.fetch_add(1, std::memory_order_acq_rel); // it is fenced from here on
  stranded_.push_back(std::move(target_));              // kept alive: the handler still runs in it
  target_.reset();
  const auto stranded = enqueued_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_relaxed);
  auto effects = unseen_.take(in_hand_.load(std::memory_order_relaxed));
  const auto count = effects.size();
  std::move(effects.rbegin(), effects.rend(), std::front_inserter(parked_));
  return stranded - std::min<std::uint64_t>(stranded, count);
}

bool stable_address::kill() {
  const std::shared_lock guard(mutex_);
  if (!target_)
    return false;
  target_->enqueue(kill_message(address()), nullptr);
  return true;
}

void stable_address::go_away() {
  std::vector<caf::mailbox_element_ptr> refused;
  {
    const std::unique_lock guard(mutex_);
    if (closed_ || std::exchange(away_, true) || target_)
      return;
    refused = sort_out(parked_);
  }
  for (auto& each : refused)
    refuse(std::move(each));
}

void stable_address::close() {
  caf::strong_actor_ptr old;
  std::deque<caf::mailbox_element_ptr> mail;
  std::map<std::uint64_t, waiting_answer> waiting;
  disk_waiters unwritten; // these two hold senders, who hold this address
  std::deque<unwritten_message> returned;
  {
    const std::unique_lock guard(mutex_);
    if (std::exchange(closed_, true))
      return;
    std::swap(unwritten, waiters_);
    returned.swap(returned_);
    old.swap(target_);
    mail.swap(parked_);
    waiting.swap(waiting_answers_);
    counters_.refused += mail.size();
  }
  for (auto& each : mail)
    refuse(std::move(each));
  for (const auto& [id, each] : waiting)
    answer_with(each.from, receiver_down(options_.name));
  cleanup(caf::exit_reason::user_shutdown, nullptr);
}

// -- anybody --------------------------------------------------------------------------------------

address_counters stable_address::counters() const {
  const std::shared_lock guard(mutex_);
  auto result = counters_;
  const auto taken = taken_.load(std::memory_order_relaxed);
  result.accepted += enqueued_.load(std::memory_order_relaxed) - forwarded_again_ - runtime_messages_;
  result.handled = taken - std::min(taken, unhandled_ + runtime_messages_);
  return result;
}

std::size_t stable_address::parked() const {
  const std::shared_lock guard(mutex_);
  return parked_.size();
}

std::size_t stable_address::waiting() const {
  const std::shared_lock guard(mutex_);
  const auto taken = taken_.load(std::memory_order_relaxed); // before the others: more may come meanwhile
  const auto enqueued = enqueued_.load(std::memory_order_relaxed);
  return parked_.size() + (enqueued - std::min(enqueued, taken));
}

caf::strong_actor_ptr make_stable_address(caf::actor_system& system, std::uint32_t number, address_options options) {
  caf::actor_config config;
  return caf::make_actor<stable_address, caf::strong_actor_ptr>(system.next_actor_id(), system.node(), &system, config,
                                                                number, std::move(options));
}

} // namespace godwit::runtime
