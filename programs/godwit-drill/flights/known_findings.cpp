#include "programs/godwit-drill/flights/known_findings.hpp"

#include <algorithm>
#include <array>

namespace godwit::drill {

std::span<const known_finding> known_findings() {
  static constexpr std::array<known_finding, 7> all{{
      // A process without the journal of its flight numbers its reports from 1 again.
      {"_and_killed/", "a report came again with another content"},
      {"_and_killed/", "goes back to an earlier item"},
      {"_and_killed/", "a second time"},
      {"_and_killed/", "is of an old generation"},
      {"_and_killed/", "reports_without_gap: "},
      {"_and_killed/", "generation_never_falls: "},
      {"_and_killed/", "complete_once: "},
  }};
  return all;
}

void set_known_aside(flight_outcome& each) {
  const auto is_known = [&](const std::string& flaw) {
    return std::ranges::any_of(known_findings(), [&](const known_finding& known) {
      return each.name.find(known.in_name) != std::string::npos && flaw.find(known.in_flaw) != std::string::npos;
    });
  };
  std::ranges::copy_if(each.flaws, std::back_inserter(each.known), is_known);
  std::erase_if(each.flaws, is_known);
}

} // namespace godwit::drill
