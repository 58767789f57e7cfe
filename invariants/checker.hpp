// Looks for every promise in one pass over a record, and says of each: held, violated, or undecided.
//
// Undecided: there is no delivery in the record; or nothing was found, or nothing that a missing record does not
// explain, and records are missing, or there is no journal where one is asked. Findings that a missing record can
// explain count only in runs without holes. Thread: one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "invariants/invariant.hpp"

namespace godwit::invariants {

enum class verdict { held, violated, undecided };

GODWIT_ENUM_NAMES(verdict, held, violated, undecided);

struct judged {
  const rule* which = nullptr;
  verdict how = verdict::held;
  std::vector<finding> findings; // that make it so
  std::uint64_t more = 0;        // findings that were not kept
};

class checker {
public:
  checker();

  // In the order of time within a run, runs in their order.
  void take(const runtime::delivery& each, const runtime::name_table& names);
  // After the last delivery, and read after it: what the journal beside the record has.
  void take_journal(const journal_record& journal);
  // Records of this run are missing between others that are there.
  void note_hole(std::uint64_t run) { holes_.insert(run); }

  [[nodiscard]] std::vector<judged> judge() const;

private:
  [[nodiscard]] bool is_explained(const finding& each) const;

  std::vector<std::unique_ptr<invariant>> invariants_; // one for each rule, in their order
  std::set<std::uint64_t> holes_;                      // runs
  bool has_deliveries_ = false;
  bool has_journal_ = false;
};

} // namespace godwit::invariants
