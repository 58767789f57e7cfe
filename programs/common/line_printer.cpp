#include "programs/common/line_printer.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace godwit::programs {

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
      waiting_.push_back({tell_loss_(lost) + "\n", lost});
    waiting_.push_back({std::string(line) + "\n", 0});
  }
  changed_.notify_all();
}

std::string line_printer::plain_loss(std::uint64_t lost) {
  return "(" + std::to_string(lost) + " lines are missing here: they were not read fast enough)";
}

bool line_printer::put_file(int opened) {
  const std::lock_guard lock(writing_);
  is_torn_ = false;
  return ::dup3(opened, descriptor_, O_CLOEXEC) >= 0;
}

std::uint64_t line_printer::dropped() {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

void line_printer::run() {
  for (entry taken; next(taken);) {
    const std::lock_guard lock(writing_);
    const auto how = write(taken.line);
    if (how == written::nobody_takes)
      return;
    if (how == written::refused)
      note_loss(taken);
  }
}

bool line_printer::next(entry& taken) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return is_over_ || !waiting_.empty(); });
  if (waiting_.empty())
    return false;
  taken = std::move(waiting_.front());
  waiting_.pop_front();
  return true;
}

// The reader has gone away, or the disk is full: nobody waits, and the next line is tried anew.
void line_printer::note_loss(const entry& taken) {
  const std::lock_guard lock(mutex_);
  untold_ += taken.lost == 0 ? 1 : taken.lost;
  dropped_ += taken.lost == 0 ? 1 : 0;
}

line_printer::written line_printer::write(std::string_view line) {
  const auto whole = (is_torn_ ? "\n" : "") + std::string(line);
  for (std::string_view left = whole; !left.empty();) {
    if (!wait_writable())
      return written::nobody_takes;
    const auto size = ::write(descriptor_, left.data(), std::min<std::size_t>(left.size(), PIPE_BUF));
    if (size < 0 && errno != EINTR && errno != EAGAIN)
      return written::refused;
    if (size > 0) {
      left.remove_prefix(static_cast<std::size_t>(size));
      is_torn_ = !left.empty();
    }
  }
  return written::whole;
}

bool line_printer::wait_writable() {
  for (;;) {
    pollfd watched{descriptor_, POLLOUT, 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(patience.count()));
    if (ready > 0)
      return true;
    const std::lock_guard lock(mutex_);
    if (is_over_ && ready == 0)
      return false;
  }
}

} // namespace godwit::programs
