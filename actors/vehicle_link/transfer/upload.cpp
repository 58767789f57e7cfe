#include "actors/vehicle_link/transfer/upload.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "actors/vehicle_link/transfer/answer_wait.hpp"
#include "io/mavlink/plan_meaning.hpp"

namespace godwit::vehicle_link::transfer {

namespace {

using mavlink::mav_mission_result;
using mavlink::number;

// Where no items follow the announcement it may come twice: PX4 asks for item 0 again. Items that are sent after the
// second one come after it, too.
constexpr std::int64_t repeats_count_ns = 100 * ns_per_ms;
// A vehicle that said it was busy is not asked again sooner.
constexpr std::int64_t min_busy_wait_ns = 250 * ns_per_ms;
// The vehicle answered with errors, and there was no progress for so many waits: it is not in a transfer any more.
constexpr int silences_after_error = 2;

constexpr bool is(std::uint8_t result, mav_mission_result what) { return result == number(what); }

} // namespace

upload::upload(std::vector<mavlink::mission_item_int> plan, const earlier_upload& before, const parties& who,
               const peer_profile& peer, round_trip& line)
    : plan_(std::move(plan)), who_(who), peer_(peer), line_(line), flow_(static_cast<int>(plan_.size()), peer, line),
      before_(before) {
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    plan_[i] = who_.addressed(plan_[i]);
    plan_[i].seq = static_cast<std::uint16_t>(i);
  }
}

void upload::start(step& out, std::int64_t now_ns) {
  started_ns_ = heard_ns_ = progress_ns_ = now_ns;
  if (now_ns >= before_.on_line_until_ns)
    announce(out, now_ns);
}

void upload::announce(step& out, std::int64_t now_ns) {
  if (announcements_ == 0) {
    first_announced_ns_ = now_ns;
    was_none_open_ = now_ns >= before_.open_until_ns;
    is_first_asked_for_ = false;
  }
  announced_ns_ = now_ns;
  ++announcements_;
  has_closed_ours_ = false;
  mavlink::mission_count announcement;
  announcement.count = static_cast<std::uint16_t>(size());
  out.messages.emplace_back(who_.addressed(announcement));
  items_went_along_ = peer_.items_follow_count && effort_.restarts == 0;
  if (items_went_along_ && announcements_ == 1)
    send_items(out, now_ns);
}

void upload::send_items(step& out, std::int64_t now_ns) {
  while (const auto index = flow_.take_sendable(now_ns))
    out.messages.emplace_back(plan_[static_cast<std::size_t>(*index)]);
}

void upload::restart_or(step& out, outcome otherwise, std::int64_t now_ns) {
  if (effort_.restarts == max_restarts) {
    finish(out, std::move(otherwise), now_ns);
    return;
  }
  ++effort_.restarts;
  was_complete_before_ = may_be_complete();
  old_plan_id_.reset();
  flow_.restart();
  phase_ = phase::announcing;
  announcements_ = 0;
  busy_.reset();
  refusal_.reset();
  errors_ = 0;
  heard_ns_ = progress_ns_ = now_ns;
  announce(out, now_ns);
}

void upload::on_request(step& out, std::uint16_t item, std::int64_t now_ns) {
  heard_ns_ = now_ns;
  if (decided_ && item <= flow_.wanted())
    return;
  decided_.reset();     // it goes on after all
  if (item >= size()) { // a longer plan, of another transfer
    if (phase_ == phase::sending)
      restart_or(out, failed(verdict::timed_out, "the vehicle asks for items that the plan does not have"), now_ns);
    return;
  }
  if (phase_ == phase::announcing)
    on_request_announcing(out, item, now_ns);
  else if (phase_ == phase::sending)
    on_request_sending(out, item, now_ns);
  else if (item >= flow_.wanted()) {
    flow_.on_request(item, now_ns);
    resume_sending(out, now_ns);
  }
}

