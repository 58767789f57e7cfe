#include "programs/godwit-drill/flights/known_findings.hpp"

#include <algorithm>
#include <array>

namespace godwit::drill {

std::span<const known_finding> known_findings() {
  // A plane that has landed by its plan, found with a journal from before that: its landing alone can not be prepared.
  static constexpr std::array<known_finding, 2> all{
      {{"plane/replaced_and_killed/", "it has no end"},
       {"plane/replaced_and_killed/", "it neither ends nor waits for a person"}}};
  return all;
}

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
