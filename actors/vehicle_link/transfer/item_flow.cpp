#include "actors/vehicle_link/transfer/item_flow.hpp"

#include <algorithm>

namespace godwit::vehicle_link::transfer {

namespace {

// So many in a row are nothing unusual where a fifth is lost; more say that the line may have become slower.
constexpr int usual_silences = 2;

} // namespace

item_flow::item_flow(int count, const peer_profile& peer, round_trip& line)
    : count_(count), line_(line), window_(peer.first_window, peer.max_window),
      sendings_(static_cast<std::size_t>(count)) {}

void item_flow::restart() {
  wanted_ = 0;
  next_ = 0;
  sent_until_ = 0;
  probe_until_ = 0;
  silences_ = 0;
  has_gone_back_ = false;
  older_request_.reset();
}

std::optional<int> item_flow::take_sendable(std::int64_t now_ns) {
  if (next_ >= std::min(count_, std::max(wanted_ + window_.size(), probe_until_)))
    return std::nullopt;
  if (awaits_answers())
    return std::nullopt;
  auto& item = sendings_[static_cast<std::size_t>(next_)];
  item.before_ns = item.last_ns;
  item.last_ns = now_ns;
  ++item.times;
  ++sends_;
  if (item.times > 1)
    ++resends_;
  if (sent_until_ == next_ && next_ == count_ - 1)
    all_sent_ns_ = now_ns;
  sent_until_ = std::max(sent_until_, next_ + 1);
  return next_++;
}

// What was sent together is answered together. On a line that loses much it is not known yet whether the vehicle has
// what is still open; what is sent on top of a lost item is dropped.
bool item_flow::awaits_answers() const {
  if (!window_.is_lossy() || window_.is_fillable() || wanted_ == 0 || next_ <= wanted_ || next_ < probe_until_)
    return false;
  const auto answered_ns = sendings_[static_cast<std::size_t>(wanted_ - 1)].last_ns;
  return sendings_[static_cast<std::size_t>(wanted_)].last_ns <= answered_ns;
}

bool item_flow::on_request(int k, std::int64_t now_ns) {
  if (k < wanted_) {
    older_request_ = k;
    return false;
  }
  older_request_.reset();
  if (k == wanted_) {
    go_back_if_lost(now_ns);
    return false;
  }
  const auto& answered = sendings_[static_cast<std::size_t>(k - 1)];
  const bool is_certain = take_sample(answered, now_ns);
  const auto taken = k - wanted_;
  window_.on_progress(taken, now_ns - answered.last_ns, is_certain);
  requests_.on_answers(taken, now_ns);
  wanted_ = k;
  next_ = std::max(next_, k);
  // The waits may still be too short if it is not certain what was answered.
  lengthening_ = is_certain ? 0 : std::max(lengthening_ - 1, 0);
  silences_ = 0;
  probe_until_ = 0;
  has_gone_back_ = false;
  return true;
}

// True if it is certain which sending was answered now.
bool item_flow::take_sample(const sending& answered, std::int64_t now_ns) {
  const auto since_last_ns = now_ns - answered.last_ns;
  // An answer to what was sent before a silence may be one that the vehicle gave when it asked again.
  if (answered.times == 1 && answered.last_ns >= went_back_ns_) {
    line_.sample(since_last_ns);
    return true;
  }
  if (answered.times > 1) {
    const bool is_first_resend = silences_ == 1 && answered.times == 2;
    line_.ambiguous_sample({since_last_ns, answered.last_ns - answered.before_ns,
                            is_first_resend ? std::optional(now_ns - answered.before_ns) : std::nullopt});
  }
  return false;
}

void item_flow::on_wrong_item(std::int64_t now_ns) {
  if (!has_gone_back_)
    go_back_if_lost(now_ns);
}

void item_flow::go_back_if_lost(std::int64_t now_ns) {
  const auto waited_ns = now_ns - sendings_[static_cast<std::size_t>(wanted_)].last_ns;
  const bool is_lost = line_.is_certain() ? line_.is_enough(waited_ns) : waited_ns >= line_.timeout_ns() / 2;
  if (next_ <= wanted_ || !is_lost)
    return;
  window_.on_loss();
  go_back(now_ns);
}

void item_flow::on_silence(std::int64_t now_ns) {
  if (older_request_)
    wanted_ = *older_request_;
  older_request_.reset();
  ++silences_;
  if (line_.is_certain())
    lengthening_ += silences_ > usual_silences ? 1 : 0;
  else
    line_.on_silence();
  window_.on_loss();
  // Into repeated silence all is sent that may be wanted: perhaps everything has come, and the requests were lost.
  probe_until_ = silences_ > 1 ? sent_until_ + 1 : 0;
  go_back(now_ns);
}

void item_flow::go_back(std::int64_t now_ns) {
  next_ = wanted_;
  went_back_ns_ = now_ns;
  has_gone_back_ = true;
  requests_.on_stall(now_ns);
}

std::int64_t item_flow::due_ns() const {
  const auto sent_ns = sendings_[static_cast<std::size_t>(wanted_)].last_ns;
  const auto pause_ns = window_.is_fillable() ? line_.timeout_ns() : round_trip::min_margin_ns;
  return std::max(sent_ns + wait_ns(), requests_.runs_until_ns(pause_ns));
}

std::int64_t item_flow::wait_ns() const { return lengthened(line_.timeout_ns(), lengthening_, max_wait_ns); }

} // namespace godwit::vehicle_link::transfer
