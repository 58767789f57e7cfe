#include "programs/godwitd/service/crash_loop_guard.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string_view>

namespace godwit::daemon {

namespace {

constexpr std::string_view fast_word = "fast";
constexpr std::size_t max_kept = 1'000; // lines; more is judged as these

} // namespace

boot_moment this_moment() {
  boot_moment result;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> result.boot;
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  result.at_ms = std::int64_t{now.tv_sec} * 1'000 + now.tv_nsec / 1'000'000;
  return result;
}

start_verdict crash_loop_guard::begin(const boot_moment& now, bool in_flight) {
  boot_ = now.boot;
  runs_ = read(now);
  auto verdict = judge(now, in_flight);
  if (!verdict.may_start)
    return verdict;
  if (runs_.size() >= max_kept)
    runs_.erase(runs_.begin());
  runs_.push_back({now.at_ms});
  if (limits_.max_abnormal_ends == 0 || write())
    return verdict;
  verdict.may_end_fast = false; // the next run would not know of it
  verdict.sentence = "crashes are not counted, " + file_ + " can not be written: " + std::strerror(errno);
  return verdict;
}

start_verdict crash_loop_guard::judge(const boot_moment& now, bool in_flight) const {
  start_verdict result;
  const auto since_ms = now.at_ms - std::chrono::milliseconds(fast_end_counts).count();
  result.may_end_fast = std::ranges::none_of(
      runs_, [&](const run& each) { return each.ended_fast_ms != 0 && each.last_ms() >= since_ms; });
  const auto ended = ended_within(now);
  if (limits_.max_abnormal_ends == 0)
    return result;
  if (in_flight && ended >= max_whole_in_flight) {
    result.is_reduced = true;
    result.sentence = count_of(ended) +
                      ", and a vehicle flies: until it has landed only vehicle_link, failsafe, executor "
                      "and ground_port run";
  } else if (!in_flight && ended >= limits_.max_abnormal_ends) {
    result.may_start = false;
    result.sentence = count_of(ended) +
                      " (a crash, a kill, or exit code 70 or 71), and does not begin once more by itself.\nLook "
                      "into the log and the trace; then remove " +
                      file_ + " and start it again. It also starts when the time is over";
  }
  return result;
}

std::size_t crash_loop_guard::ended_within(const boot_moment& now) const {
  const auto since_ms = now.at_ms - std::chrono::milliseconds(limits_.within).count();
  return static_cast<std::size_t>(
      std::ranges::count_if(runs_, [&](const run& each) { return each.last_ms() >= since_ms; }));
}

std::string crash_loop_guard::count_of(std::size_t ended) const {
  return "godwitd has ended abnormally " + std::to_string(ended) + " times within " +
         std::to_string(limits_.within.count()) + " s";
}

void crash_loop_guard::end_in_order() {
  if (limits_.max_abnormal_ends == 0 || runs_.empty())
    return;
  runs_.pop_back();
  (void)write(); // then this run counts as a crash, and a later one says that the file can not be written
}

void crash_loop_guard::end_fast(const boot_moment& now) {
  if (runs_.empty())
    return;
  runs_.back().ended_fast_ms = now.at_ms;
  (void)write();
}

// What is no line of ours counts for nothing: the file is a help, and not a state.
std::vector<crash_loop_guard::run> crash_loop_guard::read(const boot_moment& now) const {
  std::vector<run> result;
  std::ifstream file(file_);
  std::string line;
  if (!std::getline(file, line) || line != now.boot)
    return result;
  const auto longest = std::max<std::chrono::milliseconds>(limits_.within, fast_end_counts);
  while (result.size() < max_kept && std::getline(file, line)) {
    std::istringstream words(line);
    run each;
    std::string how;
    if (!(words >> each.began_ms))
      break;
    if ((words >> how) && how == fast_word && !(words >> each.ended_fast_ms))
      each.ended_fast_ms = each.began_ms;
    if (each.last_ms() >= now.at_ms - longest.count() && each.last_ms() <= now.at_ms)
      result.push_back(each);
  }
  return result;
}

bool crash_loop_guard::write() const {
  const auto fresh = file_ + ".new";
  {
    std::ofstream file(fresh, std::ios::trunc);
    file << boot_ << '\n';
    for (const auto& each : runs_)
      file << each.began_ms
           << (each.ended_fast_ms != 0 ? " " + std::string(fast_word) + " " + std::to_string(each.ended_fast_ms) : "")
           << '\n';
    if (!file.flush())
      return false;
  }
  return std::rename(fresh.c_str(), file_.c_str()) == 0;
}

} // namespace godwit::daemon
