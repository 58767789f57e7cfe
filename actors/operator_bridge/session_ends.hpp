// Who has to know when a session ends: the port, which closes what was opened with it. Thread: any.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace godwit::operator_bridge {

class session_ends {
public:
  using listener = std::function<void(const std::string& session)>;

  // Must be quick. None: nobody has to know any more.
  void listen(listener who) {
    const std::lock_guard guard(mutex_);
    who_ = std::move(who);
  }
  void notify(const std::string& session) {
    const std::lock_guard guard(mutex_);
    if (who_)
      who_(session);
  }

private:
  std::mutex mutex_; // over who_, also while it runs
  listener who_;
};

} // namespace godwit::operator_bridge
