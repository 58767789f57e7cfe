// Brings a plan to the vehicle, and finds out whether it is there.
//
//                       request(0)                    ACK accepted, first and last item asked for
//   start ──> announcing ────────> sending ─────────────────────────────────────────────────> accepted
//               │  ^                │   ^ │                                                      ^
//               │  └────restart─────┘   │ └─ACK accepted, last request not seen ──> resolving ────┤ counts
//               │  ^                    │ └─last item sent again: no clear answer ─> resolving ───┘ reads back
//               │  │                    └──────── the vehicle still asks ────────────┘ │
//               │  └──────────────────────────── it holds another plan ────────────────┘
//               └──> refused, timed_out (from any state), vehicle_holds_other
//
// *Announcing.* MISSION_COUNT is sent until the vehicle asks for item 0. To profiles that allow it the first window
// follows at once. A request for a later item shows that requests come, but not that the vehicle has begun with this
// plan: a transfer that was cut off, by us or by an earlier life of ours, may still be open, and items of both plans
// would be mixed. So only a request for 0 counts. But an ArduPilot that gets item 0 ahead of its first request never
// asks for it: where the first window went along, a later request counts, and where a transfer may have been open the
// plan is read back in the end. ERROR and DENIED mean that the vehicle is busy: it is asked for as long as its
// patience; where cancel is obeyed it is sent as well, for it may be busy with a transfer of ours.
//
// *Sending.* item_flow decides what goes out. Each kind of MISSION_ACK:
//   accepted           before all was sent: a late one of an earlier transfer, ignored
//   invalid_sequence   counted; the wanted item may be lost
//   error              counted: it may be for something that came late or twice. When there is no progress after it,
//                      the vehicle is not in a transfer any more: resolve when all was sent, else restart
//   cancelled          the vehicle has given up: restart
//   any other          a refusal. It is believed when no request follows for a round trip, for it may be late as well
//
// *Settling.* Whether the vehicle has the plan is asked and not guessed. An ACK without a request for the last item
// could be one of a shorter plan that was still open: the count tells. No ACK at all: a new plan id with the right
// count tells while no other station can have brought it; else the plan is read back and compared by meaning. ArduPilot
// answers a repeated last item with ERROR although the plan is stored. If it holds something else, the upload begins
// again.
//
// Time: silence for the patience of the profile means that the vehicle must have given up; then the upload begins again
// with MISSION_COUNT, at most max_restarts times. So does a vehicle that speaks and never gets further for three times
// as long. Cancel answers at once and sends nothing more.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "actors/vehicle_link/transfer/item_flow.hpp"
#include "actors/vehicle_link/transfer/operation.hpp"
#include "actors/vehicle_link/transfer/plan_reader.hpp"

namespace godwit::vehicle_link::transfer {

// A vehicle that restarts in the middle of a transfer needs one; each costs at most its patience twice.
inline constexpr int max_restarts = 3;

// All has been sent, and so many times there was no answer: the vehicle is asked what it holds. One that acknowledges
// the last item again is asked by that, which costs a round trip; reading a thousand items back costs a minute.
[[nodiscard]] constexpr int silences_before_resolving(const peer_profile& peer) {
  return peer.acknowledges_last_again ? 10 : 3;
}

// A vehicle that answers without ever getting further is left after so many times its patience.
inline constexpr int patience_without_progress = 3;

// What is left of an earlier upload of the same type: no protocol number tells its items and its requests from ours.
struct earlier_upload {
  std::int64_t on_line_until_ns = 0; // its items
  std::int64_t open_until_ns = 0;    // at the latest, in the vehicle
};

class upload final : public operation {
public:
  // PLAN has 1 to plan_reader::max_items items. Nothing is sent while items of BEFORE may be on the line. LINE outlives
  // it.
  upload(std::vector<mavlink::mission_item_int> plan, const earlier_upload& before, const parties& who,
         const peer_profile& peer, round_trip& line);

