// Text on its way to a descriptor, gathered in a large buffer: a log has ten thousands of lines, and a write costs more
// than a line.
//
// A reader that has gone away (`| head`) is no error: nothing more is written, and whoever prints is told to stop.
// Other refusals of the system, such as a full disk, are kept for the end. SIGPIPE must be ignored by the process.
// Errors: failure(). Blocks on the descriptor. Thread: one at a time.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace godwit::trace_tool {

class output {
public:
  static constexpr std::size_t buffer_bytes = std::size_t{64} << 10;

  // DESCRIPTOR stays open, and must outlive the output.
  explicit output(int descriptor) : descriptor_(descriptor) { text_.reserve(2 * buffer_bytes); }
  output(const output&) = delete;
  output& operator=(const output&) = delete;
  ~output() { flush(); }

  // Lines are appended here; then comes a call of `flush_if_full` or `flush`.
  [[nodiscard]] std::string& text() { return text_; }
  // Hands the text on if there is much of it. False: nobody takes any more.
  bool flush_if_full() { return text_.size() < buffer_bytes ? is_taken() : flush(); }
  bool flush();

  [[nodiscard]] bool is_taken() const { return error_ == 0; }
  // What the system said when it refused; empty if all is well, or if the reader has gone away.
  [[nodiscard]] std::string failure() const;

private:
  int descriptor_;
  int error_ = 0;
  std::string text_;
};

// Where a command prints: what was asked for, and sentences about it for people.
struct console {
  output& out;
  output& words;
  bool is_terminal = false; // `out` is one, on which a table may be drawn over the last

  // One sentence, at once, after the name of the program.
  void say(std::string_view sentence);
};

// Long output in a pager, as git does it: on a terminal alone, `$PAGER` or less, which ends by itself when all fits on
// the screen.
//
//   pager shown(STDOUT_FILENO);   // from here on the descriptor leads to the pager
//   ...                           // a person who leaves it makes writing fail with EPIPE
//                                 // the destructor says the end, and waits until the person has left it
//
// `PAGER` empty or `cat`: none. A pager that can not be started: none, and the text goes where it went. While it runs
// Ctrl-C is the pager's. Thread: the one thread of the program.
class pager {
public:
  // DESCRIPTOR: of a terminal.
  explicit pager(int descriptor);
  pager(const pager&) = delete;
  pager& operator=(const pager&) = delete;
  ~pager();

private:
  int descriptor_;
  pid_t process_ = -1; // -1: none
};

} // namespace godwit::trace_tool
