// Who owes an answer to a ping, and since when. After F´ (Svc/Health): each entry has a warn and a fatal limit.
// Thread: one owner.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/supervision/policy.hpp"

namespace godwit::runtime {

class ping_ledger {
public:
  struct verdict {
    std::vector<std::size_t> to_ping; // the key to send is key_of(child)
    std::vector<std::size_t> late;    // passed the warn limit just now
    std::vector<std::size_t> silent;  // passed the fatal limit; treated as crashed
  };

  ping_ledger(ping_policy policy, std::size_t children) : policy_(policy), entries_(children) {}

  // A child is watched from the moment it is up until it is down.
  void watch(std::size_t child, std::int64_t now_ns);
  void forget(std::size_t child) { entries_[child] = {}; }
  [[nodiscard]] verdict tick(std::int64_t now_ns);
  enum class answer { stale, in_time, late }; // stale: to no ping that is under way
  answer answered(std::size_t child, std::uint64_t key);
  [[nodiscard]] std::uint64_t key_of(std::size_t child) const { return entries_[child].key; }

private:
  struct entry {
    bool watched = false;
    bool waiting = false; // for the answer to `key`
    bool warned = false;
    std::uint64_t key = 0;
    std::int64_t sent_ns = 0;
  };

  ping_policy policy_;
  std::vector<entry> entries_;
  std::uint64_t last_key_ = 0;
};

} // namespace godwit::runtime
