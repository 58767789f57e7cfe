// Programs that a test starts, on what they say and how they end. Thread: one owner.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/victim.hpp"

namespace godwit::test {

inline constexpr std::chrono::seconds process_patience{60};

// A program whose standard error is heard together with its standard output.
class program {
public:
  program(const std::string& path, const std::vector<std::string>& arguments)
      : running_("/bin/sh", words(path, arguments)) {}

  // False: it has not said it in time, or has ended without.
  [[nodiscard]] bool waits_for(const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + process_patience;
    while (said().find(text) == std::string::npos) {
      const auto left = end - std::chrono::steady_clock::now();
      const auto before = said().size();
      if (left <= std::chrono::nanoseconds::zero())
        return false;
      running_.wait_for_words(std::chrono::ceil<std::chrono::microseconds>(left));
      if (said().size() == before)
        return false;
    }
    return true;
  }
  // Its exit status; -1: a signal.
  [[nodiscard]] int ends() { return running_.wait_for_end(process_patience); }
  // 0: it was not started.
  [[nodiscard]] int id() { return waits_for("\n") && said().starts_with("id ") ? std::atoi(said().c_str() + 3) : 0; }
  void signal(int number) {
    if (const int whom = id(); whom > 0)
      ::kill(whom, number);
  }
  [[nodiscard]] const std::string& said() const { return running_.said(); }

private:
  static std::vector<std::string> words(const std::string& path, const std::vector<std::string>& arguments) {
    // GODWIT_ variables of the test are none of godwitd's.
    std::vector<std::string> result{"-c", R"(unset TEST_FULL TEST_SEED; echo "id $$"; exec "$0" "$@" 2>&1)", path};
    result.insert(result.end(), arguments.begin(), arguments.end());
    return result;
  }

  tests::victim running_;
};

} // namespace godwit::test
