#include "actors/vehicle_link/transfer/download.hpp"

#include <utility>

namespace godwit::vehicle_link::transfer {

using mavlink::mav_mission_result;

void download::start(step& out, std::int64_t now_ns) {
  started_ns_ = now_ns;
  reader_.start(out, now_ns);
}

void download::on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) {
  reader_.on_count(out, m, now_ns);
  look_at_reader(out, now_ns);
}

void download::on_item(step& out, const mavlink::mission_item_int& m, std::int64_t now_ns) {
  reader_.on_item(out, m, now_ns);
  if (reader_.received() > done_) {
    done_ = reader_.received();
    out.advanced = progress{static_cast<std::uint16_t>(done_), static_cast<std::uint16_t>(reader_.count())};
  }
  look_at_reader(out, now_ns);
}

void download::on_ack(step& /*out*/, const mavlink::mission_ack& m, std::int64_t /*now_ns*/) { reader_.on_ack(m); }

void download::on_time(step& out, std::int64_t now_ns) {
  reader_.on_time(out, now_ns);
  look_at_reader(out, now_ns);
}

void download::cancel(step& out, std::int64_t now_ns) {
  reader_.close(out, mav_mission_result::operation_cancelled);
  finish(out, failed(verdict::cancelled, "it was cancelled"), now_ns);
}

void download::look_at_reader(step& out, std::int64_t now_ns) {
  switch (reader_.now()) {
  case plan_reader::state::listing:
    return;
  case plan_reader::state::reading:
    was_reading_ = true;
    return;
  case plan_reader::state::complete: {
    reader_.close(out, mav_mission_result::accepted);
    auto result = failed(verdict::accepted, {});
    result.proof = reader_.received() < reader_.count() ? proof::plan_id : proof::read_back;
    result.holding = holding::this_plan;
    result.items_on_vehicle = static_cast<std::uint16_t>(reader_.count());
    if (reader_.plan_id() != 0)
      result.plan_id = reader_.plan_id();
    result.items = reader_.take_items();
    finish(out, std::move(result), now_ns);
    return;
  }
  case plan_reader::state::refused: {
    auto result = failed(verdict::refused, sentence_for_mission_result(reader_.refusal()));
    result.result = reader_.refusal();
    finish(out, std::move(result), now_ns);
    return;
  }
  case plan_reader::state::silent:
    finish(out, failed(verdict::timed_out, "the vehicle did not answer"), now_ns);
    return;
  }
}

void download::finish(step& out, outcome what, std::int64_t now_ns) const {
  what.mission_type = who_.mission_type;
  what.duration_ns = now_ns - started_ns_;
  what.effort.requests_sent = reader_.requests_sent();
  out.finished = std::move(what);
}

outcome download::failed(verdict how, std::string reason) const {
  outcome result;
  result.verdict = how;
  result.phase = was_reading_ ? phase::reading : phase::listing;
  result.holding = holding::unchanged;
  result.reason = std::move(reason);
  return result;
}

} // namespace godwit::vehicle_link::transfer
