// The children of a guardian: what it knows of each, and how it finds one. For guardian.cpp alone. Thread: one owner.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <caf/all.hpp>
#include <tl/expected.hpp>

#include "runtime/address/stable_address.hpp"
#include "runtime/health_board.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/supervision/child_spec.hpp"
#include "runtime/supervision/policy.hpp"
#include "runtime/supervision/supervision_core.hpp"

namespace godwit::runtime {

// Where the journal's thread leaves what it recovered until the guardian picks it up.
struct recovery_slot {
  std::mutex mutex;
  std::map<std::uint64_t, tl::expected<recovered, journal_error>> by_incarnation;
};

struct child_runtime {
  child_spec spec;
  caf::strong_actor_ptr incarnation;
  std::uint64_t number = 0; // of the incarnation
  std::shared_ptr<recovery_slot> slot = std::make_shared<recovery_slot>();
  std::optional<std::int64_t> recovers_since_ns; // its durable state is being read

  [[nodiscard]] stable_address& address() const { return address_of(spec.address); }
  [[nodiscard]] const std::string& name() const { return address().actor_name(); }
};

class child_list {
public:
  explicit child_list(std::vector<child_spec> specs);

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] child_runtime& operator[](std::size_t index) { return all_[index]; }
  [[nodiscard]] const child_runtime& operator[](std::size_t index) const { return all_[index]; }
  [[nodiscard]] auto begin() { return all_.begin(); }
  [[nodiscard]] auto end() { return all_.end(); }
  void clear() { all_.clear(); }

  // The index; size() when it is no child, or none that lives now.
  [[nodiscard]] std::size_t find(const std::string& name) const;
  [[nodiscard]] std::size_t find(std::uint32_t address_number) const;
  [[nodiscard]] std::size_t find(const caf::actor_addr& incarnation) const;

  // What is answered to get_children.
  [[nodiscard]] children report(const supervision_core& core, const health_board& health) const;

private:
  template <class Predicate>
  [[nodiscard]] std::size_t find_if(Predicate matches) const;

  std::vector<child_runtime> all_;
};

// Who owes an answer to a ping, and since when. After F´ (Svc/Health): each entry has a warn and a fatal limit.
// Thread: one owner.
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
