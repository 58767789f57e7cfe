// Whether the camera gives pictures, tried on the ground: for the preflight check, which says it before the flight.
//
//   idle ──due──> trying ──a picture was looked at──> idle: ready (not with a broken model), again after
//                   │                                 `ready_lasts_ns`
//                   └──none within `patience_ns`, or the helper ends──> not ready, and it goes on trying
//
// A helper process of its own opens the camera, and lets go of it when a picture was looked at. In flight nothing is
// tried: the camera is movement_detector's. Nothing here blocks. Thread: any.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "actors/executor/preflight/facts.hpp"
#include "io/eyes/messages.hpp"

namespace godwit::daemon {

class camera_trial {
public:
  static constexpr std::int64_t patience_ns = 8'000'000'000; // RTSP asks three times and waits for a key frame
  static constexpr std::int64_t retry_ns = 5'000'000'000;    // after a helper that has ended
  static constexpr std::int64_t ready_lasts_ns = 60'000'000'000;

  // What starts and ends a run of the helper; called by who looks, and must not block.
  struct helper_calls {
    std::function<void(std::uint32_t run)> start;
    std::function<void(std::uint32_t upto)> end;
  };
  explicit camera_trial(helper_calls helper) : helper_(std::move(helper)) {}

  // What is known now, as often as somebody wants to know; begins and ends what is due.
  [[nodiscard]] executor::preflight::camera_fact look(std::int64_t now_ns);
  // Until it is told otherwise, there is a flight.
  void set_in_flight(bool is_in_flight);

  // From the helper.
  void on_message(std::uint32_t run, const io::eyes::message& said);
  void on_end(std::uint32_t run, const std::string& why);

private:
  void begin(std::int64_t now_ns);
  void judge(std::int64_t now_ns);
  void finish(std::int64_t next_ns);

  helper_calls helper_;
  std::mutex mutex_; // over what follows
  executor::preflight::camera_fact known_{executor::preflight::camera_state::unknown, {}};
  bool is_in_flight_ = true;
  bool is_trying_ = false;
  std::uint32_t run_ = 0;
  std::int64_t began_ns_ = 0;
  std::int64_t due_ns_ = 0;
  std::optional<io::eyes::status> status_; // of this run
  std::optional<std::string> ended_;       // the same
};

} // namespace godwit::daemon
