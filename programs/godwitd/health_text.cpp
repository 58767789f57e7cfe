#include "programs/godwitd/health_text.hpp"

#include <algorithm>

#include "runtime/supervision/messages.hpp"

namespace godwit::daemon {
namespace {

using runtime::health_colour;
using runtime::health_entry;

std::string because(const std::string& reason) { return reason.empty() ? "" : ": " + reason; }

// A reason with another number in it is no news.
std::string without_numbers(std::string reason) {
  std::erase_if(reason, [](char each) { return each >= '0' && each <= '9'; });
  return reason;
}

} // namespace

std::string health_in_a_line(const std::vector<health_entry>& now) {
  const auto ill = std::ranges::count_if(now, [](const auto& each) { return each.colour != health_colour::green; });
  if (ill == 0)
    return "all is well";
  const auto& worst = *std::ranges::max_element(now, {}, &health_entry::colour);
  return std::string(io::name_of(worst.colour)) + ": " + worst.component + because(worst.reason) +
         (ill > 1 ? "; and " + std::to_string(ill - 1) + " more" : "");
}

std::vector<health_change> health_changes(const std::vector<health_entry>& before,
                                          const std::vector<health_entry>& now) {
  std::vector<health_change> result;
  for (const auto& each : now) {
    const auto known = std::ranges::find(before, each.component, &health_entry::component);
    const auto was = known == before.end() ? health_colour::green : known->colour;
    const bool has_other_reason =
        known != before.end() && without_numbers(known->reason) != without_numbers(each.reason);
    if (each.colour == was && (each.colour == health_colour::green || !has_other_reason))
      continue;
    result.push_back({each.component, each.colour,
                      each.colour == health_colour::green
                          ? each.component + " is well again"
                          : each.component + " is " + std::string(io::name_of(each.colour)) + because(each.reason)});
  }
  return result;
}

} // namespace godwit::daemon
