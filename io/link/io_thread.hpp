// A thread that runs the handlers of links: of one, or of many that were given the same (link_options::thread).
//
// A thousand links need a thousand sockets, not a thousand threads. Links that share a thread get their callbacks one
// at a time, and a callback that takes long holds up all of them. Whoever shares it may run handlers of his own on its
// context, a timer for instance.
//
// Errors: the constructor and start() throw what the system refuses (no descriptor, no thread). An exception out of a
// handler ends the process. Thread: start and stop by the owner; posting to the context from any.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <thread>
#include <utility>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

namespace godwit::io::link {

class io_thread {
public:
  static constexpr std::size_t buffer_bytes = 64 * 1024; // no datagram is longer

  io_thread();
  ~io_thread() { stop(); }
  io_thread(const io_thread&) = delete;
  io_thread& operator=(const io_thread&) = delete;

  [[nodiscard]] boost::asio::io_context& context() { return context_; }
  // What is received goes through here on its way to a callback: one for all links, since they take turns.
  [[nodiscard]] std::span<std::byte> buffer() { return buffer_; }
  void start();
  // Waits for the handler that is running; the others are not called any more. Twice is harmless. Whoever calls it
  // inside the thread would wait for itself: a broken invariant, which ends the process.
  void stop();
  // Runs WHAT as a handler of the running thread, and waits for it. Inside the thread: as stop().
  void run_inside(const std::function<void()>& what);

private:
  void check_outside() const;

  boost::asio::io_context context_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
  std::array<std::byte, buffer_bytes> buffer_{};
  std::thread thread_;
};

// For link_options::thread. Throws as start() does.
[[nodiscard]] std::shared_ptr<io_thread> start_io_thread();

// The thread of a link: one of its own, or one that it shares with others.
//
// Its own is started by the link when it is made and stopped when it ends. A shared one runs already and goes on; such
// a link is made anywhere, and destroyed inside the thread (see link.cpp), so that no handler of it runs meanwhile.
// Errors and thread: as io_thread.
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
