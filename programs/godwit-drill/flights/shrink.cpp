#include "programs/godwit-drill/flights/shrink.hpp"

#include <algorithm>
#include <utility>

namespace godwit::drill {

std::vector<std::uint64_t>
not_needed_to_fail(std::uint64_t faults, const std::function<bool(const std::vector<std::uint64_t>& without)>& fails) {
  std::vector<std::uint64_t> result;
  for (bool is_shorter = true; is_shorter;) { // what was needed beside another fault may not be without it
    is_shorter = false;
    for (std::uint64_t fault = 0; fault < faults; ++fault) {
      if (std::ranges::find(result, fault) != result.end())
        continue;
      auto without = result;
      without.push_back(fault);
      std::ranges::sort(without);
      if (!fails(without))
        continue;
      result = std::move(without);
      is_shorter = true;
    }
  }
  return result;
}

} // namespace godwit::drill
