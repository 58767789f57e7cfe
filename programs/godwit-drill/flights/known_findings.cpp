#include "programs/godwit-drill/flights/known_findings.hpp"

#include <algorithm>

namespace godwit::drill {

std::span<const known_finding> known_findings() { return {}; }

void set_known_aside(flight_outcome& each, std::span<const known_finding> all) {
  const auto is_known = [&](const std::string& flaw) {
    return std::ranges::any_of(all, [&](const known_finding& known) {
      return each.name.find(known.in_name) != std::string::npos && flaw.find(known.in_flaw) != std::string::npos;
    });
  };
  std::ranges::copy_if(each.flaws, std::back_inserter(each.known), is_known);
  std::erase_if(each.flaws, is_known);
}

} // namespace godwit::drill
