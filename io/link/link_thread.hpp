// The thread of a link: one of its own, or one that it shares with others.
//
// Its own is started by the link when it is made and stopped when it ends. A shared one runs already and goes on; such
// a link is made anywhere, and destroyed inside the thread (see link.cpp), so that no handler of it runs meanwhile.
// Errors and thread: as io_thread.
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "io/link/io_thread.hpp"

namespace godwit::io::link {

class link_thread {
public:
  // SHARED may be null: then it is a thread of its own.
  explicit link_thread(std::shared_ptr<io_thread> shared)
      : is_own_(shared == nullptr), thread_(is_own_ ? std::make_shared<io_thread>() : std::move(shared)) {}

  [[nodiscard]] boost::asio::io_context& context() const { return thread_->context(); }
  [[nodiscard]] std::span<std::byte> buffer() const { return thread_->buffer(); }
  void start() const {
    if (is_own_)
      thread_->start();
  }
  void stop() const {
    if (is_own_)
      thread_->stop();
  }

private:
  bool is_own_;
  std::shared_ptr<io_thread> thread_;
};

} // namespace godwit::io::link