  void start(step& out, std::int64_t now_ns) override;
  void on_request(step& out, std::uint16_t item, std::int64_t now_ns) override;
  void on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) override;
  void on_item(step& out, const mavlink::mission_item_int& m, std::int64_t now_ns) override;
  void on_ack(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) override;
  void on_plan_id(step& out, std::uint32_t plan_id, std::optional<int> count, std::int64_t now_ns) override;
  void on_time(step& out, std::int64_t now_ns) override;
  void cancel(step& out, std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t next_deadline_ns() const override;
  [[nodiscard]] bool wants_cancel_repeated() const override { return peer_.obeys_cancel; }

private:
  struct refusal {
    std::uint8_t result = 0;
    std::int64_t believed_ns = 0;
  };

  void announce(step& out, std::int64_t now_ns);
  void send_items(step& out, std::int64_t now_ns);
  void restart_or(step& out, outcome otherwise, std::int64_t now_ns);
  void resolve(step& out, plan_reader::depth how, std::int64_t now_ns);
  void resume_sending(step& out, std::int64_t now_ns);
  void look_at_reader(step& out, std::int64_t now_ns);
  void compare_with_held(step& out, std::int64_t now_ns);

  void on_request_announcing(step& out, int item, std::int64_t now_ns);
  void on_request_sending(step& out, int item, std::int64_t now_ns);
  void on_ack_announcing(step& out, const mavlink::mission_ack& m, std::int64_t now_ns);
  void on_ack_sending(step& out, const mavlink::mission_ack& m, std::int64_t now_ns);
  void on_ack_resolving(step& out, const mavlink::mission_ack& m, std::int64_t now_ns);
  void on_busy(step& out, std::uint8_t result);
  void send_cancel(step& out) const;
  void on_error_sending(step& out, std::int64_t now_ns);
  void on_given_up(step& out, std::int64_t now_ns);

  void accept(step& out, proof how, std::uint32_t plan_id, std::int64_t now_ns);
  void refuse(step& out, std::uint8_t result, std::int64_t now_ns);
  void finish(step& out, outcome what, std::int64_t now_ns) const;
  [[nodiscard]] outcome failed(verdict how, std::string reason) const;
  [[nodiscard]] outcome refused(std::uint8_t result) const;
  [[nodiscard]] bool may_be_complete() const { return was_complete_before_ || flow_.is_all_sent(); }
  [[nodiscard]] bool may_have_begun() const;
  [[nodiscard]] bool may_have_taken_first_item() const;
  [[nodiscard]] bool has_begun_with_ours() const { return is_first_asked_for_ || was_none_open_; }
  [[nodiscard]] bool is_id_of_ours(std::uint32_t plan_id, std::int64_t now_ns) const;
  [[nodiscard]] std::int64_t gives_up_ns() const;
  [[nodiscard]] std::int64_t announces_next_ns() const;
  [[nodiscard]] int size() const { return static_cast<int>(plan_.size()); }

  std::vector<mavlink::mission_item_int> plan_;
  parties who_;
  peer_profile peer_;
  round_trip& line_;
  item_flow flow_;
  phase phase_ = phase::announcing;

  earlier_upload before_;
  std::int64_t started_ns_ = 0;
  std::int64_t heard_ns_ = 0;           // of the vehicle, or this attempt's beginning
  std::int64_t progress_ns_ = 0;        // or this attempt's beginning
  std::int64_t first_announced_ns_ = 0; // of this attempt
  std::int64_t announced_ns_ = 0;
  int announcements_ = 0;                    // of this attempt
  bool items_went_along_ = false;            // with the first of them
  bool was_none_open_ = false;               // of ours, as the first of them was sent
  bool is_first_asked_for_ = false;          // in this attempt
  bool has_closed_ours_ = false;             // since the last of them
  std::optional<std::uint8_t> busy_;         // what a vehicle that is busy has said
  std::optional<refusal> refusal_;           // not yet believed
  int errors_ = 0;                           // since the last progress
  bool has_begun_ = false;                   // the vehicle has asked for an item of ours, in some attempt
  bool was_complete_before_ = false;         // all was sent in an earlier attempt
  int done_ = 0;                             // as told to people
  std::optional<plan_reader> reader_;        // while resolving
  plan_reader::depth depth_{};               // of it
  std::optional<std::uint32_t> old_plan_id_; // as told while the vehicle took our plan, in this attempt
  std::uint32_t acknowledged_id_ = 0;        // by the ACK that is being resolved
  std::optional<outcome> decided_;           // only what the vehicle holds is still asked
  effort effort_;
};

} // namespace godwit::vehicle_link::transfer
