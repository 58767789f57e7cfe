// Reads the plan that a vehicle holds: the download without what is done with it.
//
//   listing ──MISSION_COUNT──> reading ──all items──> complete
//      │ ^        │ └─ count is enough, or 0 ───────────^
//      │ └────────┘ no item comes, at most max_listings
//      ├──MISSION_ACK with an error──> refused          (reading too)
//      └──silence longer than the vehicle's patience──> silent   (reading too)
//
// Items are asked for in a window: one for most vehicles; many at once for ArduPilot, which serves any item at any
// time. What does not come within a usual round trip is asked for again, each item on its own: what came after a gap
// is kept. When no item comes at all the vehicle may have closed the transfer (a late MISSION_ACK of the one before
// does that), and it begins again. A refusal is believed when nothing else follows it for a round trip, since it may be
// a late one of an earlier transfer. A vehicle that is busy (ERROR, DENIED) is asked again for as long as its patience,
// for the other transfer ends by then. Bounds: max_items, and for silence and busyness the patience in the profile.
// Whoever used it closes it with close(): PX4 counts the transfer as open for 5 s otherwise, an empty one too.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/vehicle_link/transfer/go_ahead_window.hpp"
#include "actors/vehicle_link/transfer/pace.hpp"
#include "actors/vehicle_link/transfer/parties.hpp"
#include "actors/vehicle_link/transfer/peer_profile.hpp"
#include "actors/vehicle_link/transfer/round_trip.hpp"
#include "actors/vehicle_link/transfer/step.hpp"

namespace godwit::vehicle_link::transfer {

class plan_reader {
public:
  enum class depth { count, plan_id, items }; // plan_id: the items of a plan without one
  enum class state { listing, reading, complete, refused, silent };

  // What a sequence number can count. 3 MB of items.
  static constexpr int max_items = 65'535;

  static constexpr int max_listings = 3;
  static constexpr int silences_before_listing = 4;

  // LINE outlives it.
  plan_reader(depth how, const parties& who, const peer_profile& peer, round_trip& line);

  void start(step& out, std::int64_t now_ns);
  void on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns);
  void on_item(step& out, const mavlink::mission_item_int& m, std::int64_t now_ns);
  void on_ack(const mavlink::mission_ack& m);
  void on_time(step& out, std::int64_t now_ns);
  void close(step& out, mavlink::mav_mission_result result) const;

  [[nodiscard]] std::int64_t next_deadline_ns() const;

  [[nodiscard]] state now() const { return state_; }
  [[nodiscard]] bool is_over() const { return state_ != state::listing && state_ != state::reading; }
  [[nodiscard]] int count() const { return count_; }       // from `reading` on
  [[nodiscard]] int received() const { return received_; } // items
  [[nodiscard]] std::uint32_t plan_id() const { return plan_id_; }
  [[nodiscard]] std::uint8_t refusal() const { return refusal_; }
  [[nodiscard]] const std::vector<mavlink::mission_item_int>& items() const { return items_; } // when complete
  [[nodiscard]] std::vector<mavlink::mission_item_int> take_items() { return std::move(items_); }
  [[nodiscard]] std::uint32_t requests_sent() const { return requests_sent_; }

private:
  struct asking {
    std::int64_t last_ns = 0;
    int times = 0;
    bool has_come = false;
  };

  void begin_listing(step& out, std::int64_t now_ns);
  void ask_for_list(step& out, std::int64_t now_ns);
  void ask_for_item(step& out, int index, std::int64_t now_ns);
  void ask_ahead(step& out, std::int64_t now_ns);
  void ask_again_before(step& out, int end, std::int64_t now_ns);
  void take_sample(std::int64_t round_trip_ns);
  void note_progress(std::int64_t now_ns);
  [[nodiscard]] bool is_overdue(int index, std::int64_t now_ns) const; // between usual and too long
  [[nodiscard]] std::int64_t gives_up_ns() const;

  depth depth_;
  parties who_;
  peer_profile peer_;
  round_trip& line_;
  go_ahead_window window_;
  pace answers_;
  state state_ = state::listing;
  int count_ = 0;
  int received_ = 0;
  int missing_ = 0; // the first item that has not come
  int next_ = 0;    // the first that was never asked for
  std::vector<mavlink::mission_item_int> items_;
  std::vector<asking> askings_; // by item
  std::int64_t list_asked_ns_ = 0;
  int list_asked_times_ = 0; // since `listing` began
  int listings_ = 0;         // how often it began
  int silences_ = 0;
  std::int64_t last_progress_ns_ = 0;
  std::uint32_t plan_id_ = 0;
  std::uint8_t refusal_ = 0; // since the last progress
  std::uint32_t requests_sent_ = 0;
};

} // namespace godwit::vehicle_link::transfer
