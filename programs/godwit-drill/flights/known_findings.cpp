#include "programs/godwit-drill/flights/known_findings.hpp"

#include <algorithm>
#include <array>

namespace godwit::drill {

std::span<const known_finding> known_findings() {
  static constexpr std::array<known_finding, 9> all{{
      // A report that had not reached the service is lost with the journal, and its number is used again.
      {"/deleted_and_killed/", "reports_without_gap: there are two different reports"},
      {"/deleted_and_killed/", "complete_once: "},
      // A process with an older journal of its flight numbers its reports from there again.
      {"/replaced_and_killed/", "a report came again with another content"},
      {"/replaced_and_killed/", "goes back to an earlier item"},
      {"/replaced_and_killed/", "a second time"},
      {"/replaced_and_killed/", "is of an old generation"},
      {"/replaced_and_killed/", "reports_without_gap: "},
      {"/replaced_and_killed/", "generation_never_falls: "},
      {"/replaced_and_killed/", "complete_once: "},
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
