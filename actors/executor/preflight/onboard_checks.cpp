// Of the program, its disk, its map and its people.
#include "actors/executor/preflight/checks.hpp"

#include <string>

#include "io/time_units.hpp"

namespace godwit::executor::preflight {

result check_map_objects(const facts& seen, const settings&) {
  using mission_client::pull_state;
  const auto& now = seen.mission;
  if (!now.has_service)
    return skipped("The mission did not come from the missions service: there is no map for it.");
  switch (now.map) {
  case pull_state::synced:
    return pass("The objects of the map are pulled.");
  case pull_state::cached_fallback:
    return degraded(
        "The objects of the map could not be pulled, and a copy from before is used: what was seen since then "
        "is not in it. godwit pulls again by itself, and at once with `godwitd ctl pull`; or fly with the copy.");
  case pull_state::in_flight:
    return fail("The objects of the map are being pulled; wait." +
                (now.map_problem.empty() ? "" : " Before: " + now.map_problem));
  case pull_state::failed:
    return fail("The objects of the map could not be pulled, and there is no earlier copy; check the connection "
                "to the missions service. godwit pulls again by itself, and at once with `godwitd ctl pull`." +
                (now.map_problem.empty() ? "" : " " + now.map_problem));
  case pull_state::not_started:
    break;
  }
  return fail("The objects of the map are not pulled yet; wait until the mission is fetched.");
}

result check_journal(const facts& seen, const settings&) {
  if (!seen.journal.is_sound)
    return fail(
        "The journal did not pass its integrity check; move the file away and start again, or take a new disk.");
  if (!seen.journal.is_writable)
    return fail("The journal can not be written; check whether the disk is full, broken or read-only.");
  if (seen.journal.is_nearly_full)
    return fail(
        "The journal's disk is too slow: what waits to be written is near its bound; wait, or take another disk.");
  return pass("The journal is sound and can be written.");
}

namespace {

constexpr std::uint64_t bytes_per_mib = 1024 * 1024;

bool is_below(std::uint64_t bytes, std::int64_t limit_mib) {
  return limit_mib > 0 && bytes / bytes_per_mib < static_cast<std::uint64_t>(limit_mib);
}

std::string sentence_of(std::int64_t limit_mib) {
  return "Less than " + std::to_string(limit_mib) +
         " MiB are free on the disk of the journal; delete what is not needed.";
}

} // namespace

result check_free_space(const facts& seen, const settings& set) {
  if (!seen.journal.free_bytes)
    return degraded("It is not known how much is free on the disk of the journal; check it yourself.");
  if (is_below(*seen.journal.free_bytes, set.journal_min_free_mib))
    return fail(sentence_of(set.journal_min_free_mib));
  if (is_below(*seen.journal.free_bytes, set.journal_low_free_mib))
    return degraded(sentence_of(set.journal_low_free_mib));
  return pass("The disk of the journal has room.");
}

namespace {}

result check_wall_clock(const facts& seen, const settings& set) {
  if (seen.wall_ns / ns_per_s < set.earliest_date_s)
    return fail("The clock of this computer shows a date of the past; wait until it is set by satellite or network, or "
                "set it by hand.");
  return pass("The clock of this computer is set.");
}

result check_operator_session(const facts& seen, const settings& set) {
  if (!set.is_operator_session_required)
    return skipped("No operator has to be there.");
  if (!seen.is_operator_session_alive)
    return fail("An operator has to be there, and none is; connect and log in.");
  return pass("An operator is there.");
}

namespace {

std::string names_of_missing(const std::vector<actor_fact>& all) {
  std::string result;
  for (const auto& each : all)
    if (!each.is_running)
      result += (result.empty() ? "" : ", ") + each.name;
  return result;
}

} // namespace

result check_actors(const facts& seen, const settings&) {
  if (seen.actors.empty())
    return fail("It is not known which parts of the program run; wait until they have started.");
  const auto missing = names_of_missing(seen.actors);
  if (!missing.empty())
    return fail("Parts of the program do not run: " + missing + "; the log says why. Start the program again.");
  if (seen.program.is_exchanged)
    return fail(
        "Another version of the program was installed while this one runs, and a crash in flight would start it. "
        "Start the program again.");
  return pass("All parts of the program run.");
}

result check_camera(const facts& seen, const settings&) {
  switch (seen.camera.state) {
  case camera_state::off:
    return skipped("The camera is off.");
  case camera_state::ready:
    return pass("The camera is ready.");
  case camera_state::not_ready:
    return degraded("The camera is not ready" + (seen.camera.problem.empty() ? "" : ": " + seen.camera.problem) +
                    "; check its cable, power and settings, or fly as it is.");
  case camera_state::unknown:
    break;
  }
  return fail("The camera has not reported yet; wait, or switch it off in the configuration.");
}

} // namespace godwit::executor::preflight
