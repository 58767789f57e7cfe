// Prints lines without holding up whoever has them: a reader that is slow, or has stopped reading, must not stop the
// vehicles.
//
// Lines wait in a bounded queue for a thread of their own; what does not fit is dropped, and how many it were is said
// in their place. The end waits no longer than `patience` for a reader that takes nothing. Thread: push from any.
// Source: pipe(7): a write of up to PIPE_BUF bytes does not block after poll(2) has said so.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

namespace godwit::sim {

class line_printer {
public:
  static constexpr std::size_t max_waiting = 10'000; // a second of events of a thousand busy vehicles
  static constexpr std::chrono::milliseconds patience{500};

  // DESCRIPTOR stays open until the end.
  explicit line_printer(int descriptor) : descriptor_(descriptor), thread_([this] { run(); }) {}
  ~line_printer();
  line_printer(const line_printer&) = delete;
  line_printer& operator=(const line_printer&) = delete;

  // LINE without its end.
  void push(std::string_view line);
  [[nodiscard]] std::uint64_t dropped();

private:
  void run();
  // False: there are none, and there will be none.
  [[nodiscard]] bool next(std::string& line);
  // False: nobody takes any more.
  [[nodiscard]] bool write(std::string_view line);
  [[nodiscard]] bool wait_writable();

  int descriptor_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> waiting_;
  std::uint64_t dropped_ = 0;
  std::uint64_t untold_ = 0; // dropped, and not said yet
  bool is_over_ = false;
  std::thread thread_; // last: it uses the others
};

} // namespace godwit::sim
