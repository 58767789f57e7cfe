// What the vehicle says of itself, as far as the flight depends on it. Nothing of it is durable: after a restart it is
// heard again. Times: monotonic nanoseconds. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "actors/domain/flight_mode/flight_modes.hpp"
#include "actors/domain/geo/point.hpp"
#include "actors/domain/mission/commands/command_table.hpp"
#include "actors/domain/vehicle_text/text_assembler.hpp"
#include "actors/executor/plan/setting.hpp"
#include "actors/executor/preflight/facts.hpp"
#include "io/mavlink/enums/mission.hpp"
#include "io/mavlink/enums/vehicle.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/heartbeat.hpp"
#include "messages/vehicle_link/connection.hpp"

namespace godwit::executor {

// Positions that are older say nothing any more.
inline constexpr std::int64_t position_counts_ns = 3'000'000'000;

// An estimator's report comes once a second; a vehicle of which none has come for so long does not tell.
inline constexpr std::int64_t estimate_counts_ns = 10'000'000'000;

// ArduPilot says each 30 s what keeps it from being armed.
inline constexpr std::int64_t words_count_ns = 35'000'000'000;

class vehicle_view {
public:
  static constexpr double standing_mps = 0.2; // over the ground

  void take(const vehicle_link::connection_changed& m);
  void take(const vehicle_link::line_findings& m) { line_ = m; }
  void take(const io::mavlink::heartbeat& m, std::int64_t now_ns);
  // Of a vehicle whose heartbeat was heard: the newer of the two says the mode.
  void take(const io::mavlink::current_mode& m);
  void take(const io::mavlink::sys_status& m);
  void take(const io::mavlink::gps_raw_int& m);
  void take(const io::mavlink::global_position_int& m, std::int64_t now_ns);
  void take(const io::mavlink::home_position& m, std::int64_t now_ns);
  void take(const io::mavlink::extended_sys_state& m);
  void take(const io::mavlink::mission_current& m, std::int64_t now_ns);
  void take(const io::mavlink::ekf_status_report& m, std::int64_t now_ns) { take_estimate(m.flags, now_ns); }
  void take(const io::mavlink::estimator_status& m, std::int64_t now_ns) { take_estimate(m.flags, now_ns); }
  void take(const flight::vehicle_message& m, std::int64_t now_ns); // a whole text

  [[nodiscard]] bool is_connected() const { return phase_ == vehicle_link::connection_phase::connected; }
  [[nodiscard]] vehicle_link::connection_phase link() const { return phase_; }
  [[nodiscard]] const std::string& why_not_connected() const { return reason_; }
  [[nodiscard]] const vehicle_link::line_findings& line() const { return line_; }
  // Since the link was up last: none before the first heartbeat.
  [[nodiscard]] const std::optional<flight::flight_mode>& mode() const { return mode_; }
  [[nodiscard]] bool is_in(flight::mode_kind kind) const { return mode_ && mode_->kind == kind; }
  [[nodiscard]] bool is_in_one_of(const std::vector<std::uint32_t>& modes) const;
  // In a mode that obeys an order of this kind: the exact one that is ordered.
  [[nodiscard]] bool obeys(flight::mode_kind kind) const;
  // The autopilot says of itself that something is wrong (MAV_STATE_CRITICAL).
  [[nodiscard]] bool is_critical() const { return is_critical_; }
  [[nodiscard]] std::uint64_t heartbeats() const { return heartbeats_; }
  [[nodiscard]] const flight::mode_owner& owner() const { return owner_; }
  // By which the table of commands knows it; none: another autopilot, or not known yet.
  [[nodiscard]] std::optional<mission::vehicle_profile> profile() const;
  [[nodiscard]] bool is_armed() const { return is_armed_; }
  // Not moving, as far as it was heard.
  [[nodiscard]] bool stands() const { return speed_mps_ <= standing_mps; }
  // The same, within a few metres of its home.
  [[nodiscard]] bool stands_at_home(std::int64_t now_ns) const;
  // Armed and off the ground; a rover: armed.
  [[nodiscard]] bool is_under_way() const;
  // It moves, or would by itself: a rover that is armed in HOLD does not.
  [[nodiscard]] bool is_moving() const;
  // On the ground or standing, within so many metres of there.
  [[nodiscard]] bool is_within(double metres, const geo::point& there, std::int64_t now_ns) const;
  // In its mission mode, and says itself that the mission has begun.
  [[nodiscard]] bool is_in_begun_mission() const;
  // Where it stands is known well enough to judge by it.
  [[nodiscard]] bool is_seen() const;
  // It has told since it is heard whether it stands on the ground.
  [[nodiscard]] bool knows_ground() const;
  // PX4 does, and who has told one.
  [[nodiscard]] bool keeps_plan_ids() const {
    return owner_.autopilot == io::mavlink::mav_autopilot::px4 || (current_ && current_->mission_id != 0);
  }

