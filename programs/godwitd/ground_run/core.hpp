// The course of a run on the ground: load the mission, pull its map, take sightings, deliver. Nothing flies here: this
// stands in the place of what flies the mission.
//
//              loaded            map pulled, or not        sightings over        resolved, nothing owed
//   [loading] ───────> [pulling] ────────────────> [seeing] ────────────> [pushing] ──────────────────> [over]
//     │  ^                                            │                      │  ^
//     │  └─ after a minute ─┐                         │ without a service    │  └─ something owed
//     └── refused ──> [refused]                       └──────────────────────┼──────────────────────> [over]
//
// It remembers nothing over a restart and needs nothing: what it begins is said again by every run and counts once, and
// how far mission_client is can be asked. An answer that belongs to an earlier state is passed over; so `resolved` of
// an earlier run does not end this one, and after the right one the store is asked whether all is gone. What a push
// does not move, because the mission was deleted for instance, is not pushed for ever: it is kept, and said. Why a push
// does not get on is asked and said too; a service that does not allow it (401, 403) ends a run that is to end.
//
// Thread: one. Pure: no clock, no I/O.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "messages/mapobjects_store/delivery.hpp"
#include "messages/mission_client/types.hpp"
#include "programs/godwitd/sightings/messages.hpp"

namespace godwit::ground_run {

// What the run on the ground wants done, in this order. Thread: plain values.
struct begin_fetch {}; // tell mission_client to fetch the mission
struct choose {};      // tell the map store which mission it is: there is no mission_client that would
struct look {};        // ask mission_client how far it is
struct see {};         // let the sightings flow
struct push {};        // tell mission_client that the flight is over
struct count_owed {};  // ask the map store whether anything is left
struct begin_later {}; // after retry_after

// For people; a warning asks for a person.
struct announce {
  std::string sentence;
  bool is_warning = false;
};

// The program ends.
struct finish {
  bool well = true;
  std::string why; // a sentence for people; empty when all is well
};

using step = std::variant<begin_fetch, choose, look, see, push, count_owed, begin_later, announce, finish>;
using steps = std::vector<step>;

// Without the network at the start nobody has to come back to the vehicle: the fetch begins anew.
inline constexpr std::chrono::seconds retry_after{60};

// So many different errors of deliveries are remembered as told: each is told once, and not with each try.
inline constexpr std::size_t max_told_errors = 32;

struct settings {
  std::string mission_id;
  bool has_service = true;
  bool has_sightings = false;
  bool once = false; // ends when all is delivered; else only when it is told to
};

using daemon::sighting_counts;

enum class phase { loading, refused, pulling, seeing, pushing, over };

GODWIT_ENUM_NAMES(phase, loading, refused, pulling, seeing, pushing, over);

class core {
public:
  explicit core(settings wanted) : wanted_(std::move(wanted)) {}

  [[nodiscard]] steps on_start();
  [[nodiscard]] steps on_chosen();
  [[nodiscard]] steps on_loaded(const mission_client::mission_loaded& news);
  [[nodiscard]] steps on_refused(const mission_client::mission_refused& news);
  [[nodiscard]] steps on_retry();
  // PULL_S: how long it took; none: it began in an earlier run.
  [[nodiscard]] steps on_pulled(const mission_client::map_pulled& news, std::optional<double> pull_s);
  [[nodiscard]] steps on_status(const mission_client::service_status& now);
  [[nodiscard]] steps on_sightings_over(const sighting_counts& counts);
  [[nodiscard]] steps on_resolved(const mission_client::mission_resolved& news);
  [[nodiscard]] steps on_owed(const mapobjects_store::owed_list& left);
  [[nodiscard]] steps on_deleted(const mission_client::mission_deleted& news);
  // The map can not be written any more.
  [[nodiscard]] steps on_map_broken(const std::string& why);

  [[nodiscard]] phase now() const { return phase_; }

private:
  [[nodiscard]] bool is_mine(const std::string& mission_id) const { return mission_id == wanted_.mission_id; }
  [[nodiscard]] steps go_on_seeing();
  [[nodiscard]] steps look_at_push(const mission_client::service_status& now);
  [[nodiscard]] steps end(finish how);
  [[nodiscard]] steps resolved();

  settings wanted_;
  phase phase_ = phase::loading;
  sighting_counts sightings_;
  mission_client::mission_resolved resolved_;
  std::uint64_t left_on_map_ = 0;        // rows that the store still has for the mission, by its last answer
  std::vector<std::string> told_errors_; // oldest first
};

} // namespace godwit::ground_run
