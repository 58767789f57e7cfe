// The journal's disk fails at a write of a mission: it gives errors or takes nothing for a while, can be read only
// until the flight is over, takes 2 s for each sync, or loses its power with the write half done; and the journal is
// deleted or replaced, and then the process is killed.
//
// The writer tries again after each error of the disk, whatever its name (docs/operations.md, Disk full): an error
// and a full disk are one case here. A journal that was deleted under a process that goes on is the same until it is
// rescued.
#include <array>
#include <map>

#include "programs/godwit-drill/flight_simulation/flight_judge.hpp"
#include "programs/godwit-drill/flight_simulation/flight_people.hpp"
#include "programs/godwit-drill/flight_simulation/stored_disk.hpp"
#include "programs/godwit-drill/flights/disturbed_flight.hpp"
#include "programs/godwit-drill/flights/flight_case.hpp"

namespace godwit::drill {

namespace {

using side = flight_simulation::side;

enum class disk_fault { errors, takes_nothing, read_only, slow_sync, power_loss, deleted, replaced };

struct named_fault {
  disk_fault what;
  const char* name;
};
constexpr std::array disk_faults{named_fault{disk_fault::errors, "errors_10s"},
                                 named_fault{disk_fault::takes_nothing, "takes_nothing_10s"},
                                 named_fault{disk_fault::read_only, "read_only"},
                                 named_fault{disk_fault::slow_sync, "sync_2s"},
                                 named_fault{disk_fault::power_loss, "power_loss"},
                                 named_fault{disk_fault::deleted, "deleted_and_killed"},
                                 named_fault{disk_fault::replaced, "replaced_and_killed"}};
constexpr std::uint64_t each_nth_commit = 4;
constexpr double fails_for_s = 10;
constexpr double off_for_s = 20;
constexpr double sync_s = 2;

void set_fault(flight_simulation& flight, disk_fault what, bool is_there) {
  auto* process = flight.process();
  if (process == nullptr)
    return;
  if (what == disk_fault::takes_nothing)
    process->fill_journal(is_there);
  else
    process->fail_journal(is_there);
}

// Who finds it has another disk, and knows nothing of this flight, or what was known when it began.
void lose_journal(flight_simulation& flight, std::map<std::string, runtime::simulated_disk::actor_rows> other) {
  flight.kill_process();
  auto& disk = flight.outside().journal;
  disk.actors = std::move(other);
  disk.outbox.clear();
  disk.rows.clear();
}

void begin(flight_simulation& flight, disk_fault what,
           const std::map<std::string, runtime::simulated_disk::actor_rows>& old) {
  switch (what) {
  case disk_fault::errors:
  case disk_fault::takes_nothing:
  case disk_fault::read_only:
    return set_fault(flight, what, true);
  case disk_fault::slow_sync:
    return flight.slow_journal(sync_s);
  case disk_fault::power_loss:
    return flight.lose_power(off_for_s);
  case disk_fault::deleted:
    return lose_journal(flight, {});
  case disk_fault::replaced:
    return lose_journal(flight, old);
  }
}

// Lets it last, and ends it.
void let_last(watched_flight& watched, disk_fault what) {
  auto& flight = watched.flight();
  const auto is_over = [&] {
    return executor::is_over(flight.status().now) || flight.status().now == executor::phase::paused;
  };
  if (what == disk_fault::errors || what == disk_fault::takes_nothing) {
    flight.run_for(fails_for_s);
    set_fault(flight, what, false);
  } else if (what == disk_fault::read_only) {
    (void)flight.run_until(is_over, 120);
    set_fault(flight, what, false);
  }
}

struct disk_case {
  sim::personality who;
  std::uint64_t commit;
  named_fault fault;

  [[nodiscard]] std::string group() const { return row_of(who, fault.name); }
  [[nodiscard]] std::string name() const { return group() + "/commit_" + std::to_string(commit); }
};

// Who has lost the journal of a flight does not know that it is his: he follows it, and starts nothing after it.
void expect_no_start(watched_flight& watched, bool was_under_way) {
  constexpr double flown_and_looked_at_s = 90;
  auto& flight = watched.flight();
  const auto since_ns = flight.now_ns();
  if (!was_under_way)
    return;
  flight.run_for(flown_and_looked_at_s);
  watched.expect(starts_since(flight, since_ns) == 0 ? "" : "it was started by itself after a flight that nobody knew");
}

// Who has an older journal finds a mission that is further than he knew. A plane that has landed does not take off for
// what seems to be left: a person is told.
flight_outcome finish_with_older_journal(watched_flight& watched) {
  auto& flight = watched.flight();
  const auto since_ns = flight.now_ns();
  if (flight.who() != sim::personality::plane)
    return watched.finish();
  (void)fly_with_help(flight);
  if (waits_for_another_mission(flight))
    watched.expect(starts_since(flight, since_ns) == 0 ? "" : "it was started for a rest that it can not fly");
  return watched.finish(flight_ends::or_waits_with_the_rest);
}

flight_simulation::options options_for(const disk_case& what) {
  if (what.fault.what != disk_fault::slow_sync)
    return {.who = what.who, .seed = what.commit};
  auto result = slow_flight(what.who);
  result.speed = 1; // a PX4 disarms when nothing follows the arming for 10 s of its world
  result.seed = what.commit;
  return result;
}

flight_outcome fly(const disk_case& what, const flight_wishes& wishes) {
  watched_flight watched(options_for(what), wishes, what.name(), what.group());
  auto& flight = watched.flight();
  bool is_there = false;
  bool was_under_way = false;
  std::map<std::string, runtime::simulated_disk::actor_rows> old;
  if (what.fault.what == disk_fault::replaced) // by what it was when the plan was on the vehicle
    (void)flight.run_until_phase(executor::phase::ready, 120);
  old = flight.outside().journal.actors;
  flight.at_commit(what.commit, side::before, [&] {
    is_there = true;
    const auto seen = flight.vehicle().describe();
    was_under_way = flight.status().in_flight && (seen.in_air || seen.ground_speed_mps > 1);
    begin(flight, what.fault.what, old);
  });
  const auto has_ended = [&] { return is_there || executor::is_at_rest(flight.status().now); };
  if (!flight.run_until(has_ended, 600) || !is_there)
    watched.so_far().skipped = "the flight had no such commit";
  else if (what.fault.what == disk_fault::replaced)
    return finish_with_older_journal(watched);
  else if (what.fault.what == disk_fault::deleted)
    expect_no_start(watched, was_under_way);
  else
    let_last(watched, what.fault.what);
  return watched.finish();
}

} // namespace

std::vector<flight_case> disk_cases(vehicles which, std::span<const std::uint64_t> commits) {
  std::vector<flight_case> result;
  for (std::size_t i = 0; i < which.size(); ++i)
    for (std::uint64_t commit = 1; commit <= commits[i]; commit += each_nth_commit)
      for (const auto& fault : disk_faults) {
        const disk_case what{which[i], commit, fault};
        result.push_back(
            {what.name(), what.group(), [what](const flight_wishes& wishes) { return fly(what, wishes); }});
      }
  return result;
}

// The journal is a real file of SQLite, whose disk fails at a write of a mission: each write or each sync of the file
// gives an error for 10 s, or there is no room; a write is done by half, or a sync fails, and then the power is lost.
//
// After a loss of power each write that was never synced is there or not, as the seed draws it. What was acknowledged
// has to be found again by the next process, whatever became of the rest.

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
constexpr std::uint64_t most_writes = 4; // of one commit; the one that is torn is drawn

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
