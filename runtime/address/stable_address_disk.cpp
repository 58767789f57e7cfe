// What the journal says of this actor: which durable effects it has seen, which writes are on their way, and what comes
// back because one of them can never commit.
#include <algorithm>
#include <iterator>
#include <utility>

#include "runtime/address/stable_address.hpp"
#include "runtime/internal_messages.hpp"

namespace godwit::runtime {

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

} // namespace godwit::runtime
