// What came back from the service and waits for the actor: between the connection's thread and the actor's.
//
// It stands outside of the mailbox and outlives the incarnations of the actor, so that an answer is one short wake-up
// and a body of megabytes is moved, not copied. There is at most one answer for each call that was made, and
// one notice before it, so that the bound on calls bounds it too. Thread: any.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace godwit::mission_client {

// How a call ended.
enum class ending {
  answered,      // there is a status
  not_reached,   // the network, or a service that is starting: later the same call may go well
  misconfigured, // TLS, a redirect, the token file: a person has to act first
  bad_answer,    // what came is no answer of this contract: another content type, longer than there may be
  no_picture,    // nothing was sent: the picture is not on the disk any more
  page_begun,    // no end yet: a page comes, and the body here is the place of the next one
};

struct service_answer {
  std::uint64_t number = 0; // of the call
  ending how = ending::answered;
  unsigned status = 0;
  std::string body{};
  std::optional<std::int64_t> retry_after_ns{}; // as the service asks; at least 0
  std::string error{};                          // sentence for people, without secrets; empty when answered
};

class response_queue {
public:
  // True: the actor sleeps and has to be woken.
  [[nodiscard]] bool put(service_answer answer) {
    const std::lock_guard guard(mutex_);
    waiting_.push_back(std::move(answer));
    return !std::exchange(awake_, true);
  }

  // The oldest. Nothing: all are taken, and the next put() says to wake the actor again.
  [[nodiscard]] std::optional<service_answer> take() {
    const std::lock_guard guard(mutex_);
    if (waiting_.empty()) {
      awake_ = false;
      return std::nullopt;
    }
    auto result = std::move(waiting_.front());
    waiting_.pop_front();
    return result;
  }

private:
  mutable std::mutex mutex_;
  std::deque<service_answer> waiting_;
  bool awake_ = false;
};

} // namespace godwit::mission_client
