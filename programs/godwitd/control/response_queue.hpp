// Answers on their way from the request_handler to the thread of the control socket.
//
// It outlives the incarnations of the request_handler. There is at most one answer for each ticket, and so as many as
// there are clients. Thread: any; the descriptor is watched and emptied by the socket's thread.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "io/link/descriptor.hpp"

namespace godwit::control {

struct answer {
  std::uint64_t ticket = 0;
  std::string line; // JSON, without the end of the line
};

class response_queue {
public:
  // READABLE: an eventfd.
  explicit response_queue(io::link::descriptor readable) : readable_(std::move(readable)) {}

  void put(answer each) {
    {
      const std::lock_guard guard(mutex_);
      waiting_.push_back(std::move(each));
    }
    const std::uint64_t one = 1;
    (void)!::write(readable_.number(), &one, sizeof one);
  }

  [[nodiscard]] std::vector<answer> take() {
    std::uint64_t count = 0;
    (void)!::read(readable_.number(), &count, sizeof count);
    const std::lock_guard guard(mutex_);
    return std::exchange(waiting_, {});
  }

  [[nodiscard]] int descriptor() const { return readable_.number(); }

private:
  io::link::descriptor readable_;
  std::mutex mutex_;
  std::vector<answer> waiting_;
};

} // namespace godwit::control
