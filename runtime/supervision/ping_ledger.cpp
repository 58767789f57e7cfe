#include "runtime/supervision/ping_ledger.hpp"

#include <utility>

namespace godwit::runtime {

namespace {

bool passed(std::int64_t since_ns, std::int64_t now_ns, milliseconds limit) {
  return now_ns - since_ns >= std::chrono::nanoseconds(limit).count();
}

} // namespace

void ping_ledger::watch(std::size_t child, std::int64_t now_ns) {
  entries_[child] = {};
  entries_[child].watched = true;
  entries_[child].sent_ns = now_ns;
}

ping_ledger::verdict ping_ledger::tick(std::int64_t now_ns) {
  verdict result;
  for (std::size_t child = 0; child < entries_.size(); ++child) {
    auto& each = entries_[child];
    if (!each.watched)
      continue;
    if (!each.waiting && passed(each.sent_ns, now_ns, policy_.period)) {
      each.waiting = true;
      each.key = ++last_key_;
      each.sent_ns = now_ns;
      result.to_ping.push_back(child);
    } else if (each.waiting && passed(each.sent_ns, now_ns, policy_.fatal)) {
      each = {};
      result.silent.push_back(child);
    } else if (each.waiting && !each.warned && passed(each.sent_ns, now_ns, policy_.warn)) {
      each.warned = true;
      result.late.push_back(child);
    }
  }
  return result;
}

ping_ledger::answer ping_ledger::answered(std::size_t child, std::uint64_t key) {
  auto& each = entries_[child];
  if (!each.watched || !each.waiting || each.key != key)
    return answer::stale;
  each.waiting = false;
  return std::exchange(each.warned, false) ? answer::late : answer::in_time;
}

} // namespace godwit::runtime