void upload::on_request_announcing(step& out, int item, std::int64_t now_ns) {
  if (announcements_ == 0 || line_.is_too_soon(now_ns - first_announced_ns_))
    return; // of an earlier transfer
  if (item != 0 && !may_have_taken_first_item())
    return;
  is_first_asked_for_ = item == 0;
  // No certain sample of the line: where an earlier transfer is open, it may be the vehicle asking again.
  if (item == 0)
    line_.ambiguous_sample({now_ns - announced_ns_, 0, std::nullopt});
  phase_ = phase::sending;
  has_begun_ = true;
  progress_ns_ = now_ns;
  busy_.reset();
  refusal_.reset();
  if (announcements_ > 1) // items that went along with a lost announcement are lost as well
    flow_.on_wrong_item(now_ns);
  if (item == 0)
    send_items(out, now_ns);
  else
    on_request_sending(out, item, now_ns);
}

// The first window went along with the only announcement, and nothing of it was wrong.
bool upload::may_have_taken_first_item() const {
  return items_went_along_ && announcements_ == 1 && effort_.warnings == 0;
}

void upload::on_request_sending(step& out, int item, std::int64_t now_ns) {
  if (flow_.on_request(item, now_ns)) {
    progress_ns_ = now_ns;
    refusal_.reset();
    errors_ = 0;
    if (flow_.wanted() > done_) {
      done_ = flow_.wanted();
      out.advanced = progress{static_cast<std::uint16_t>(done_), static_cast<std::uint16_t>(size())};
    }
  }
  if (!refusal_)
    send_items(out, now_ns);
}

void upload::on_ack(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) {
  heard_ns_ = now_ns;
  if (phase_ == phase::announcing)
    on_ack_announcing(out, m, now_ns);
  else if (phase_ == phase::sending)
    on_ack_sending(out, m, now_ns);
  else
    on_ack_resolving(out, m, now_ns);
}

void upload::on_ack_announcing(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) {
  if (announcements_ == 0)
    return; // of an earlier transfer
  const bool is_late = is(m.type, mav_mission_result::accepted) || is(m.type, mav_mission_result::invalid_sequence) ||
                       is(m.type, mav_mission_result::operation_cancelled);
  const bool is_warning = peer_.error_is_warning && is(m.type, mav_mission_result::error);
  if (is_late || is_warning) {
    ++effort_.warnings;
    // The items came without the announcement.
    if (is_warning && items_went_along_ && announcements_ == 1)
      announce(out, now_ns);
  } else if (is(m.type, mav_mission_result::error) || is(m.type, mav_mission_result::denied)) {
    on_busy(out, m.type);
  } else {
    refusal_ = refusal{m.type, now_ns + line_.timeout_ns()};
  }
}

// Perhaps with an open transfer of our own. The next announcement comes later: a cancel that is sent together with it
// may be overtaken, and would end what has just begun.
void upload::on_busy(step& out, std::uint8_t result) {
  busy_ = result;
  if (!peer_.obeys_cancel || has_closed_ours_)
    return;
  has_closed_ours_ = true;
  send_cancel(out);
}

void upload::send_cancel(step& out) const {
  mavlink::mission_ack cancelled;
  cancelled.type = number(mav_mission_result::operation_cancelled);
  out.messages.emplace_back(who_.addressed(cancelled));
}

void upload::on_ack_sending(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) {
  switch (static_cast<mav_mission_result>(m.type)) {
  case mav_mission_result::accepted:
    if (!flow_.may_be_acknowledged(now_ns)) {
      ++effort_.warnings;
    } else if (flow_.is_last_asked_for() && has_begun_with_ours()) {
      accept(out, proof::acknowledged, m.opaque_id, now_ns);
    } else {
      acknowledged_id_ = m.opaque_id;
      resolve(out, has_begun_with_ours() ? plan_reader::depth::count : plan_reader::depth::items, now_ns);
    }
    return;
  case mav_mission_result::denied: // an attempt to resolve it, a while ago
    ++effort_.warnings;
    return;
  case mav_mission_result::invalid_sequence:
    ++effort_.warnings;
    flow_.on_wrong_item(now_ns);
    if (!refusal_)
      send_items(out, now_ns);
    return;
  case mav_mission_result::error:
    on_error_sending(out, now_ns);
    return;
  case mav_mission_result::operation_cancelled:
    restart_or(out, failed(verdict::timed_out, "the vehicle cancelled the transfer, because too little of it arrived"),
               now_ns);
    return;
  default:
    refusal_ = refusal{m.type, now_ns + line_.timeout_ns()};
  }
}

