// The journal is a real file of SQLite, whose disk fails at a write of a mission: each write or each sync of the file
// gives an error for 10 s, or there is no room; a write is done by half, or a sync fails, and then the power is lost.
//
// Behind a loss of power each write that was never synced is there or not, as the seed draws it. What was acknowledged
// has to be found again by the next process, whatever became of the rest.
#include <array>

#include "programs/godwit-drill/flight_simulation/stored_disk.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"

namespace godwit::drill {
namespace {

using io::sqlite::fault_kind;
using io::sqlite::fault_plan;
using io::sqlite::file_operation;
using side = flight_simulation::side;

struct file_fault {
  const char* name;
  fault_plan how;
};
constexpr std::array file_faults{
    file_fault{"file_write_error_10s", {fault_kind::io_error, 1, true, file_operation::write}},
    file_fault{"file_sync_error_10s", {fault_kind::io_error, 1, true, file_operation::sync}},
    file_fault{"file_full_10s", {fault_kind::disk_full, 1, true, file_operation::write}},
    file_fault{"file_torn_write", {fault_kind::torn_write, 1, false, file_operation::write}},
    file_fault{"file_lost_sync", {fault_kind::io_error, 1, false, file_operation::sync}}};
constexpr std::uint64_t each_nth_commit = 4;
constexpr std::uint64_t most_writes = 4; // of one commit; the one that is torn is drawn
constexpr double fails_for_s = 10;
constexpr double off_for_s = 20;

struct stored_case {
  sim::personality who;
  std::uint64_t commit;
  file_fault fault;

  [[nodiscard]] std::string group() const { return row_of(who, fault.name); }
  [[nodiscard]] std::string name() const { return group() + "/commit_" + std::to_string(commit); }
};

// False: nothing was written any more.
bool let_happen(flight_simulation& flight, const fault_plan& how) {
  if (how.from_then_on) {
    flight.run_for(fails_for_s);
    const bool has_failed = flight.stored()->has_failed();
    flight.stored()->mend();
    return has_failed;
  }
  if (!flight.run_until([&] { return flight.stored()->has_failed(); }, fails_for_s))
    return false;
  flight.lose_power(off_for_s);
  return true;
}

flight_outcome fly(const stored_case& what, const flight_wishes& wishes) {
  flight_simulation::options wanted{.who = what.who, .seed = what.commit};
  wanted.has_stored_journal = true;
  watched_flight watched(wanted, wishes, what.name(), what.group());
  auto& flight = watched.flight();
  auto how = what.fault.how;
  if (how.kind == fault_kind::torn_write)
    how.at += static_cast<std::int64_t>(what.commit / each_nth_commit % most_writes);
  bool is_there = false;
  flight.at_commit(what.commit, side::before, [&] {
    is_there = true;
    flight.stored()->fail(how);
  });
  const auto has_ended = [&] { return is_there || executor::is_at_rest(flight.status().now); };
  if (!flight.run_until(has_ended, 600) || !is_there)
    watched.so_far().skipped = "the flight had no such commit";
  else if (!let_happen(flight, how))
    watched.so_far().skipped = "nothing was written after it";
  auto outcome = watched.finish();
  if (flight.outside().journal.forgotten != 0)
    outcome.flaws.emplace_back("a process did not find again what its journal had acknowledged");
  return outcome;
}

} // namespace

std::vector<flight_case> stored_disk_cases(vehicles which, std::span<const std::uint64_t> commits) {
  std::vector<flight_case> result;
  for (std::size_t i = 0; i < which.size(); ++i)
    for (std::uint64_t commit = 1; commit <= commits[i]; commit += each_nth_commit)
      for (const auto& fault : file_faults) {
        const stored_case what{which[i], commit, fault};
        result.push_back(
            {what.name(), what.group(), [what](const flight_wishes& wishes) { return fly(what, wishes); }});
      }
  return result;
}

} // namespace godwit::drill
