#include "io/mqtt/session.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "io/mqtt/encoder.hpp"

namespace godwit::io::mqtt {
namespace {

constexpr std::int64_t ms_per_s = 1'000;

failure failure_of(reason_code refusal) {
  switch (refusal) {
  case reason_code::bad_user_or_password:
  case reason_code::not_authorised:
  case reason_code::banned:
  case reason_code::bad_authentication_method:
    return failure::not_authorised;
  case reason_code::session_taken_over:
    return failure::taken_over;
  case reason_code::retain_not_supported:
    return failure::retain_refused;
  default:
    return failure::refused;
  }
}

std::string the_broker(const std::string& does) { return "the broker " + does; }

} // namespace

// -- the beginning and the end --------------------------------------------------------------------

void session::begin(const std::string_view* password, std::int64_t now_ms) {
  if (phase_ != phase::fresh)
    return;
  connect_request request{settings_.client_id, settings_.username, {}, settings_.keep_alive_s, max_packet_bytes};
  if (password != nullptr)
    request.password = *password;
  auto hello = encode_connect(request, will_);
  if (!hello)
    return close(failure::unusable, hello.error());
  phase_ = phase::connecting;
  phase_since_ms_ = now_ms;
  unwritten_.push_back({*std::move(hello)});
}

void session::close(failure why, std::string sentence) {
  if (phase_ != phase::leaving && phase_ != phase::over)
    events_.emplace_back(session_closed{why, std::move(sentence)});
  phase_ = phase::over;
}

void session::leave(reason_code answer, failure why, const std::string& sentence, std::int64_t now_ms) {
  if (phase_ == phase::leaving || phase_ == phase::over)
    return;
  events_.emplace_back(session_closed{why, sentence});
  phase_ = phase::leaving;
  phase_since_ms_ = now_ms;
  waiting_.clear();
  unwritten_.clear();
  unwritten_.push_back({encode_disconnect(answer)});
}

void session::end(std::int64_t now_ms) {
  if (phase_ == phase::open)
    leave(reason_code::disconnect_with_will, failure::none, {}, now_ms);
  else if (phase_ != phase::leaving)
    phase_ = phase::over;
  events_.clear();
}

void session::on_failed(failure why, std::string sentence) { close(why, std::move(sentence)); }

// -- what comes in --------------------------------------------------------------------------------

void session::on_bytes(std::string_view bytes, std::int64_t now_ms) {
  while (phase_ == phase::connecting || phase_ == phase::open) {
    const auto next = reader_.read(bytes);
    if (!next)
      return leave(next.error().answer, failure::refused, the_broker(next.error().sentence), now_ms);
    if (!*next)
      return;
    received_ms_ = now_ms;
    std::visit([&](const auto& m) { on_packet(m, now_ms); }, **next);
  }
}

void session::keep_limits(const connack& m) {
  receive_maximum_ = m.receive_maximum;
  may_retain_ = m.retain_available;
  max_packet_bytes_ = static_cast<std::uint32_t>(max_sent_bytes);
  if (m.maximum_packet_bytes != 0)
    max_packet_bytes_ = std::min(max_packet_bytes_, m.maximum_packet_bytes);
  // The broker's 0 means that it does not listen for signs of life; we look for its own all the same.
  const auto seconds = m.server_keep_alive_s.value_or(0) != 0 ? std::min(settings_.keep_alive_s, *m.server_keep_alive_s)
                                                              : settings_.keep_alive_s;
  keep_alive_ms_ = seconds * ms_per_s;
}

void session::on_packet(const connack& m, std::int64_t now_ms) {
  if (phase_ != phase::connecting)
    return leave(reason_code::protocol_error, failure::refused, the_broker("sends CONNACK twice"), now_ms);
  if (is_refusal(m.reason))
    return close(failure_of(m.reason), the_broker("refuses the connection: ") +
                                           (m.is_mqtt_5 ? name_of(m.reason) : "it does not speak MQTT 5"));
  keep_limits(m);
  if (m.maximum_qos == 0)
    return leave(reason_code::disconnect_with_will, failure::refused,
                 the_broker("acknowledges no message (Maximum QoS 0): no event could be known to have arrived"),
                 now_ms);
  if (max_packet_bytes_ < least_max_packet_bytes)
    return leave(reason_code::disconnect_with_will, failure::refused,
                 the_broker("takes packets of at most " + std::to_string(max_packet_bytes_) + " bytes, and " +
                            std::to_string(least_max_packet_bytes) + " are needed"),
                 now_ms);
  phase_ = phase::open;
  phase_since_ms_ = now_ms;
  sent_ms_ = now_ms;
  events_.emplace_back(session_opened{max_packet_bytes_});
}

void session::on_packet(const puback& m, std::int64_t now_ms) {
  const auto found = unconfirmed_.find(m.packet_id);
  if (phase_ != phase::open || found == unconfirmed_.end())
    return leave(reason_code::protocol_error, failure::refused,
                 the_broker("acknowledges a message that does not wait for it"), now_ms);
  if (is_refusal(m.reason))
    return leave(reason_code::disconnect_with_will, failure_of(m.reason),
                 the_broker("does not take a message: " + name_of(m.reason)), now_ms);
  events_.emplace_back(session_published{found->second});
  unconfirmed_.erase(found);
  puback_ms_ = now_ms;
  send_waiting(now_ms);
}

void session::on_packet(const pingresp&, std::int64_t now_ms) {
  if (phase_ != phase::open || !is_ping_due_)
    return leave(reason_code::protocol_error, failure::refused, the_broker("answers a ping that was not sent"), now_ms);
  is_ping_due_ = false;
  ping_ms_ = never_ms;
}

void session::on_packet(const disconnect& m, std::int64_t) {
  if (phase_ == phase::connecting)
    return close(failure_of(m.reason), the_broker("refuses the connection: " + name_of(m.reason)));
  if (is_refusal(m.reason))
    return close(failure_of(m.reason), the_broker("has ended the connection: " + name_of(m.reason)));
  close(failure::lost, the_broker("has ended the connection"));
}

// -- what goes out --------------------------------------------------------------------------------

void session::publish(const message& what, std::uint64_t token, std::int64_t now_ms) {
  if (phase_ != phase::open)
    return;
  if (unwritten_.size() + waiting_.size() + unconfirmed_.size() >= max_queued)
    return leave(reason_code::disconnect_with_will, failure::lost,
                 "more than " + std::to_string(max_queued) + " messages wait for the network", now_ms);
  if (what.is_acknowledged)
    waiting_.push_back({what, token});
  else
    enqueue(what, token, now_ms);
  send_waiting(now_ms);
}

void session::send_waiting(std::int64_t now_ms) {
  while (!waiting_.empty() && unconfirmed_.size() < receive_maximum_ && phase_ == phase::open) {
    const auto next = std::move(waiting_.front());
    waiting_.pop_front();
    enqueue(next.what, next.token, now_ms);
  }
}

// A number that waits for no acknowledgement: at most max_queued do.
std::uint16_t session::next_packet_id() {
  do
    ++last_packet_id_;
  while (last_packet_id_ == 0 || unconfirmed_.contains(last_packet_id_));
  return last_packet_id_;
}

void session::enqueue(const message& what, std::uint64_t token, std::int64_t now_ms) {
  auto sent = what;
  sent.is_retained = what.is_retained && may_retain_;
  const auto id = what.is_acknowledged ? next_packet_id() : std::uint16_t{0};
  auto bytes = encode_publish(sent, id);
  if (bytes && bytes->size() > max_packet_bytes_)
    bytes = tl::make_unexpected("a message of " + std::to_string(bytes->size()) + " bytes is longer than the " +
                                std::to_string(max_packet_bytes_) + " that the broker takes");
  if (!bytes)
    return leave(reason_code::disconnect_with_will, failure::unusable, bytes.error(), now_ms);
  if (what.is_acknowledged) {
    if (unconfirmed_.empty())
      puback_ms_ = now_ms;
    unconfirmed_.emplace(id, token);
  }
  const auto kind = what.is_acknowledged ? outgoing::kind::other : outgoing::kind::unacknowledged;
  unwritten_.push_back({*std::move(bytes), kind, token});
}

std::string session::take_batch(std::int64_t now_ms) {
  std::string batch;
  if (is_writing_ || phase_ == phase::over || unwritten_.empty())
    return batch;
  // The first packet goes alone, so that its bytes, and a password in them, are in one place.
  batch = std::move(unwritten_.front().bytes);
  const bool is_first = phase_ == phase::connecting;
  while (true) {
    if (unwritten_.front().what == outgoing::kind::unacknowledged)
      written_tokens_.push_back(unwritten_.front().token);
    is_ping_in_batch_ |= unwritten_.front().what == outgoing::kind::ping;
    unwritten_.pop_front();
    if (is_first || unwritten_.empty() || batch.size() + unwritten_.front().bytes.size() > batch_bytes)
      break;
    batch += unwritten_.front().bytes;
  }
  is_writing_ = true;
  batch_ms_ = now_ms;
  sent_ms_ = now_ms;
  return batch;
}

void session::on_written(std::int64_t now_ms) {
  assert(is_writing_);
  is_writing_ = false;
  if (std::exchange(is_ping_in_batch_, false) && is_ping_due_)
    ping_ms_ = now_ms;
  if (phase_ == phase::open)
    for (const auto token : written_tokens_)
      events_.emplace_back(session_published{token});
  written_tokens_.clear();
  if (phase_ == phase::leaving && unwritten_.empty())
    phase_ = phase::over;
}

std::vector<session_event> session::take_events() { return std::exchange(events_, {}); }

// -- time -----------------------------------------------------------------------------------------

std::int64_t session::next_due_ms() const {
  switch (phase_) {
  case phase::fresh:
  case phase::over:
    return never_ms;
  case phase::connecting:
    return phase_since_ms_ + answer_timeout_ms;
  case phase::leaving:
    return phase_since_ms_ + leaving_timeout_ms;
  case phase::open:
    break;
  }
  auto due = is_ping_due_ ? never_ms : std::min(sent_ms_, received_ms_) + keep_alive_ms_;
  if (ping_ms_ != never_ms)
    due = std::max(ping_ms_, received_ms_) + ping_timeout_ms;
  if (is_writing_)
    due = std::min(due, batch_ms_ + write_timeout_ms);
  if (!unconfirmed_.empty())
    due = std::min(due, puback_ms_ + puback_timeout_ms);
  return due;
}

void session::on_time(std::int64_t now_ms) {
  if (now_ms < next_due_ms())
    return;
  if (phase_ == phase::connecting)
    return close(failure::unreachable, "what listens there has not answered CONNECT: is it a broker of MQTT?");
  if (phase_ == phase::leaving) {
    phase_ = phase::over;
    return;
  }
  check_due(now_ms);
}

void session::check_due(std::int64_t now_ms) {
  if (is_writing_ && now_ms >= batch_ms_ + write_timeout_ms)
    return close(failure::lost, "the network has taken nothing for 30 s");
  if (!unconfirmed_.empty() && now_ms >= puback_ms_ + puback_timeout_ms)
    return leave(reason_code::disconnect_with_will, failure::lost, the_broker("has acknowledged no message for 60 s"),
                 now_ms);
  if (ping_ms_ != never_ms && now_ms >= std::max(ping_ms_, received_ms_) + ping_timeout_ms)
    return close(failure::lost, the_broker("has not answered for 15 s"));
  if (!is_ping_due_) {
    is_ping_due_ = true;
    unwritten_.push_back({encode_ping(), outgoing::kind::ping});
  }
}

} // namespace godwit::io::mqtt
