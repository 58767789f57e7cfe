// The one thread of a link, and the Asio context which it runs.
//
// Errors: the constructor and start() throw what the system refuses (no descriptor, no thread). An exception out of a
// handler ends the process. Thread: start and stop by the owner; posting to the context from any.
#pragma once

#include <thread>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>

namespace godwit::io::link {

class io_thread {
public:
  io_thread();
  ~io_thread() { stop(); }
  io_thread(const io_thread&) = delete;
  io_thread& operator=(const io_thread&) = delete;

  [[nodiscard]] boost::asio::io_context& context() { return context_; }
  void start();
  // Waits for the handler that is running; the others are not called any more. Twice is harmless. Whoever calls it
  // inside the thread would wait for itself: a broken invariant, which ends the process.
  void stop();

private:
  boost::asio::io_context context_;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> work_;
  std::thread thread_;
};

} // namespace godwit::io::link