// Any number may be for things that came late or twice. Followed by silence they mean that the transfer is over.
void upload::on_error_sending(step& out, std::int64_t now_ns) {
  ++errors_;
  ++effort_.warnings;
  const int silences_needed = peer_.acknowledges_last_again ? silences_before_resolving(peer_) : 1;
  if (flow_.is_all_sent() && flow_.silences() >= silences_needed)
    resolve(out, plan_reader::depth::items, now_ns);
}

void upload::on_ack_resolving(step& out, const mavlink::mission_ack& m, std::int64_t now_ns) {
  if (decided_) {
    reader_->on_ack(m);
  } else if (is(m.type, mav_mission_result::accepted)) {
    if (depth_ == plan_reader::depth::items && flow_.is_last_asked_for() && has_begun_with_ours()) {
      reader_->close(out, mav_mission_result::accepted);
      accept(out, proof::acknowledged, m.opaque_id, now_ns);
    }
  } else if (is(m.type, mav_mission_result::denied)) {
    resume_sending(out, now_ns); // it is busy, with this very transfer
  } else {
    // An error may be for an item that was sent again when all was done: only a request shows that it is not.
    if (is(m.type, mav_mission_result::error))
      ++effort_.warnings;
    reader_->on_ack(m);
  }
}

void upload::resolve(step& out, plan_reader::depth how, std::int64_t now_ns) {
  phase_ = phase::resolving;
  depth_ = how;
  reader_.emplace(how, who_, peer_, line_);
  reader_->start(out, now_ns);
}

void upload::resume_sending(step& out, std::int64_t now_ns) {
  effort_.requests_sent += reader_->requests_sent();
  reader_.reset();
  phase_ = phase::sending;
  flow_.go_back(now_ns);
  send_items(out, now_ns);
}

void upload::on_count(step& out, const mavlink::mission_count& m, std::int64_t now_ns) {
  if (!reader_)
    return;
  heard_ns_ = now_ns;
  reader_->on_count(out, m, now_ns);
  look_at_reader(out, now_ns);
}

void upload::on_item(step& out, const mavlink::mission_item_int& m, std::int64_t now_ns) {
  if (!reader_)
    return;
  heard_ns_ = now_ns;
  reader_->on_item(out, m, now_ns);
  look_at_reader(out, now_ns);
}

void upload::look_at_reader(step& out, std::int64_t now_ns) {
  using enum plan_reader::state;
  const bool count_tells =
      reader_->now() == reading && (reader_->count() != size() || is_id_of_ours(reader_->plan_id(), now_ns));
  if (reader_->now() == complete || count_tells) {
    compare_with_held(out, now_ns);
  } else if (reader_->is_over()) {
    finish(out,
           decided_ ? *decided_
                    : failed(verdict::timed_out, "all was sent, and the vehicle did not report what it holds"),
           now_ns);
  }
}

void upload::compare_with_held(step& out, std::int64_t now_ns) {
  reader_->close(out, mav_mission_result::accepted);
  const auto held = reader_->count();
  if (decided_) {
    decided_->items_on_vehicle = static_cast<std::uint16_t>(held);
    finish(out, std::move(*decided_), now_ns);
    return;
  }
  const auto plan_id = reader_->plan_id();
  const bool is_other_id = plan_id != 0 && acknowledged_id_ != 0 && plan_id != acknowledged_id_;
  std::optional<std::size_t> difference;
  auto how = proof::counted;
  if (held != size() || is_other_id) {
    difference = std::min(held, size());
  } else if (is_id_of_ours(plan_id, now_ns)) {
    how = proof::plan_id;
  } else if (depth_ == plan_reader::depth::items) {
    how = proof::read_back;
    const bool first_is_home = peer_.first_item_is_home && who_.mission_type == mavlink::mav_mission_type::mission;
    difference = io::mavlink::first_difference(plan_, reader_->items(), first_is_home);
  }
  if (!difference) {
    accept(out, how, plan_id, now_ns);
    return;
  }
  auto other = errors_ > 0 ? refused(number(mav_mission_result::error))
                           : failed(verdict::vehicle_holds_other,
                                    "all was sent, but the vehicle holds another plan of " + std::to_string(held) +
                                        " items, which differs from item " + std::to_string(*difference) + " on");
  other.holding = holding::other;
  other.items_on_vehicle = static_cast<std::uint16_t>(held);
  other.item = static_cast<std::uint16_t>(*difference);
  effort_.requests_sent += reader_->requests_sent();
  reader_.reset();
  acknowledged_id_ = 0;
  restart_or(out, std::move(other), now_ns);
}

