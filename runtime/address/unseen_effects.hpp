// Durable effects that were handed to an incarnation and are not handled yet, as copies.
//
// A handler that hangs can not be stopped, and keeps the mailbox of its incarnation for itself. What was told there is
// old by the time a successor runs, and who asked is answered; a durable effect is neither: its sender counts on it,
// and later ones of the same sender would make it look like a repetition. So the successor is handed the copies first.
//
// Each sender's effects come in the order of their ids. Bounded by what senders may have unconfirmed
// (max_unreleased_effects each). For runtime/ alone. Thread: any.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <iterator>
#include <map>
#include <mutex>
#include <utility>

#include <caf/all.hpp>

#include "runtime/caf_mail.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

class unseen_effects {
public:
  void add(const caf::mailbox_element& handed) {
    const auto& content = *envelope_in(handed);
    const std::lock_guard guard(mutex_);
    of_sender_[content.head.sender].push_back({++arrived_, handed.sender, handed.mid, content});
  }

  // Those of SOURCE up to ID were handled.
  void seen(std::uint32_t source, effect_id id) {
    std::deque<copy> gone; // released after the lock
    const std::lock_guard guard(mutex_);
    const auto found = of_sender_.find(source);
    if (found == of_sender_.end())
      return;
    auto& copies = found->second;
    for (; !copies.empty() && id_of(copies.front()) <= id; copies.pop_front())
      gone.push_back(std::move(copies.front()));
  }

  // The incarnation gives back its mailbox itself.
  void forget() { (void)take_all(); }

  // Oldest first, for the front of what the next incarnation is handed; but the one with the id IN_HAND: its handler
  // runs, and may have acted.
  [[nodiscard]] std::deque<caf::mailbox_element_ptr> take(std::uint64_t in_hand) {
    std::deque<copy> all;
    for (auto& [sender, copies] : take_all())
      std::ranges::move(copies, std::back_inserter(all));
    std::ranges::sort(all, {}, &copy::arrived);
    std::deque<caf::mailbox_element_ptr> result;
    for (auto& each : all)
      if (each.content.head.id != in_hand)
        result.push_back(make_mail(std::move(each.sender), each.mid, std::move(each.content)));
    return result;
  }

private:
  struct copy {
    std::uint64_t arrived = 0; // as the address counts
    caf::strong_actor_ptr sender;
    caf::message_id mid;
    envelope content;
  };
  using copies_of_senders = std::map<std::uint32_t, std::deque<copy>>;

  static effect_id id_of(const copy& each) { return {each.content.head.effect_event, each.content.head.effect_n}; }

  copies_of_senders take_all() {
    const std::lock_guard guard(mutex_);
    return std::exchange(of_sender_, {});
  }

  std::mutex mutex_;
  std::uint64_t arrived_ = 0;
  copies_of_senders of_sender_;
};

} // namespace godwit::runtime
