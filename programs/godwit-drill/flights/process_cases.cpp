// The process ends as by SIGKILL at one commit of its journal: mailboxes and what was not committed are gone, the next
// process goes on.
#include "programs/godwit-drill/flights/flight_case.hpp"

namespace godwit::drill {
namespace {

using side = flight_simulation::side;

flight_outcome fly(sim::personality who, std::uint64_t commit, side where, const std::string& name,
                   const flight_wishes& wishes) {
  watched_flight watched({.who = who, .seed = commit}, wishes, name, std::string(io::name_of(who)));
  watched.flight().kill_process_at_commit(commit, where);
  auto result = watched.finish();
  if (result.kills == 0) // in another order of events a flight has some commits less
    result.skipped = "the flight had no such commit";
  return result;
}

} // namespace

flight_outcome fly_undisturbed(sim::personality who, const flight_wishes& wishes) {
  return watched_flight({.who = who}, wishes, std::string(io::name_of(who)) + "/undisturbed",
                        std::string(io::name_of(who)))
      .finish();
}

std::vector<flight_case> process_cases(vehicles which, std::span<const std::uint64_t> commits) {
  std::vector<flight_case> result;
  for (std::size_t i = 0; i < which.size(); ++i)
    for (std::uint64_t commit = 1; commit <= commits[i]; ++commit)
      for (const auto where : {side::before, side::after}) {
        const auto who = which[i];
        const auto group = std::string(io::name_of(who));
        const auto name = group + "/commit_" + std::to_string(commit) + (where == side::before ? "/before" : "/after");
        result.push_back(
            {name, group, [=](const flight_wishes& wishes) { return fly(who, commit, where, name, wishes); }});
      }
  return result;
}

} // namespace godwit::drill
