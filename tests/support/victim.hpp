// A program that a test starts, listens to and kills: what it says on standard output is its acknowledgements.
//
//   victim running(program, {folder});
//   if (!running.started()) ...
//   running.wait_for_words(20s); // the first acknowledgement
//   running.listen(13ms);
//   EXPECT_TRUE(running.kill()) << "it ended by itself";
//   count(running.said());
//
// Thread: one owner.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

namespace godwit::tests {

class victim {
public:
  // Its standard error is that of the test.
  victim(const std::string& program, const std::vector<std::string>& arguments);
  victim(const victim&) = delete;
  victim& operator=(const victim&) = delete;
  ~victim(); // kills it when it still runs

  // And neither killed nor waited for.
  [[nodiscard]] bool started() const { return pid_ > 0; }

  // Until it has said something, its output has ended, or the time is over.
  void wait_for_words(std::chrono::microseconds at_most);
  // For so long, or until its output ends.
  void listen(std::chrono::microseconds time);

  // SIGKILL; then reads what still was in the pipe. False when it had ended by itself before.
  [[nodiscard]] bool kill();
  // Listens until it ends by itself. Its exit status; -1 when a signal ended it, or this class because the time is
  // over.
  [[nodiscard]] int wait_for_end(std::chrono::microseconds at_most);

  // All that it said so far.
  [[nodiscard]] const std::string& said() const { return said_; }

private:
  enum class stop_at { end_of_time, first_words };

  void read_until(std::chrono::steady_clock::time_point end, stop_at where);
  int reap();

  pid_t pid_ = -1;
  int output_ = -1;
  bool output_ended_ = false;
  std::string said_;
};

} // namespace godwit::tests
