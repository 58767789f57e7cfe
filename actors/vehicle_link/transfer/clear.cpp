#include "actors/vehicle_link/transfer/clear.hpp"

#include <utility>

#include "actors/vehicle_link/transfer/answer_wait.hpp"

namespace godwit::vehicle_link::transfer {

namespace {

using mavlink::mav_mission_result;
using mavlink::number;

} // namespace

void clear::start(step& out, std::int64_t now_ns) {
  started_ns_ = attempted_ns_ = now_ns;
  ask(out, now_ns);
}

void clear::ask(step& out, std::int64_t now_ns) {
  asked_ns_ = now_ns;
  ++asked_times_;
  if (how_ == clear_with::mission_clear_all)
    out.messages.emplace_back(who_.addressed(mavlink::mission_clear_all{}));
  else
    out.messages.emplace_back(who_.addressed(mavlink::mission_count{}));
}

void clear::on_ack(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) {
  if (reader_) {
    reader_->on_ack(m);
    return;
  }
  switch (static_cast<mav_mission_result>(m.type)) {
  case mav_mission_result::invalid_sequence:
  case mav_mission_result::operation_cancelled:
    return; // late ones of an upload
  case mav_mission_result::accepted:
    reader_.emplace(plan_reader::depth::count, who_, peer_, line_);
    reader_->start(out, now_ns);
    return;
  case mav_mission_result::error:
  case mav_mission_result::denied:
    busy_ = m.type;
    return;
  default:
    refusal_ = m.type;
  }
}

void clear::on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) {
  if (!reader_)
    return;
  reader_->on_count(out, m, now_ns);
  look_at_reader(out, now_ns);
}

void clear::on_time(step& out, std::int64_t now_ns) {
  if (reader_) {
    reader_->on_time(out, now_ns);
    look_at_reader(out, now_ns);
    return;
  }
  if (now_ns < next_deadline_ns())
    return;
  if (refusal_ != 0)
    refuse(out, refusal_, now_ns);
  else if (now_ns < gives_up_ns() || asked_times_ < min_tries)
    ask_again(out, now_ns);
  else if (busy_ != 0)
    refuse(out, busy_, now_ns);
  else
    finish(out, failed(verdict::timed_out, "the vehicle did not answer"), now_ns);
}

// A vehicle that is busy may be so with a transfer of ours that it takes for open.
void clear::ask_again(step& out, std::int64_t now_ns) {
  if (busy_ != 0 && peer_.obeys_cancel && !has_closed_ours_) {
    has_closed_ours_ = true;
    mavlink::mission_ack cancelled;
    cancelled.type = number(mav_mission_result::operation_cancelled);
    out.messages.emplace_back(who_.addressed(cancelled));
    asked_ns_ = now_ns;
    return;
  }
  has_closed_ours_ = false;
  ask(out, now_ns);
}

void clear::refuse(step& out, std::uint8_t result, std::int64_t now_ns) {
  auto what = failed(verdict::refused, sentence_for_mission_result(result));
  what.result = result;
  what.holding = holding::unchanged;
  finish(out, std::move(what), now_ns);
}

void clear::cancel(step& out, std::int64_t now_ns) {
  if (reader_)
    reader_->close(out, mav_mission_result::operation_cancelled);
  finish(out, failed(verdict::cancelled, "it was cancelled; the vehicle may have cleared the plan"), now_ns);
}

std::int64_t clear::next_deadline_ns() const {
  if (reader_)
    return reader_->next_deadline_ns();
  return asked_ns_ + lengthened(line_.timeout_ns(), asked_times_ - 1, max_wait_ns);
}

void clear::look_at_reader(step& out, std::int64_t now_ns) {
  if (!reader_->is_over())
    return;
  if (reader_->now() != plan_reader::state::complete) {
    finish(out, failed(verdict::timed_out, "the vehicle acknowledged it, but did not report what it holds"), now_ns);
    return;
  }
  reader_->close(out, mav_mission_result::accepted);
  const auto held = reader_->count();
  const bool may_count_home = peer_.first_item_is_home && who_.mission_type == mavlink::mav_mission_type::mission;
  if (held <= (may_count_home ? 1 : 0)) {
    auto result = failed(verdict::accepted, {});
    result.proof = proof::counted;
    result.holding = holding::this_plan;
    result.items_on_vehicle = static_cast<std::uint16_t>(held);
    finish(out, std::move(result), now_ns);
  } else if (attempts_ < max_clear_attempts) {
    ++attempts_;
    reader_.reset();
    asked_times_ = 0;
    attempted_ns_ = now_ns;
    ask(out, now_ns);
  } else {
    auto result = failed(verdict::vehicle_holds_other,
                         "the vehicle acknowledged it, but still holds " + std::to_string(held) + " items");
    result.holding = holding::other;
    result.items_on_vehicle = static_cast<std::uint16_t>(held);
    finish(out, std::move(result), now_ns);
  }
}

void clear::finish(step& out, outcome what, std::int64_t now_ns) const {
  what.mission_type = who_.mission_type;
  what.duration_ns = now_ns - started_ns_;
  what.effort.restarts = static_cast<std::uint32_t>(attempts_ - 1);
  out.finished = std::move(what);
}

outcome clear::failed(verdict how, std::string reason) const {
  outcome result;
  result.verdict = how;
  result.phase = reader_ ? phase::resolving : phase::clearing;
  result.reason = std::move(reason);
  return result;
}

} // namespace godwit::vehicle_link::transfer
