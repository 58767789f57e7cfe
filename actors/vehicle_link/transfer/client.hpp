// The mission transfer client: one upload, download or clear at a time, with one vehicle.
//
// It is given each message of the vehicle (the caller has looked at who sent it) and the time, and says what to send
// and what has become of the transfer. Messages for others, for another mission type, and those that come when nothing
// is going on are ignored and counted; a vehicle that still asks after a cancel is told again, max_cancel_repeats
// times. Call on_time no later than next_deadline_ns. What was learned of the line's round trip stays for the next
// transfer. Errors: all end as an outcome. Pure: no clock, no I/O. Thread: one at a time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "actors/vehicle_link/transfer/operation.hpp"
#include "actors/vehicle_link/transfer/peer_profile.hpp"
#include "actors/vehicle_link/transfer/round_trip.hpp"
#include "actors/vehicle_link/transfer/step.hpp"
#include "actors/vehicle_link/transfer/upload.hpp"
#include "io/mavlink/messages/mission.hpp"

namespace godwit::vehicle_link::transfer {

// PX4 asks for 5 s, four times a second; a few answers suffice to reach it over a bad line.
inline constexpr int max_cancel_repeats = 5;

// A vehicle that still asks for items of another type of plan, of an upload whose sender has died, may hear nothing
// else meanwhile: it is told that this one is cancelled. Not before its late frames are gone, and only as long as it
// has asked for nothing of the transfer that runs: a PX4 takes a cancel for any of them.
inline constexpr std::int64_t other_is_stale_ns = 1'000 * ns_per_ms;

// Nothing of an upload or a clear, and nothing that the vehicle said to it, is on the line so long after it has ended.
// The next upload of the same type does not begin sooner: no number in the protocol tells the frames of two of them
// apart.
inline constexpr std::int64_t frames_stay_ns = 1'000 * ns_per_ms;

class client {
public:
  // SINCE_NS: whoever spoke for OURSELVES until then may have left an upload open.
  client(mavlink::sender ourselves, mavlink::sender peer, const peer_profile& profile, std::int64_t since_ns);
  client(const client&) = delete; // what runs looks into it
  client& operator=(const client&) = delete;
  ~client() = default;

  // Only while is_idle(). PLAN is sent as given, numbered from 0: whoever wants home as item 0 puts it there. No items:
  // the plan is cleared. More than plan_reader::max_items: refused here.
  [[nodiscard]] step upload(mavlink::mav_mission_type type, std::vector<mavlink::mission_item_int> plan,
                            std::int64_t now_ns);
  // ID_SUFFICES: no items are asked for where the vehicle names its plan by an id.
  [[nodiscard]] step download(mavlink::mav_mission_type type, std::int64_t now_ns, bool id_suffices = false);
  [[nodiscard]] step clear(mavlink::mav_mission_type type, std::int64_t now_ns);
  // Nothing happens when is_idle().
  [[nodiscard]] step cancel(std::int64_t now_ns);

  [[nodiscard]] step on(const mavlink::mission_request_int& m, std::int64_t now_ns);
  [[nodiscard]] step on(const mavlink::mission_request& m, std::int64_t now_ns);
  [[nodiscard]] step on(const mavlink::mission_count& m, std::int64_t now_ns);
  [[nodiscard]] step on(const mavlink::mission_item_int& m, std::int64_t now_ns);
  [[nodiscard]] step on(const mavlink::mission_ack& m, std::int64_t now_ns);
  [[nodiscard]] step on(const mavlink::mission_current& m, std::int64_t now_ns);
  [[nodiscard]] step on_time(std::int64_t now_ns);

  [[nodiscard]] bool is_idle() const { return running_ == nullptr; }
  [[nodiscard]] std::optional<std::int64_t> next_deadline_ns() const;
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

private:
  template <class M>
  [[nodiscard]] bool concerns_running(const M& m);
  template <class M>
  [[nodiscard]] step on_any_request(const M& m, std::int64_t now_ns);
  template <class M>
  [[nodiscard]] bool is_stale(const M& m, std::int64_t now_ns) const;
  [[nodiscard]] parties with(mavlink::mav_mission_type type) const { return {ourselves_, peer_, type}; }
  [[nodiscard]] step begin(const parties& who, std::unique_ptr<operation> what, std::int64_t now_ns);
  void end_if_finished(const step& out, std::int64_t now_ns);

  mavlink::sender ourselves_;
  mavlink::sender peer_;
  peer_profile profile_;
  round_trip line_;
  parties who_; // of the running or the last transfer
  std::unique_ptr<operation> running_;
  int cancel_repeats_left_ = 0;
  int stale_cancels_left_ = 0;
  std::int64_t began_ns_ = 0; // the running or the last transfer
  bool is_answered_ = false;  // by a request
  bool keeps_plan_ids_;
  std::array<earlier_upload, 3> before_; // by type
  std::uint64_t ignored_ = 0;
};

} // namespace godwit::vehicle_link::transfer
