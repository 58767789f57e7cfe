// Which message caused which, over a whole run: 16 bytes a message.
//
// Errors: none; a cause that is not in the trace ends a chain. Thread: one at a time.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace godwit::trace_tool {

class cause_index {
public:
  void add(std::uint64_t id, std::uint64_t cause);
  void sort(); // after the last add(), before anything is asked

  // ID, what led to it, and what came of it, at most LIMIT messages, the nearest first. `is_all`: none was left out.
  struct family {
    std::unordered_set<std::uint64_t> ids;
    std::uint64_t origin = 0; // the oldest ancestor
    bool is_all = true;
  };
  [[nodiscard]] family family_of(std::uint64_t id, std::size_t limit) const;

private:
  struct edge {
    std::uint64_t cause;
    std::uint64_t id;
    friend auto operator<=>(const edge&, const edge&) = default;
  };
  [[nodiscard]] std::uint64_t cause_of(std::uint64_t id) const;

  std::vector<edge> by_cause_;
  std::vector<std::uint32_t> by_id_; // places in by_cause_
};

} // namespace godwit::trace_tool
