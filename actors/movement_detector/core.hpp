// All that is decided about the eyes: when their process is started, what it is told, and what becomes of what it says.
//
//   resting ──its wait is over──> starting ──a status──> running
//      └────────────<──silent, garbage, gone──┴──────────────┘
//
// The helper is restarted for ever, with a wait that doubles: what it sees is worth having at any time of a flight, and
// a camera may come back. What it says is believed only as far as it is sound. Nothing here knows of the flight more
// than what is flown, and nothing that comes of it moves the vehicle. Pure: time and seed come in. Thread: one owner.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "actors/movement_detector/camera_attitude.hpp"
#include "actors/movement_detector/settings.hpp"
#include "io/eyes/messages.hpp"
#include "io/mavlink/messages/gimbal.hpp"
#include "io/mavlink/messages/position.hpp"
#include "io/time_units.hpp"
#include "messages/mapobjects_store/observation.hpp"
#include "messages/movement_detector/types.hpp"
#include "messages/scan_controller/view.hpp"
#include "runtime/condition.hpp"

namespace godwit::movement_detector {

struct start_helper {
  std::uint32_t run = 0;
  io::eyes::begin how;
};
struct end_helper {
  std::uint32_t upto = 0; // the number of its run
};
struct keep_picture {
  std::uint32_t track = 0;
  std::int64_t captured_ns = 0;
  std::string sighting_id;
};
struct announce {
  std::string sentence;
  bool is_warning = false;
};

using effect = std::variant<start_helper, end_helper, io::eyes::pose, keep_picture, mapobjects_store::sighting,
                            scan_controller::view, announce>;
using effects = std::vector<effect>;

class core {
public:
  static constexpr std::int64_t first_word_ns = 5'000'000'000; // a program that loads sixty libraries from a card
  static constexpr std::int64_t silence_ns = 2'000'000'000;    // it says how it is each half second
  static constexpr std::int64_t first_wait_ns = 250'000'000;
  static constexpr std::int64_t longest_wait_ns = 5'000'000'000;
  static constexpr std::int64_t sound_after_ns = 30'000'000'000; // then the wait begins anew
  static constexpr std::int64_t view_period_ns = 500'000'000;
  static constexpr std::int64_t view_lasts_ns = 2'000'000'000; // pictures of a turn may say nothing
  static constexpr std::int64_t unusable_told_ns = 5'000'000'000;
  static constexpr std::int64_t telemetry_lasts_ns = 2'000'000'000;
  static constexpr std::int64_t heading_lasts_ns = 500'000'000; // carried on by the rate of its turn
  static constexpr std::int64_t gimbal_gap_ns = 600'000'000;    // a turn over longer is no rate: gimbals say 5 a second
  static constexpr std::int64_t same_track_ns = 2'000'000'000;  // one sighting of a track in so long
  static constexpr std::size_t max_tracks = 256;                // that are remembered for it
  static constexpr std::size_t max_sightings_a_second = 10;

  static constexpr std::uint32_t runs_of_incarnation = 1
                                                       << 16; // their numbers; more wrap, a week of nothing but crashes

  // SEED: another number in each process; ids of sightings are made with it. INCARNATION: rises.
  core(settings configured, std::uint64_t seed, std::uint64_t incarnation);

  [[nodiscard]] std::uint32_t run() const { return run_; }

  [[nodiscard]] effects on_attitude(const io::mavlink::attitude& m, instant now);
  // How the camera lies, where it hangs on a gimbal; that of the vehicle then only gives the heading.
  [[nodiscard]] effects on_gimbal(const io::mavlink::gimbal_device_attitude_status& m, instant now);
  void on_position(const io::mavlink::global_position_int& m, instant now);
  void on_survey(const scan_controller::survey_progress& seen) { survey_ = seen; }
  [[nodiscard]] effects on_status(const helper_status& m, instant now);
  [[nodiscard]] effects on_candidates(const helper_candidates& m, instant now);
  [[nodiscard]] effects on_ended(const helper_ended& m, instant now);
  [[nodiscard]] effects on_time(instant now);
  [[nodiscard]] std::int64_t next_due_ns() const;

  [[nodiscard]] runtime::condition health(instant now) const;
  [[nodiscard]] eyes_view view_of(instant now) const;

private:
  enum class helper_state { starting, running, resting };

  [[nodiscard]] effects start(instant now);
  [[nodiscard]] effects pose_of(const rotation& camera, const std::array<double, 3>& rate, instant now) const;
  [[nodiscard]] std::optional<double> heading(instant now) const;
  [[nodiscard]] effects rest(const std::string& why, bool is_running, instant now);
  [[nodiscard]] bool is_seeing(instant now) const;
  [[nodiscard]] std::string sentence(instant now) const; // what is missing; empty: nothing
  [[nodiscard]] std::string sentence_of_pictures(instant now) const;
  [[nodiscard]] bool has_room_for(const io::eyes::candidate& seen, instant now);
  [[nodiscard]] std::optional<mapobjects_store::sighting> sighting_of(const io::eyes::candidate& seen,
                                                                      std::int64_t captured_ns, instant now);

  settings settings_;
  std::uint64_t seed_;
  rotation mount_;

  helper_state state_ = helper_state::resting;
  std::uint32_t run_;
  std::int64_t due_ns_ = 0; // of the state: the next word, or the next start; at first at once
  std::int64_t started_ns_ = 0;
  std::int64_t wait_ns_ = first_wait_ns;
  std::string gone_; // why the last run ended; empty: none has, or it is over
  std::int64_t next_view_ns_ = 0;
  std::optional<io::eyes::status> status_; // of this run
  std::int64_t sound_ns_ = 0;              // when the pictures were last of use, or it began

  std::optional<io::mavlink::global_position_int> position_;
  std::int64_t position_ns_ = 0;
  std::int64_t attitude_ns_ = 0; // of the camera: when the vehicle or the gimbal told the last one
  struct heading_told {
    io::mavlink::attitude what;
    std::int64_t at_ns = 0;
  };
  std::optional<heading_told> vehicle_; // only with a gimbal
  struct gimbal_told {
    rotation camera;
    std::int64_t at_ns = 0;
  };
  std::optional<gimbal_told> gimbal_;
  std::optional<scan_controller::survey_progress> survey_;

  struct track_told {
    std::int64_t at_ns = 0; // the last time
    std::string class_group;
  };
  std::map<std::uint32_t, track_told> told_; // to the map, of the tracks of this run
  std::int64_t second_ns_ = 0;               // in which these were said
  std::size_t in_second_ = 0;
  std::uint64_t starts_ = 0;
  std::uint64_t candidates_ = 0;
  std::uint64_t sightings_ = 0;
  std::uint64_t without_place_ = 0;
};

} // namespace godwit::movement_detector
