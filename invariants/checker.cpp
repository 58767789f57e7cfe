#include "invariants/checker.hpp"

namespace godwit::invariants {

checker::checker() {
  for (const auto& each : all_rules())
    invariants_.push_back(each.make());
}

void checker::take(const runtime::delivery& each, const runtime::name_table& names) {
  has_deliveries_ = true;
  for (const auto& one : invariants_)
    one->take(each, names);
}

void checker::take_journal(const journal_record& journal) {
  has_journal_ = true;
  for (const auto& one : invariants_)
    one->take_journal(journal);
}

bool checker::is_explained(const finding& each) const {
  return each.how_sure == certainty::across_runs ||
         (each.how_sure == certainty::if_complete && holes_.contains(each.run));
}

std::vector<judged> checker::judge() const {
  std::vector<judged> result;
  const auto rules = all_rules();
  for (std::size_t n = 0; n < rules.size(); ++n) {
    const auto& found = invariants_[n]->findings();
    judged one{&rules[n], verdict::held, {}, invariants_[n]->findings_not_kept()};
    for (const auto& each : found)
      if (!is_explained(each))
        one.findings.push_back(each);
    if (!one.findings.empty()) {
      one.how = verdict::violated;
    } else if (!has_deliveries_ || !found.empty() || !holes_.empty() || (rules[n].asks_journal && !has_journal_)) {
      one.how = verdict::undecided;
      one.findings = found;
    }
    result.push_back(std::move(one));
  }
  return result;
}

} // namespace godwit::invariants
