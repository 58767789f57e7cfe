// A flight in virtual time: a vehicle that obeys, the streams that it sends, a ground station, and the failsafe core
// that hears them. Each can fail on demand. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "actors/failsafe/core.hpp"
#include "tests/actors/failsafe/positions.hpp"

namespace godwit::tests {

// Of a multirotor.
inline constexpr failsafe::flight_mode in_mission{failsafe::mode_kind::mission, 3};
inline constexpr failsafe::flight_mode in_hold{failsafe::mode_kind::hold, 17};  // BRAKE, as it is ordered
inline constexpr failsafe::flight_mode in_loiter{failsafe::mode_kind::hold, 5}; // which only a person chooses
inline constexpr failsafe::flight_mode in_return{failsafe::mode_kind::returning, 6};
inline constexpr failsafe::flight_mode in_landing{failsafe::mode_kind::landing, 9};
inline constexpr failsafe::flight_mode in_manual{failsafe::mode_kind::manual, 0};

inline constexpr std::uint16_t landing_sequence = 10;

class flight_world {
public:
  explicit flight_world(failsafe::vehicle_class of = failsafe::vehicle_class::multirotor,
                        const failsafe::settings& configured = {});

  // -- the vehicle and its surroundings, to be changed at will --------------------------------------
  failsafe::vehicle_class type;
  bool armed = true;
  failsafe::landed_state landed = failsafe::landed_state::in_air;
  failsafe::flight_mode mode = in_mission;
  std::uint16_t sequence = 3;
  bool is_complete = false; // the plan
  double east_m = 0;
  double north_m = 0;
  double altitude_m = 50;
  double east_mps = 3; // what is reported; the place changes only where a test says so
  int battery_percent = 80;
  bool sends_heartbeats = true;
  bool sends_positions = true;
  bool sends_battery = true;
  bool sends_sequence = true;
  bool operator_there = true;
  bool port_alive = true;                               // tells of the operator
  bool answers = true;                                  // else a command times out though it was obeyed
  bool hears = true;                                    // else a command is lost and times out
  std::optional<vehicle_link::command_verdict> refuses; // and does not obey
  std::int64_t obeys_after_ms = 40;

  // -- what came of it -------------------------------------------------------------------------------
  std::vector<failsafe::command_vehicle> sent;
  std::vector<failsafe::command_vehicle> obeyed;
  std::vector<failsafe::told_reaction> acted;  // each that was told to begin
  std::vector<failsafe::told_reaction> lifted; // each that ended before the flight did, or gave way to a lower one
  std::vector<failsafe::override_answer> answered;
  std::vector<failsafe::guard_answer> limits_answered;
  std::vector<std::string> warnings;
  std::vector<godwit::runtime::condition> told_health; // each that was told
  int pilots_seen = 0;
  int remembered = 0;
  std::optional<std::int64_t> first_sent_ms;
  bool told_in_air = false; // what the failsafe was told last: armed, and in the air or moving

  // Lets time pass, tick by tick.
  void run_ms(std::int64_t ms);
  void run_s(std::int64_t s) { run_ms(1'000 * s); }
  void tell(const failsafe::event& what);
  void set_fences(const std::vector<mission::geofence>& fences, std::optional<std::uint16_t> land_start = {},
                  const flight::plan_end& end = {});
  void override_for_s(failsafe::rule scope, std::int64_t s);

  // The failsafe crashes and starts with what it had remembered, through its JSON form.
  void restart();
  // The same, and what it gave out in its last KEPT_LESS records never reached the disk.
  void kill(std::size_t kept_less);

  // The mode that an order of this kind names, by the numbers of this vehicle.
  [[nodiscard]] failsafe::flight_mode in(failsafe::mode_kind kind) const;

  [[nodiscard]] failsafe::instant now() const;
  [[nodiscard]] std::int64_t now_ms() const { return ms_; }
  [[nodiscard]] const failsafe::failsafe_status& told() const { return core_->told(); }
  [[nodiscard]] const godwit::runtime::condition& health() const { return core_->health(); }
  [[nodiscard]] const failsafe::state& kept() const { return records_.back(); }
  [[nodiscard]] bool has_warned_of(const std::string& text) const;

private:
  struct arrival {
    std::int64_t at_ms = 0;
    failsafe::command_vehicle what;
  };
  struct answer {
    std::int64_t at_ms = 0;
    failsafe::command_resolved what;
  };

  void speak();
  void obey();
  void take(const failsafe::effects& wanted);
  void handle(const failsafe::command_vehicle& command);
  void handle(const failsafe::failsafe_status_changed& what);
  void handle(const failsafe::override_resolved& what) { answered.push_back(what.answer); }
  void handle(const failsafe::guard_resolved& what) { limits_answered.push_back(what.answer); }
  void handle(const failsafe::warning& what) { warnings.push_back(what.text); }
  void handle(const godwit::runtime::condition& what) { told_health.push_back(what); }
  void handle(const failsafe::remember& written);

  failsafe::settings settings_;
  std::int64_t ms_ = 0;
  std::int64_t heard_ms_ = -1; // the ground station, last
  std::vector<failsafe::state> records_{failsafe::state{}};
  std::optional<failsafe::core> core_;
  failsafe::failsafe_status told_;
  std::deque<arrival> to_vehicle_;
  std::deque<answer> to_core_;
};

} // namespace godwit::tests
