// Debian's mosquitto on a free port of 127.0.0.1, and its mosquitto_sub, which hears what it is told. For tests;
// processes and files are gone with the objects. Thread: one; what was heard is collected by a thread of its own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace godwit::tests {

class broker {
public:
  // EXTRA: lines of its configuration beside the listener, such as "allow_anonymous true".
  explicit broker(std::string extra = "allow_anonymous true");
  broker(const broker&) = delete;
  broker& operator=(const broker&) = delete;
  ~broker();

  // Nobody has installed it: then a test is skipped.
  [[nodiscard]] static bool is_installed();
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // Its connections are gone. What it has acknowledged it keeps, which it would not when it is killed with SIGKILL.
  void stop();
  void start();

private:
  std::string extra_;
  std::filesystem::path folder_;
  std::uint16_t port_;
  pid_t process_ = -1;
};

struct heard_message {
  std::string topic;
  std::string text;
  bool is_retained = false;
};

// Hears all topics with QoS 1, and connects again by itself; the broker keeps what comes meanwhile.
class watcher {
public:
  explicit watcher(std::uint16_t port, const std::string& name = "watcher");
  watcher(const watcher&) = delete;
  watcher& operator=(const watcher&) = delete;
  ~watcher();

  [[nodiscard]] std::vector<heard_message> heard();
  // False: PATIENCE was over before all that was heard satisfied it.
  bool wait_for(const std::function<bool(const std::vector<heard_message>&)>& satisfied,
                std::chrono::seconds patience = std::chrono::seconds(60));

private:
  void collect();

  pid_t process_ = -1;
  int output_ = -1;
  std::thread reader_;
  std::mutex mutex_; // over the rest
  std::condition_variable more_;
  std::vector<heard_message> heard_;
};

} // namespace godwit::tests
