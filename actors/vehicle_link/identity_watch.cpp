#include "actors/vehicle_link/identity_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "actors/domain/geo/geodesic.hpp"
#include "io/time_units.hpp"

namespace godwit::vehicle_link {

namespace {

std::string ids_of(io::mavlink::sender who) { return std::to_string(who.system) + "/" + std::to_string(who.component); }

constexpr const char* remedy =
    ". Give each vehicle a system id of its own (ArduPilot: SYSID_THISMAV or MAV_SYSID, PX4: "
    "MAV_SYS_ID), or take one off the line.";

} // namespace

void identity_watch::on_boot_time(std::uint32_t boot_ms, std::int64_t now_ns) {
  const auto apart = [](const clock& last, const clock& now) -> std::optional<double> {
    const auto ms = std::abs(now.offset_ms - last.offset_ms);
    return ms <= clocks_apart_ms ? std::optional(static_cast<double>(ms)) : std::nullopt;
  };
  clocks_.note({boot_ms - now_ns / ns_per_ms}, now_ns, apart);
}

void identity_watch::on_place(const geo::point& where, std::int64_t now_ns) {
  if (!geo::is_valid(where) || (where.latitude_deg == 0 && where.longitude_deg == 0))
    return;
  const auto apart = [](const geo::point& last, const geo::point& now) -> std::optional<double> {
    const auto metres = geo::distance_m(last, now);
    return metres <= places_apart_m ? std::optional(metres) : std::nullopt;
  };
  places_.note(where, now_ns, apart);
}

// After the newest of a run by a few: one that was sent before it, or the same again, continues it as well.
void identity_watch::on_sequence(std::uint8_t sequence, std::int64_t now_ns) {
  const auto apart = [](std::uint8_t last, std::uint8_t now) -> std::optional<double> {
    const auto ahead = static_cast<std::uint8_t>(now - last);
    const auto steps = std::min<int>(ahead, 256 - ahead);
    return steps <= counts_apart ? std::optional(static_cast<double>(steps)) : std::nullopt;
  };
  counts_.note(sequence, now_ns, apart);
}

std::string identity_watch::twin(io::mavlink::sender name, std::int64_t now_ns) const {
  const auto speak = "Two vehicles speak as " + ids_of(name) + ": ";
  if (clocks_.are_two(now_ns))
    return speak + "their clocks since boot are " +
           std::to_string(std::abs(clocks_.one().offset_ms - clocks_.other().offset_ms) / 1'000) + " s apart" + remedy;
  if (places_.are_two(now_ns))
    return speak + "they are " + std::to_string(std::lround(geo::distance_m(places_.one(), places_.other()))) +
           " m apart" + remedy;
  return {};
}

std::string identity_watch::other_sender(io::mavlink::sender name, std::int64_t now_ns) const {
  if (other_program_ns_ && now_ns - *other_program_ns_ < lasts_ns)
    return "another program speaks as " + ids_of(name) +
           " and is no autopilot (MAV_AUTOPILOT_INVALID); its heartbeats are passed over: give it a component id of "
           "its "
           "own";
  if (counts_.are_two(now_ns))
    return "two senders number their frames as " + ids_of(name) +
           ": another program, a second vehicle, or two ways of one; it is not the radio";
  return {};
}

} // namespace godwit::vehicle_link
