// Brings the plan of the vehicle to us: plan_reader with an outcome.
//
//   start ──> listing ──> reading ──> accepted, with the items (or with the plan's id alone)
//                └───────────┴──────> refused, timed_out, cancelled
//
// The transfer is always closed with a MISSION_ACK, an empty one too. Thread: one at a time.
#pragma once

#include <cstdint>

#include "actors/vehicle_link/transfer/operation.hpp"
#include "actors/vehicle_link/transfer/plan_reader.hpp"

namespace godwit::vehicle_link::transfer {

class download final : public operation {
public:
  // ID_SUFFICES: of a plan that the vehicle names by an id no items are asked for. LINE outlives it.
  download(bool id_suffices, const parties& who, const peer_profile& peer, round_trip& line)
      : who_(who), reader_(id_suffices ? plan_reader::depth::plan_id : plan_reader::depth::items, who, peer, line) {}

  void start(step& out, std::int64_t now_ns) override;
  void on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) override;
  void on_item(step& out, const mavlink::mission_item_int& m, std::int64_t now_ns) override;
  void on_ack(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) override;
  void on_time(step& out, std::int64_t now_ns) override;
  void cancel(step& out, std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t next_deadline_ns() const override { return reader_.next_deadline_ns(); }

private:
  void look_at_reader(step& out, std::int64_t now_ns);
  void finish(step& out, outcome what, std::int64_t now_ns) const;
  [[nodiscard]] outcome failed(verdict how, std::string reason) const;

  parties who_;
  plan_reader reader_;
  std::int64_t started_ns_ = 0;
  bool was_reading_ = false;
  int done_ = 0; // as told to people
};

} // namespace godwit::vehicle_link::transfer
