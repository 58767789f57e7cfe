// How an upload ends, and what is then known of the plan that the vehicle holds.
#include <utility>

#include "actors/vehicle_link/transfer/upload.hpp"

namespace godwit::vehicle_link::transfer {

namespace {

// Of what is known of the vehicle's patience: the margin that the profile adds to it, and the way of the messages.
constexpr std::int64_t patience_doubt_ns = 1'000 * ns_per_ms;

} // namespace

void upload::accept(step& out, proof how, std::uint32_t plan_id, std::int64_t now_ns) {
  outcome result;
  result.verdict = verdict::accepted;
  result.phase = phase_;
  result.proof = how;
  result.holding = holding::this_plan;
  if (plan_id != 0)
    result.plan_id = plan_id;
  out.advanced = progress{static_cast<std::uint16_t>(size()), static_cast<std::uint16_t>(size())};
  finish(out, std::move(result), now_ns);
}

void upload::refuse(step& out, std::uint8_t result, std::int64_t now_ns) {
  refusal_.reset();
  auto what = refused(result);
  if (peer_.is_atomic || !may_have_begun()) {
    finish(out, std::move(what), now_ns);
    return;
  }
  // The vehicle replaces item by item: look how much is there now.
  decided_ = std::move(what);
  resolve(out, plan_reader::depth::count, now_ns);
}

void upload::finish(step& out, outcome what, std::int64_t now_ns) const {
  what.mission_type = who_.mission_type;
  what.duration_ns = now_ns - started_ns_;
  what.effort = effort_;
  what.effort.items_sent = flow_.sends();
  what.effort.items_resent = flow_.resends();
  if (reader_)
    what.effort.requests_sent += reader_->requests_sent();
  out.finished = std::move(what);
}

outcome upload::failed(verdict how, std::string reason) const {
  outcome result;
  result.verdict = how;
  result.phase = phase_ == phase::announcing && has_begun_ ? phase::sending : phase_;
  result.holding = peer_.is_atomic && !may_be_complete() ? holding::unchanged : holding::unknown;
  result.reason = std::move(reason);
  return result;
}

outcome upload::refused(std::uint8_t result) const {
  auto what = failed(verdict::refused, sentence_for_mission_result(result));
  what.result = result;
  if (phase_ != phase::announcing)
    what.item = static_cast<std::uint16_t>(flow_.wanted());
  const bool keeps_old = peer_.is_atomic || !may_have_begun();
  what.holding = keeps_old && !was_complete_before_ ? holding::unchanged : holding::unknown;
  return what;
}

// A new id alone could be that of another station's plan. But a vehicle that has asked for the last item waits for it
// as long as its patience, and takes no other plan before: until then another id than while it took ours can only be
// ours.
bool upload::is_id_of_ours(std::uint32_t plan_id, std::int64_t now_ns) const {
  if (plan_id == 0 || plan_id == acknowledged_id_)
    return plan_id != 0;
  const bool is_new = old_plan_id_ && plan_id != *old_plan_id_;
  return is_new && flow_.is_last_asked_for() && now_ns - progress_ns_ < peer_.patience_ns - patience_doubt_ns;
}

// A vehicle that is busy now may have taken the first announcement, and the items that went along with it, while each
// of its answers was lost.
bool upload::may_have_begun() const { return has_begun_ || (items_went_along_ && announcements_ > 1 && busy_); }

} // namespace godwit::vehicle_link::transfer