void upload::on_plan_id(step& out, std::uint32_t plan_id, std::optional<int> count, std::int64_t now_ns) {
  // What the vehicle holds while it takes our plan is what it held before, whatever other stations did until then.
  if (phase_ == phase::sending && !flow_.is_all_sent())
    old_plan_id_ = plan_id;
  const bool waits_for_ack = phase_ != phase::announcing && flow_.is_last_asked_for() && flow_.is_all_sent();
  if (decided_ || !waits_for_ack || !is_id_of_ours(plan_id, now_ns) || count.value_or(size()) != size())
    return;
  if (reader_)
    reader_->close(out, mav_mission_result::accepted);
  accept(out, proof::plan_id, plan_id, now_ns);
}

void upload::on_time(step& out, std::int64_t now_ns) {
  if (reader_) {
    reader_->on_time(out, now_ns);
    look_at_reader(out, now_ns);
    return;
  }
  if (refusal_) {
    if (now_ns >= refusal_->believed_ns)
      refuse(out, refusal_->result, now_ns);
    return;
  }
  const bool is_announcing = phase_ == phase::announcing;
  if (now_ns >= gives_up_ns() && (!is_announcing || now_ns >= announces_next_ns())) {
    on_given_up(out, now_ns);
  } else if (is_announcing) {
    if (now_ns < announces_next_ns())
      return;
    if (announcements_ > 0)
      line_.on_silence();
    announce(out, now_ns);
  } else if (now_ns >= flow_.due_ns()) {
    flow_.on_silence(now_ns);
    const bool is_over = errors_ > 0 && flow_.silences() >= silences_after_error;
    if (is_over && !flow_.is_all_sent())
      restart_or(out, refused(number(mav_mission_result::error)), now_ns);
    else if (flow_.is_all_sent() && flow_.silences() >= silences_before_resolving(peer_))
      resolve(out, plan_reader::depth::items, now_ns);
    else
      send_items(out, now_ns);
  }
}

void upload::on_given_up(step& out, std::int64_t now_ns) {
  if (phase_ == phase::sending)
    restart_or(out, failed(verdict::timed_out, "the vehicle did not go on"), now_ns);
  else if (busy_)
    refuse(out, *busy_, now_ns);
  else
    finish(out, failed(verdict::timed_out, "the vehicle did not answer"), now_ns);
}

void upload::cancel(step& out, std::int64_t now_ns) {
  send_cancel(out);
  finish(out, failed(verdict::cancelled, "it was cancelled"), now_ns);
}

std::int64_t upload::next_deadline_ns() const {
  if (reader_)
    return reader_->next_deadline_ns();
  if (refusal_)
    return refusal_->believed_ns;
  return phase_ == phase::announcing ? announces_next_ns() : std::min(gives_up_ns(), flow_.due_ns());
}

std::int64_t upload::gives_up_ns() const {
  if (busy_)
    return progress_ns_ + patience_with_busy * peer_.patience_ns;
  if (phase_ == phase::announcing && announcements_ < min_tries)
    return std::numeric_limits<std::int64_t>::max();
  return std::min(heard_ns_ + peer_.patience_ns, progress_ns_ + patience_without_progress * peer_.patience_ns);
}

std::int64_t upload::announces_next_ns() const {
  if (announcements_ == 0)
    return before_.on_line_until_ns;
  const auto first_ns = peer_.items_follow_count ? line_.timeout_ns() : std::min(line_.timeout_ns(), repeats_count_ns);
  const auto wait_ns = lengthened(first_ns, announcements_ - 1, max_wait_ns);
  return announced_ns_ + (busy_ ? std::max(wait_ns, min_busy_wait_ns) : wait_ns);
}

} // namespace godwit::vehicle_link::transfer
