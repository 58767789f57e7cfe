#include "programs/godwitd/accounts/login_delay.hpp"

#include <algorithm>

namespace godwit::accounts {
namespace {

constexpr int most_doublings = 5;

std::int64_t wait_ms(int failures) {
  return std::min(login_delay::first_ms << std::min(failures - 1, most_doublings), login_delay::longest_ms);
}

} // namespace

std::int64_t login_delay::due_of(const key& which, std::int64_t now_ms) const {
  const auto found = entries_.find(which);
  if (found == entries_.end() || now_ms - found->second.last_ms >= forgotten_after_ms)
    return now_ms;
  return std::max(now_ms, found->second.last_ms + wait_ms(found->second.failures));
}

std::int64_t login_delay::due_ms(const std::string& name, const std::string& from, std::int64_t now_ms) const {
  return std::max(due_of({from, name}, now_ms), due_of({from, {}}, now_ms));
}

void login_delay::count(const key& which, std::int64_t now_ms) {
  if (!entries_.contains(which) && entries_.size() >= max_entries)
    entries_.erase(std::ranges::min_element(entries_, {}, [](const auto& each) { return each.second.last_ms; }));
  auto& its = entries_[which];
  its.failures = now_ms - its.last_ms >= forgotten_after_ms ? 1 : its.failures + 1;
  its.last_ms = now_ms;
}

void login_delay::failed(const std::string& name, const std::string& from, std::int64_t now_ms) {
  count({from, name}, now_ms);
  count({from, {}}, now_ms);
}

void login_delay::succeeded(const std::string& name, const std::string& from) {
  entries_.erase({from, name});
  entries_.erase({from, {}});
}

} // namespace godwit::accounts
