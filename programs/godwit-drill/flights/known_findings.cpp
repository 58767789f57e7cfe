#include "programs/godwit-drill/flights/known_findings.hpp"

#include <algorithm>
#include <array>

namespace godwit::drill {
namespace {

constexpr std::array all_known{
    known_finding{"replaced_and_killed/commit_25", "there are two different reports 1 of mission"},
    known_finding{"replaced_and_killed/commit_25", "is of generation 1, behind generation 2"},
};

} // namespace

std::span<const known_finding> known_findings() { return all_known; }

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
