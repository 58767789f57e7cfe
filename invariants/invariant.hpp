// A promise of godwit that can be looked for in the record of what its actors did, whoever made that record: a flight,
// a drill, a simulation, a property test. All of them share these objects.
//
//   deliveries, in the order of time ──> take() ──> findings, each with the messages that show it
//
// An invariant knows nothing of files. What was not recorded may make a promise look broken: such a finding is
// `if_complete`, and says nothing where the record has a hole, or `across_runs`: a process that is killed takes the
// newest records with it. The others are `certain`. Thread: one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/journal/records.hpp"
#include "runtime/trace/reading/delivery.hpp"

namespace godwit::invariants {

// What the journal has of a flight, as far as promises are about it: plain values, whoever has read them.
// Thread: plain values.
struct given_up_message {
  std::string actor;
  runtime::dead_letter letter;
};

struct journal_record {
  std::vector<runtime::outbox_row> outbox;           // of mission_client; delivered rows are kept for a while
  std::map<std::string, std::uint64_t> last_reports; // that mission_client has taken, by mission; the newest missions
  std::vector<runtime::effect_record> owed;          // by the executor: not confirmed by who is to take it
  std::vector<given_up_message> given_up;
};

enum class certainty {
  certain,     // whatever else happened
  if_complete, // unless something was not recorded
  across_runs  // unless the process was killed in between
};

struct finding {
  certainty how_sure = certainty::certain;
  std::uint64_t run = 0;
  std::int64_t at_ns = 0;
  std::vector<std::uint64_t> ids; // of the messages that show it
  std::string what;               // a sentence without its end
};

class invariant {
public:
  static constexpr std::size_t max_findings = 100; // kept; further ones are only counted

  invariant() = default;
  virtual ~invariant() = default;
  invariant(const invariant&) = delete;
  invariant& operator=(const invariant&) = delete;

  // In the order of time within a run, runs in their order.
  virtual void take(const runtime::delivery& each, const runtime::name_table& names) = 0;

  // After the last delivery, for what is promised of the journal.
  virtual void take_journal(const journal_record& journal) { (void)journal; }

  [[nodiscard]] const std::vector<finding>& findings() const { return findings_; }
  [[nodiscard]] std::uint64_t findings_not_kept() const { return not_kept_; }

protected:
  void find(certainty how_sure, const runtime::delivery& at, std::vector<std::uint64_t> ids, std::string what) {
    if (findings_.size() < max_findings)
      findings_.push_back({how_sure, at.run, at.began_ns, std::move(ids), std::move(what)});
    else
      ++not_kept_;
  }

  // What came later explains those for which IS_EXPLAINED(finding).
  template <class Predicate>
  void withdraw(Predicate is_explained) {
    std::erase_if(findings_, is_explained);
  }

private:
  std::vector<finding> findings_;
  std::uint64_t not_kept_ = 0;
};

// One row of the list.
struct rule {
  std::string_view name;
  std::string_view requirement; // the promise, as a sentence
  std::string_view where;       // where the project makes it
  std::unique_ptr<invariant> (*make)();
  bool asks_journal = false; // nothing is known without one
};

// All of them.
[[nodiscard]] std::span<const rule> all_rules();

} // namespace godwit::invariants
