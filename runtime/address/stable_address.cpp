// Forwarding, parking, and what the guardian and the incarnation do. The disk: stable_address_disk.cpp; requests that
// wait for their answer: stable_address_answers.cpp.
#include "runtime/address/stable_address.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "runtime/internal_messages.hpp"

namespace godwit::runtime {

namespace {

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
  const bool is_over_bound = arrived_while_parked_ >= options_.parking_bound && !is_own(*element);
  if (is_for_nobody || target_ || closed_ || is_over_bound) {
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
// would wait for their confirmation for ever. Its own retry of a write that the journal refused may be due as early.
void stable_address::keep_for_next(caf::mailbox_element_ptr element) {
  const auto& m = *envelope_in(*element);
  if (m.is<durable>())
    durable_upto_ = std::max(durable_upto_, m.as<durable>().upto);
  else if (m.is<effect_taken>() && !closed_ && confirmations_.size() < max_confirmations)
    confirmations_.push_back(std::move(element));
  else if (m.is<retry_write>() && !closed_)
    retry_write_ = std::move(element);
}

void stable_address::refuse(caf::mailbox_element_ptr element) {
  if (element->mid.is_request())
    requester{element->sender, element->mid}.fail(is_down());
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
  if (retry_write_) {
    enqueued_.fetch_add(1, std::memory_order_relaxed);
    target_->enqueue(std::exchange(retry_write_, nullptr), context);
  }
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
  disk_waiters unwritten; // these three hold senders, who hold this address
  std::deque<unwritten_message> returned;
  caf::mailbox_element_ptr retry;
  {
    const std::unique_lock guard(mutex_);
    if (std::exchange(closed_, true))
      return;
    std::swap(unwritten, waiters_);
    returned.swap(returned_);
    retry.swap(retry_write_);
    old.swap(target_);
    mail.swap(parked_);
    waiting.swap(waiting_answers_);
    counters_.refused += mail.size();
  }
  for (auto& each : mail)
    refuse(std::move(each));
  for (const auto& [id, each] : waiting)
    each.from.fail(is_down());
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
