// Prints lines without holding up whoever has them: a reader that is slow, or has stopped reading, must not stop the
// vehicles.
//
// Lines wait in a bounded queue for a thread of their own; what does not fit is dropped, and how many it were is said
// in their place. So it is with what can not be written, as on a full disk: the next line is tried all the same. The
// end waits no longer than `patience` for a reader that takes nothing. Thread: push and put_file from any. Source:
// pipe(7): a write of up to PIPE_BUF bytes does not block after poll(2) has said so.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace godwit::programs {

class line_printer {
public:
  static constexpr std::size_t max_waiting = 10'000; // a second of events of a thousand busy vehicles
  static constexpr std::chrono::milliseconds patience{500};

  // The line that stands for LOST ones, without its end.
  using loss_text = std::function<std::string(std::uint64_t lost)>;

  // DESCRIPTOR stays open until the end.
  explicit line_printer(int descriptor, loss_text tell_loss = plain_loss)
      : descriptor_(descriptor), tell_loss_(std::move(tell_loss)), thread_([this] { run(); }) {}
  ~line_printer();
  line_printer(const line_printer&) = delete;
  line_printer& operator=(const line_printer&) = delete;

  // LINE without its end.
  void push(std::string_view line);
  [[nodiscard]] std::uint64_t dropped();
  // What comes from now on goes to the file OPENED, under the descriptor's old number; no line is torn between the two.
  // For files only, which hold nobody up. False: the system refuses (errno).
  [[nodiscard]] bool put_file(int opened);

  [[nodiscard]] static std::string plain_loss(std::uint64_t lost);

private:
  struct entry {
    std::string line;
    std::uint64_t lost = 0; // it is the news of so many
  };
  enum class written { whole, refused, nobody_takes };

  void run();
  // False: there are none, and there will be none.
  [[nodiscard]] bool next(entry& taken);
  [[nodiscard]] written write(std::string_view line);
  [[nodiscard]] bool wait_writable();
  void note_loss(const entry& taken);

  const int descriptor_;
  const loss_text tell_loss_;
  std::mutex writing_;   // held over a whole line
  bool is_torn_ = false; // of the thread: the last line has no end
  std::mutex mutex_;     // over what follows
  std::condition_variable changed_;
  std::deque<entry> waiting_;
  std::uint64_t dropped_ = 0;
  std::uint64_t untold_ = 0; // dropped, and not said yet
  bool is_over_ = false;
  std::thread thread_; // last: it uses the others
};

} // namespace godwit::programs
