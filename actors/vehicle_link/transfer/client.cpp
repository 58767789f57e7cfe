#include "actors/vehicle_link/transfer/client.hpp"

#include <array>
#include <utility>

#include "actors/vehicle_link/transfer/clear.hpp"
#include "actors/vehicle_link/transfer/download.hpp"
#include "runtime/assert.hpp"

namespace godwit::vehicle_link::transfer {

namespace {

using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::number;

std::uint32_t plan_id_of(const mavlink::mission_current& m, mav_mission_type type) {
  switch (type) {
  case mav_mission_type::fence:
    return m.fence_id;
  case mav_mission_type::rally:
    return m.rally_points_id;
  default:
    return m.mission_id;
  }
}

// MISSION_CURRENT.total of a vehicle without a mission.
constexpr std::uint16_t no_plan_total = 65'535;

std::size_t index_of(mav_mission_type type) { return number(type); }

bool has_any_plan_id(const mavlink::mission_current& m) {
  return m.mission_id != 0 || m.fence_id != 0 || m.rally_points_id != 0;
}

bool is_download(const outcome& what) { return what.phase == phase::listing || what.phase == phase::reading; }

step refused_here(mav_mission_type type) {
  outcome result;
  result.verdict = verdict::refused;
  result.mission_type = type;
  result.result = number(mav_mission_result::no_space);
  result.holding = holding::unchanged;
  result.reason = "a plan has at most " + std::to_string(plan_reader::max_items) + " items; nothing was sent";
  step out;
  out.finished = std::move(result);
  return out;
}

} // namespace

client::client(mavlink::sender ourselves, mavlink::sender peer, const peer_profile& profile, std::int64_t since_ns)
    : ourselves_(ourselves), peer_(peer), profile_(profile), keeps_plan_ids_(profile.keeps_plan_ids) {
  before_.fill({0, since_ns + profile.patience_ns});
}

step client::upload(mav_mission_type type, std::vector<mavlink::mission_item_int> plan, std::int64_t now_ns) {
  const auto who = with(type);
  if (plan.empty())
    return begin(who, std::make_unique<transfer::clear>(clear_with::mission_count_0, who, profile_, line_), now_ns);
  if (plan.size() > plan_reader::max_items)
    return refused_here(type);
  return begin(who, std::make_unique<transfer::upload>(std::move(plan), before_[index_of(type)], who, profile_, line_),
               now_ns);
}

step client::download(mav_mission_type type, std::int64_t now_ns, bool id_suffices) {
  const auto who = with(type);
  return begin(who, std::make_unique<transfer::download>(id_suffices, who, profile_, line_), now_ns);
}

step client::clear(mav_mission_type type, std::int64_t now_ns) {
  const auto who = with(type);
  return begin(who, std::make_unique<transfer::clear>(clear_with::mission_clear_all, who, profile_, line_), now_ns);
}

step client::begin(const parties& who, std::unique_ptr<operation> what, std::int64_t now_ns) {
  GODWIT_ASSERT(is_idle(), "a transfer begins only when none is running");
  GODWIT_ASSERT(who.mission_type != mav_mission_type::all, "plans are transferred and cleared one by one");
  who_ = who;
  running_ = std::move(what);
  cancel_repeats_left_ = 0;
  stale_cancels_left_ = max_cancel_repeats;
  began_ns_ = now_ns;
  is_answered_ = false;
  step out;
  running_->start(out, now_ns);
  return out;
}

step client::cancel(std::int64_t now_ns) {
  step out;
  if (is_idle())
    return out;
  cancel_repeats_left_ = running_->wants_cancel_repeated() ? max_cancel_repeats : 0;
  running_->cancel(out, now_ns);
  end_if_finished(out, now_ns);
  return out;
}

template <class M>
bool client::concerns_running(const M& m) {
  if (!is_idle() && who_.concerns(m))
    return true;
  ++ignored_;
  return false;
}

template <class M>
bool client::is_stale(const M& m, std::int64_t now_ns) const {
  const bool is_ours = m.target_system == ourselves_.system && m.target_component == ourselves_.component;
  return !is_idle() && is_ours && m.mission_type != number(who_.mission_type) &&
         m.mission_type < number(mav_mission_type::all) && stale_cancels_left_ > 0 && !is_answered_ &&
         now_ns - began_ns_ >= other_is_stale_ns;
}

template <class M>
step client::on_any_request(const M& m, std::int64_t now_ns) {
  step out;
  if (is_stale(m, now_ns)) {
    --stale_cancels_left_;
    mavlink::mission_ack cancelled;
    cancelled.type = number(mav_mission_result::operation_cancelled);
    out.messages.emplace_back(with(static_cast<mav_mission_type>(m.mission_type)).addressed(cancelled));
    return out;
  }
  if (is_idle() && cancel_repeats_left_ > 0 && who_.concerns(m)) {
    --cancel_repeats_left_;
    mavlink::mission_ack cancelled;
    cancelled.type = number(mav_mission_result::operation_cancelled);
    out.messages.emplace_back(who_.addressed(cancelled));
  } else if (concerns_running(m)) {
    is_answered_ = true;
    running_->on_request(out, m.seq, now_ns);
    end_if_finished(out, now_ns);
  }
  return out;
}

step client::on(const mavlink::mission_request_int& m, std::int64_t now_ns) { return on_any_request(m, now_ns); }

step client::on(const mavlink::mission_request& m, std::int64_t now_ns) { return on_any_request(m, now_ns); }

step client::on(const mavlink::mission_count& m, std::int64_t now_ns) {
  step out;
  if (concerns_running(m)) {
    running_->on_count(out, m, now_ns);
    end_if_finished(out, now_ns);
  }
  return out;
}

step client::on(const mavlink::mission_item_int& m, std::int64_t now_ns) {
  step out;
  if (concerns_running(m)) {
    running_->on_item(out, m, now_ns);
    end_if_finished(out, now_ns);
  }
  return out;
}

step client::on(const mavlink::mission_ack& m, std::int64_t now_ns) {
  step out;
  if (concerns_running(m)) {
    running_->on_ack(out, m, now_ns);
    end_if_finished(out, now_ns);
  }
  return out;
}

step client::on(const mavlink::mission_current& m, std::int64_t now_ns) {
  step out;
  keeps_plan_ids_ = keeps_plan_ids_ || has_any_plan_id(m);
  if (!keeps_plan_ids_ || is_idle())
    return out;
  std::optional<int> count;
  if (who_.mission_type == mav_mission_type::mission && m.total != 0)
    count = m.total == no_plan_total ? 0 : m.total;
  running_->on_plan_id(out, plan_id_of(m, who_.mission_type), count, now_ns);
  end_if_finished(out, now_ns);
  return out;
}

step client::on_time(std::int64_t now_ns) {
  step out;
  if (!is_idle()) {
    running_->on_time(out, now_ns);
    end_if_finished(out, now_ns);
  }
  return out;
}

std::optional<std::int64_t> client::next_deadline_ns() const {
  if (is_idle())
    return std::nullopt;
  return running_->next_deadline_ns();
}

void client::end_if_finished(const step& out, std::int64_t now_ns) {
  if (!out.finished)
    return;
  running_.reset();
  if (!is_download(*out.finished))
    before_[index_of(who_.mission_type)] = {
        now_ns + frames_stay_ns, out.finished->verdict == verdict::accepted ? 0 : now_ns + profile_.patience_ns};
}

} // namespace godwit::vehicle_link::transfer
