#include "runtime/supervision/child_list.hpp"

#include <algorithm>
#include <utility>

namespace godwit::runtime {

child_list::child_list(std::vector<child_spec> specs) {
  all_.reserve(specs.size());
  for (auto& each : specs)
    all_.push_back({.spec = std::move(each), .incarnation = nullptr, .recovers_since_ns = {}});
}

template <class Predicate>
std::size_t child_list::find_if(Predicate matches) const {
  return static_cast<std::size_t>(std::ranges::find_if(all_, matches) - all_.begin());
}

std::size_t child_list::find(const std::string& name) const {
  return find_if([&](const child_runtime& each) { return each.name() == name; });
}

std::size_t child_list::find(std::uint32_t address_number) const {
  return find_if([&](const child_runtime& each) { return each.address().number() == address_number; });
}

std::size_t child_list::find(const caf::actor_addr& incarnation) const {
  return find_if(
      [&](const child_runtime& each) { return each.incarnation && each.incarnation->address() == incarnation; });
}

children child_list::report(const supervision_core& core, const health_board& health) const {
  children result;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    child_report each;
    each.name = all_[i].name();
    each.phase = core.phase(i);
    each.incarnation = all_[i].number;
    each.restarts = core.restarts(i);
    each.last_crash = all_[i].address().last_crash();
    each.wanted = core.is_wanted(i);
    each.essential = core.policy(i).essential;
    result.list.push_back(std::move(each));
  }
  for (const auto& shown : health.entries()) {
    if (const auto i = find(shown.component); i < all_.size()) {
      result.list[i].health = shown.colour;
      result.list[i].health_reason = shown.reason;
    }
  }
  return result;
}

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
