#include "programs/godwit-sim/missions/fault_book.hpp"

#include <algorithm>

namespace godwit::sim::missions {
namespace {

bool is_refusal(const fault_rule& rule) { return std::holds_alternative<fault::refuse>(rule.what); }
bool is_wrong_host(const fault_rule& rule) { return std::holds_alternative<fault::wrong_host>(rule.what); }

} // namespace

tl::expected<fault_rule, std::string> fault_book::add(std::string_view spec) {
  auto rule = parse_fault_rule(spec);
  if (rule && entries_.size() == max_faults)
    return tl::unexpected("there are " + std::to_string(max_faults) +
                          " faults already; take them off first (faults off)");
  if (rule)
    entries_.push_back({*rule, {.spec = std::string(spec)}});
  return rule;
}

bool fault_book::count(entry& each) {
  const auto number = ++each.counted.seen;
  const bool is_hit = number >= each.rule.from && (!each.rule.times || number - each.rule.from < *each.rule.times);
  each.counted.hit += is_hit ? 1 : 0;
  return is_hit;
}

std::vector<fault::any> fault_book::hit_by_call(endpoint where) {
  std::vector<fault::any> hits;
  for (auto& each : entries_) {
    const bool is_meant =
        !is_refusal(each.rule) && !is_wrong_host(each.rule) && (!each.rule.where || *each.rule.where == where);
    if (is_meant && count(each))
      hits.push_back(each.rule.what);
  }
  return hits;
}

bool fault_book::next_is_wrong_host() {
  bool is_hit = false;
  for (auto& each : entries_)
    if (is_wrong_host(each.rule))
      is_hit = count(each) || is_hit;
  return is_hit;
}

bool fault_book::refuses() const {
  return std::ranges::any_of(entries_, [](const entry& each) { return is_refusal(each.rule); });
}

void fault_book::end_refusal() {
  const auto found = std::ranges::find_if(entries_, [](const entry& each) { return is_refusal(each.rule); });
  if (found != entries_.end())
    entries_.erase(found);
}

std::vector<fault_figures> fault_book::figures() const {
  std::vector<fault_figures> all;
  for (const auto& each : entries_)
    all.push_back(each.counted);
  return all;
}

} // namespace godwit::sim::missions
