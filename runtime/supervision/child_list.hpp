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

#include "runtime/health_board.hpp"
#include "runtime/journal/journal.hpp"
#include "runtime/stable_address.hpp"
#include "runtime/supervision/child_spec.hpp"
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

} // namespace godwit::runtime
