// What waits at a stable address until a write of its actor is on the disk: the confirmations of durable effects that
// led to writes, and the messages that are put back when a write can never commit.
//
// An effect is confirmed when all that its receiver had submitted by then is on the disk: a sender that releases it
// earlier could lose it with the process. For runtime/ alone. Thread: one at a time, the stable address's lock.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include <caf/all.hpp>

#include "runtime/caf_mail.hpp"
#include "runtime/journal/records.hpp"

namespace godwit::runtime {

// To the sender of an effect: taken.
struct confirmation {
  caf::strong_actor_ptr to;
  caf::mailbox_element_ptr mail;
};

// A message whose write was submitted.
struct unwritten_message {
  std::int64_t event = 0;        // the newest of its write
  std::uint64_t incarnation = 0; // that submitted it
  caf::strong_actor_ptr sender;
  caf::message_id mid; // of a request; default: a tell
  envelope content;
  effect_id seen_before; // of the sender's effects, before this one; for a durable effect
};

class disk_waiters {
public:
  // The newest event that was submitted and is not on the disk; 0: none.
  [[nodiscard]] std::int64_t newest() const { return newest_; }

  void submitted(unwritten_message message) {
    newest_ = message.event;
    messages_.push_back(std::move(message));
  }

  // After everything that was submitted; there is something.
  void hold(confirmation taken) { confirmations_.emplace_back(newest_, std::move(taken)); }

  struct done {
    std::vector<confirmation> confirmations; // may go out now
    std::vector<std::uint64_t> messages;     // ids of those that led to what is written
  };

  // All events up to UPTO are on the disk.
  [[nodiscard]] done written(std::int64_t upto) {
    done result;
    for (; !messages_.empty() && messages_.front().event <= upto; messages_.pop_front())
      result.messages.push_back(messages_.front().content.head.id);
    if (newest_ <= upto)
      newest_ = 0;
    for (; !confirmations_.empty() && confirmations_.front().first <= upto; confirmations_.pop_front())
      result.confirmations.push_back(std::move(confirmations_.front().second));
    return result;
  }

  // Nothing of INCARNATION and of earlier ones above UPTO will ever be written. Returns the messages, oldest first;
  // none: that is known already.
  [[nodiscard]] std::deque<unwritten_message> failed(std::uint64_t incarnation, std::int64_t upto) {
    std::deque<unwritten_message> result;
    std::deque<unwritten_message> rest;
    for (auto& each : messages_)
      (each.event > upto && each.incarnation <= incarnation ? result : rest).push_back(std::move(each));
    messages_ = std::move(rest);
    if (result.empty())
      return result;
    newest_ = messages_.empty() ? 0 : messages_.back().event;
    if (messages_.empty())
      std::erase_if(confirmations_, [&](const auto& each) { return each.first > upto; });
    return result;
  }

  // What MESSAGE did can not be taken back: it does not come again, whatever becomes of its write.
  void keep_from_return(std::uint64_t message) {
    for (auto& each : messages_)
      if (each.content.type != nullptr && each.content.head.id == message) {
        each.content = {};
        each.sender = nullptr;
      }
  }

private:
  std::int64_t newest_ = 0;
  std::deque<unwritten_message> messages_;
  std::deque<std::pair<std::int64_t, confirmation>> confirmations_;
};

} // namespace godwit::runtime
