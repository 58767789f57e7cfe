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

} // namespace godwit::io::link
