// Long output in a pager, as git does it: on a terminal alone, `$PAGER` or less, which ends by itself when all fits on
// the screen.
//
//   pager shown(STDOUT_FILENO);   // from here on the descriptor leads to the pager
//   ...                           // a person who leaves it makes writing fail with EPIPE
//                                 // the destructor says the end, and waits until the person has left it
//
// `PAGER` empty or `cat`: none. A pager that can not be started: none, and the text goes where it went. While it runs
// Ctrl-C is the pager's. Thread: the one thread of the program.
#pragma once

#include <sys/types.h>

namespace godwit::trace_tool {

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
