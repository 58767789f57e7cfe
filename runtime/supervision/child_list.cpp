#include "runtime/supervision/child_list.hpp"

#include <algorithm>
#include <utility>

namespace godwit::runtime {

child_list::child_list(std::vector<child_spec> specs) {
  all_.reserve(specs.size());
  for (auto& each : specs)
    all_.push_back({.spec = std::move(each), .incarnation = nullptr, .recovers_since_ns = {}});
}

template <class Predicate>
std::size_t child_list::find_if(Predicate matches) const {
  return static_cast<std::size_t>(std::ranges::find_if(all_, matches) - all_.begin());
}

std::size_t child_list::find(const std::string& name) const {
  return find_if([&](const child_runtime& each) { return each.name() == name; });
}

std::size_t child_list::find(std::uint32_t address_number) const {
  return find_if([&](const child_runtime& each) { return each.address().number() == address_number; });
}

std::size_t child_list::find(const caf::actor_addr& incarnation) const {
  return find_if(
      [&](const child_runtime& each) { return each.incarnation && each.incarnation->address() == incarnation; });
}

children child_list::report(const supervision_core& core, const health_board& health) const {
  children result;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    child_report each;
    each.name = all_[i].name();
    each.phase = core.phase(i);
    each.incarnation = all_[i].number;
    each.restarts = core.restarts(i);
    each.last_crash = all_[i].address().last_crash();
    each.wanted = core.is_wanted(i);
    each.essential = core.policy(i).essential;
    result.list.push_back(std::move(each));
  }
  for (const auto& shown : health.entries()) {
    if (const auto i = find(shown.component); i < all_.size()) {
      result.list[i].health = shown.colour;
      result.list[i].health_reason = shown.reason;
    }
  }
  return result;
}

} // namespace godwit::runtime