  [[nodiscard]] std::optional<mission::position> place(std::int64_t now_ns) const;
  [[nodiscard]] const std::optional<plan::vehicle_home>& home() const { return home_; }
  [[nodiscard]] std::int64_t home_heard_ns() const { return home_heard_ns_; }
  [[nodiscard]] const std::optional<io::mavlink::mission_current>& current() const { return current_; }
  // MISSION_CURRENT says so; false before it was heard.
  [[nodiscard]] bool says_complete() const;
  [[nodiscard]] bool says_incomplete() const;
  // A PX4 that has checked the plan that it holds: it has an id and items, and is no mission.
  [[nodiscard]] bool finds_infeasible() const;
  [[nodiscard]] std::int64_t current_heard_ns() const { return current_heard_ns_; }
  [[nodiscard]] const std::optional<std::int32_t>& battery_percent() const { return battery_percent_; }
  [[nodiscard]] std::uint8_t fix_type() const { return fix_type_; }
  [[nodiscard]] int satellites() const { return satellites_; }
  [[nodiscard]] preflight::own_checks own_checks() const { return own_checks_; }
  [[nodiscard]] preflight::estimate estimate(std::int64_t now_ns) const;
  // In its own words; empty: it has said nothing of the kind of late.
  [[nodiscard]] std::string why_not_armed(std::int64_t now_ns) const;
  // What it has warned of last; empty: of nothing since then.
  [[nodiscard]] std::string warned_since(std::int64_t ns) const;
  [[nodiscard]] std::int64_t heartbeat_ns() const { return heartbeat_ns_; } // when the newest came
  // When it was heard again after the newest silence in which somebody else may have armed it; 0: there was none.
  [[nodiscard]] std::int64_t unbroken_since_ns() const { return unbroken_since_ns_; }
  [[nodiscard]] std::int64_t place_heard_ns() const { return place_heard_ns_; }

private:
  [[nodiscard]] bool says(io::mavlink::mission_state what) const;

  struct said {
    std::string what;
    std::int64_t at_ns = 0;
  };
  struct estimated {
    preflight::estimate what{};
    std::int64_t at_ns = 0;
  };

  void take_estimate(std::uint16_t flags, std::int64_t now_ns);

  vehicle_link::connection_phase phase_ = vehicle_link::connection_phase::down;
  std::string reason_;
  vehicle_link::line_findings line_;
  std::optional<flight::flight_mode> mode_;
  std::int64_t heartbeat_ns_ = 0;
  std::int64_t unbroken_since_ns_ = 0;
  flight::mode_owner owner_;
  bool is_plain_wing_ = false; // of what has wings: it does not take off vertically
  bool is_armed_ = false;
  bool is_critical_ = false;
  std::uint64_t heartbeats_ = 0;
  io::mavlink::mav_landed_state landed_ = io::mavlink::mav_landed_state::undefined;
  bool is_ground_told_ = false; // since it is heard
  std::optional<mission::position> place_;
  double speed_mps_ = 0; // over the ground
  std::int64_t place_heard_ns_ = 0;
  std::optional<plan::vehicle_home> home_;
  std::int64_t home_heard_ns_ = 0;
  std::optional<io::mavlink::mission_current> current_;
  std::int64_t current_heard_ns_ = 0;
  std::optional<std::int32_t> battery_percent_;
  std::uint8_t fix_type_ = 0;
  int satellites_ = -1;
  preflight::own_checks own_checks_ = preflight::own_checks::unknown;
  std::int64_t heard_since_ns_ = 0; // the first heartbeat since the link was up last
  std::optional<estimated> estimate_;
  std::optional<said> why_not_armed_;
  std::optional<said> warned_;
};

} // namespace godwit::executor
