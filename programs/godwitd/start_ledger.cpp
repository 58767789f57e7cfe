#include "programs/godwitd/start_ledger.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>

namespace godwit::daemon {

boot_moment this_moment() {
  boot_moment result;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> result.boot;
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  result.at_ms = std::int64_t{now.tv_sec} * 1'000 + now.tv_nsec / 1'000'000;
  return result;
}

start_verdict start_ledger::begin(const boot_moment& now) {
  if (limits_.max_abnormal_ends == 0)
    return {};
  boot_ = now.boot;
  starts_ms_ = read(now);
  if (starts_ms_.size() >= limits_.max_abnormal_ends)
    return {false, "godwitd has ended abnormally " + std::to_string(starts_ms_.size()) + " times within " +
                       std::to_string(limits_.within.count()) +
                       " s (a crash, a kill, or exit code 70 or 71), and does not begin once more by itself.\nLook "
                       "into the log and the trace; then remove " +
                       file_ + " and start it again. It also starts when the time is over"};
  starts_ms_.push_back(now.at_ms);
  if (!write())
    return {true, "crashes are not counted, " + file_ + " can not be written: " + std::strerror(errno)};
  return {};
}

void start_ledger::end_in_order() {
  if (starts_ms_.empty())
    return;
  starts_ms_.pop_back();
  (void)write(); // then this run counts as a crash, and a later one says that the file can not be written
}

// What is no line of ours counts for nothing: the file is a help, and not a state.
std::vector<std::int64_t> start_ledger::read(const boot_moment& now) const {
  std::vector<std::int64_t> result;
  std::ifstream file(file_);
  std::string boot;
  if (!(file >> boot) || boot != now.boot)
    return result;
  const auto since_ms = now.at_ms - std::chrono::milliseconds(limits_.within).count();
  for (std::int64_t at_ms = 0; result.size() < limits_.max_abnormal_ends && file >> at_ms;)
    if (at_ms >= since_ms && at_ms <= now.at_ms)
      result.push_back(at_ms);
  return result;
}

bool start_ledger::write() const {
  const auto fresh = file_ + ".new";
  {
    std::ofstream file(fresh, std::ios::trunc);
    file << boot_ << '\n';
    for (const auto at_ms : starts_ms_)
      file << at_ms << '\n';
    if (!file.flush())
      return false;
  }
  return std::rename(fresh.c_str(), file_.c_str()) == 0;
}

} // namespace godwit::daemon
