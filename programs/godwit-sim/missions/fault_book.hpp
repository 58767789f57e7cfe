// The faults that are on, and whom they hit next.
//
// Each counts the calls that it could be meant for; so two of them that are asked for the first call both hit it.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "programs/godwit-sim/missions/fault.hpp"
#include "programs/godwit-sim/missions/figures.hpp"

namespace godwit::sim::missions {

class fault_book {
public:
  static constexpr std::size_t max_faults = 64;

  [[nodiscard]] tl::expected<fault_rule, std::string> add(std::string_view spec);
  void clear() { entries_.clear(); }

  // A call has come: what hits it, in the order in which the faults were asked for.
  [[nodiscard]] std::vector<fault::any> hit_by_call(endpoint where);
  // A connection has come: whether it gets the certificate of another host.
  [[nodiscard]] bool next_is_wrong_host();
  // Whether nobody is to listen.
  [[nodiscard]] bool refuses() const;
  // The first `refuse` has had its time.
  void end_refusal();

  [[nodiscard]] std::vector<fault_figures> figures() const;

private:
  struct entry {
    fault_rule rule;
    fault_figures counted;
  };

  // Counts one more, and says whether it is hit.
  [[nodiscard]] static bool count(entry& each);

  std::vector<entry> entries_;
};

} // namespace godwit::sim::missions
