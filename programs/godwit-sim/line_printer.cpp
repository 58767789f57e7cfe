#include "programs/godwit-sim/line_printer.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <utility>

#include <poll.h>
#include <unistd.h>

namespace godwit::sim {

line_printer::~line_printer() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void line_printer::push(std::string_view line) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= max_waiting) { // by one above it, when a line and the news of lost ones came together
      ++dropped_;
      ++untold_;
      return;
    }
    if (const auto lost = std::exchange(untold_, 0); lost != 0)
      waiting_.push_back("(" + std::to_string(lost) + " lines are missing here: they were not read fast enough)\n");
    waiting_.push_back(std::string(line) + "\n");
  }
  changed_.notify_all();
}

std::uint64_t line_printer::dropped() {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

void line_printer::run() {
  std::string line;
  while (next(line))
    if (!write(line))
      return;
}

bool line_printer::next(std::string& line) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
  if (waiting_.empty())
    return false;
  line = std::move(waiting_.front());
  waiting_.pop_front();
  return true;
}

bool line_printer::write(std::string_view line) {
  while (!line.empty()) {
    if (!wait_writable())
      return false;
    const auto written = ::write(descriptor_, line.data(), std::min<std::size_t>(line.size(), PIPE_BUF));
    if (written >= 0)
      line.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR && errno != EAGAIN)
      return false; // the reader has gone away, or the disk is full: nobody needs the rest
  }
  return true;
}

bool line_printer::wait_writable() {
  for (;;) {
    pollfd entry{descriptor_, POLLOUT, 0};
    const int ready = ::poll(&entry, 1, static_cast<int>(patience.count()));
    if (ready > 0)
      return true;
    const std::lock_guard lock(mutex_);
    if (is_over_ && ready == 0)
      return false;
  }
}

} // namespace godwit::sim
