#include "actors/vehicle_link/transfer/plan_reader.hpp"

#include <algorithm>
#include <limits>

#include "actors/vehicle_link/transfer/answer_wait.hpp"

namespace godwit::vehicle_link::transfer {

namespace {

using mavlink::mav_mission_result;
using mavlink::number;

// The slowest at which anything is asked for again.

bool may_pass(std::uint8_t result) {
  return result == number(mav_mission_result::error) || result == number(mav_mission_result::denied) ||
         result == number(mav_mission_result::operation_cancelled);
}

} // namespace

plan_reader::plan_reader(depth how, const parties& who, const peer_profile& peer, round_trip& line)
    : depth_(how), who_(who), peer_(peer), line_(line),
      window_(std::min(peer.first_window, peer.max_requests_ahead), peer.max_requests_ahead) {}

void plan_reader::start(step& out, std::int64_t now_ns) {
  last_progress_ns_ = now_ns;
  begin_listing(out, now_ns);
}

void plan_reader::on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) {
  if (state_ != state::listing)
    return;
  if (list_asked_times_ == 1)
    take_sample(now_ns - list_asked_ns_);
  note_progress(now_ns);
  count_ = m.count;
  plan_id_ = m.opaque_id;
  if (count_ == 0 || depth_ == depth::count || (depth_ == depth::plan_id && plan_id_ != 0)) {
    state_ = state::complete;
    return;
  }
  state_ = state::reading;
  items_.assign(static_cast<std::size_t>(count_), {});
  askings_.assign(static_cast<std::size_t>(count_), {});
  received_ = missing_ = next_ = 0;
  ask_ahead(out, now_ns);
}

void plan_reader::on_item(step& out, const mavlink::mission_item_int& m, std::int64_t now_ns) {
  if (state_ != state::reading || m.seq >= next_)
    return;
  auto& asked = askings_[m.seq];
  if (asked.has_come)
    return;
  asked.has_come = true;
  items_[m.seq] = m;
  ++received_;
  note_progress(now_ns);
  answers_.on_answers(1, now_ns);
  const auto round_trip_ns = now_ns - asked.last_ns;
  if (asked.times == 1)
    take_sample(round_trip_ns);
  window_.on_progress(1, round_trip_ns, asked.times == 1);
  while (missing_ < count_ && askings_[static_cast<std::size_t>(missing_)].has_come)
    ++missing_;
  if (received_ == count_) {
    state_ = state::complete;
    return;
  }
  ask_again_before(out, m.seq, now_ns); // what was asked for later came first
  ask_ahead(out, now_ns);
}

void plan_reader::on_ack(const mavlink::mission_ack& m) {
  const bool is_answer = m.type != number(mav_mission_result::accepted) &&
                         m.type != number(mav_mission_result::invalid_sequence) &&
                         !(m.type == number(mav_mission_result::error) && peer_.error_is_warning);
  if (!is_over() && is_answer)
    refusal_ = m.type;
}

void plan_reader::on_time(step& out, std::int64_t now_ns) {
  if (is_over() || now_ns < next_deadline_ns())
    return;
  if (now_ns >= gives_up_ns()) {
    state_ = refusal_ != 0 ? state::refused : state::silent;
    return;
  }
  if (refusal_ != 0 && !may_pass(refusal_)) {
    state_ = state::refused;
    return;
  }
  ++silences_;
  answers_.on_stall(now_ns);
  line_.on_silence();
  if (state_ == state::listing) {
    ask_for_list(out, now_ns);
    return;
  }
  if (silences_ >= silences_before_listing && listings_ < max_listings) {
    begin_listing(out, now_ns);
    return;
  }
  window_.on_loss();
  ask_again_before(out, next_, now_ns);
}

void plan_reader::close(step& out, mav_mission_result result) const {
  mavlink::mission_ack ack;
  ack.type = number(result);
  out.messages.emplace_back(who_.addressed(ack));
}

std::int64_t plan_reader::next_deadline_ns() const {
  const auto wait_ns = lengthened(line_.timeout_ns(), silences_, max_wait_ns);
  if (state_ == state::listing)
    return list_asked_ns_ + wait_ns;
  const auto asked_ns = askings_[static_cast<std::size_t>(missing_)].last_ns;
  return std::min(std::max(asked_ns + wait_ns, answers_.runs_until_ns(line_.timeout_ns())), gives_up_ns());
}

void plan_reader::begin_listing(step& out, std::int64_t now_ns) {
  state_ = state::listing;
  ++listings_;
  list_asked_times_ = 0;
  silences_ = 0;
  ask_for_list(out, now_ns);
}

void plan_reader::ask_for_list(step& out, std::int64_t now_ns) {
  list_asked_ns_ = now_ns;
  ++list_asked_times_;
  ++requests_sent_;
  out.messages.emplace_back(who_.addressed(mavlink::mission_request_list{}));
}

void plan_reader::ask_for_item(step& out, int index, std::int64_t now_ns) {
  auto& asked = askings_[static_cast<std::size_t>(index)];
  asked.last_ns = now_ns;
  ++asked.times;
  ++requests_sent_;
  mavlink::mission_request_int request;
  request.seq = static_cast<std::uint16_t>(index);
  out.messages.emplace_back(who_.addressed(request));
}

void plan_reader::ask_ahead(step& out, std::int64_t now_ns) {
  while (next_ < count_ && next_ - received_ < window_.size())
    ask_for_item(out, next_++, now_ns);
}

// Everything before END that is overdue, and no more than the window.
void plan_reader::ask_again_before(step& out, int end, std::int64_t now_ns) {
  int left = window_.size();
  for (int i = missing_; i < end && left > 0; ++i) {
    if (askings_[static_cast<std::size_t>(i)].has_come || !is_overdue(i, now_ns))
      continue;
    ask_for_item(out, i, now_ns);
    --left;
  }
}

bool plan_reader::is_overdue(int index, std::int64_t now_ns) const {
  return now_ns - askings_[static_cast<std::size_t>(index)].last_ns >= (line_.smoothed_ns() + line_.timeout_ns()) / 2;
}

// What comes too soon is an answer to what was asked in an earlier reading.
void plan_reader::take_sample(std::int64_t round_trip_ns) {
  if (!line_.is_too_soon(round_trip_ns))
    line_.sample(round_trip_ns);
}

void plan_reader::note_progress(std::int64_t now_ns) {
  last_progress_ns_ = now_ns;
  silences_ = 0;
  refusal_ = 0;
}

std::int64_t plan_reader::gives_up_ns() const {
  if (state_ == state::listing && list_asked_times_ < min_tries)
    return std::numeric_limits<std::int64_t>::max();
  return last_progress_ns_ + (refusal_ == 0 ? 1 : patience_with_busy) * peer_.patience_ns;
}

} // namespace godwit::vehicle_link::transfer
