#include "actors/fleet_link/core.hpp"

#include <algorithm>
#include <utility>

#include "actors/fleet_link/remedy.hpp"
#include "io/fields/json_text.hpp"
#include "io/mqtt/encoder.hpp"
#include "io/time_units.hpp"

namespace godwit::fleet_link {
namespace {

constexpr std::uint64_t max_doublings = 6;

struct status_form {
  std::string state; // online, offline
  std::string session;
  std::int64_t at_ms = 0; // of an offline: when the connection was made that is lost
  GODWIT_FIELDS(status_form, "fleet_link.status", state, session, at_ms);
};

std::shared_ptr<const std::string> shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

} // namespace

core::core(settings configured, std::uint64_t seed, std::string session, std::uint64_t first_attempt)
    : settings_(std::move(configured)), session_(std::move(session)), seed_(seed), attempt_(first_attempt),
      live_(settings_.interval_ms * ns_per_ms) {}

std::string core::topic(std::string_view rest) const { return "gw/v1/" + settings_.vehicle + "/" + std::string(rest); }

publication core::status_text(const char* how, instant now) const {
  return {publication::kind::status, topic("status"),
          shared(io::to_json(status_form{how, session_ + "-" + std::to_string(attempt_), now.wall_ns / ns_per_ms})), 0};
}

bool core::is_too_large(const publication& what) const {
  return io::mqtt::publish_bytes(what.topic.size(), what.payload->size()) > max_packet_bytes_;
}

publication core::event_text(const state& s, const queued_event& what) {
  std::string text = R"({"id":")" + s.store + "-" + std::to_string(what.number);
  text.append(R"(","number":)").append(std::to_string(what.number));
  text.append(R"(,"kind":")").append(io::name_of(what.kind));
  text.append(R"(","at_ms":)").append(std::to_string(what.at_ms));
  text.append(R"(,"historical":)").append(what.is_late ? "true" : "false");
  text.append(R"(,"data":)");
  publication whole{publication::kind::event, topic("event"), shared(text + what.data + "}"), what.number};
  if (!is_too_large(whole))
    return whole;
  ++too_large_;
  return {whole.how, whole.topic, shared(text + "{}}"), what.number};
}

// -- the connection -------------------------------------------------------------------------------

open_broker core::next_attempt(instant now) {
  ++attempt_;
  phase_ = phase::opening;
  due_ns_ = now.monotonic_ns + open_patience_ns;
  return {attempt_, status_text("offline", now)};
}

effects core::on_opened(const broker_opened& m, const state& s, instant now) {
  effects out;
  if (m.attempt != attempt_ || phase_ != phase::opening)
    return out;
  phase_ = phase::connected;
  since_ns_ = now.monotonic_ns;
  max_packet_bytes_ = m.max_packet_bytes;
  ++connects_;
  sentence_.clear();
  sent_upto_ = s.events.empty() ? s.next_number - 1 : s.events.front().number - 1;
  taken_.clear();
  unsent_texts_ = 0;
  live_.begin_connection();
  if (connects_ == 1 || !said_.empty())
    out.emplace_back(announce{"connected to " + settings_.broker.text() + " as " + settings_.vehicle, false});
  said_.clear();
  out.emplace_back(publish{attempt_, status_text("online", now)});
  return out;
}

effects core::on_closed(const broker_closed& m, instant now) {
  effects out;
  if (m.attempt == attempt_ && phase_ != phase::waiting)
    fail(out, m.why, m.sentence, now);
  return out;
}

// SplitMix64 (Steele, Lea, Flood 2014) of seed and number.
double core::jitter() const {
  auto z = seed_ + failures_ * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1.0p-53;
}

// The pause grows from one failure to the next, up to a random length: a thousand vehicles whose broker comes back do
// not all come at once. Who is driven out by another one of the same name leaves it the longest pause.
void core::fail(effects& out, broker_failure why, const std::string& sentence, instant now) {
  ++failures_;
  const bool was_good = phase_ == phase::connected && now.monotonic_ns - since_ns_ >= steady_after_ns;
  failures_in_a_row_ = was_good ? 1 : failures_in_a_row_ + 1;
  const auto most = why == broker_failure::taken_over
                        ? longest_pause_ns
                        : std::min(longest_pause_ns, shortest_pause_ns << std::min(failures_in_a_row_, max_doublings));
  const auto span = static_cast<double>(most - shortest_pause_ns);
  phase_ = phase::waiting;
  due_ns_ = now.monotonic_ns + shortest_pause_ns + static_cast<std::int64_t>(jitter() * span);
  const auto remedy = remedy_of(why);
  sentence_ = settings_.broker.text() + ": " + sentence + (remedy.empty() ? "" : "; " + std::string(remedy));
  if (said_ != sentence_)
    out.emplace_back(announce{sentence_ + "; it is tried again, and events are kept until then", true});
  said_ = sentence_;
}

effects core::turn(const state& s, instant now) {
  effects out;
  if (phase_ == phase::opening && now.monotonic_ns >= due_ns_) {
    out.emplace_back(close_broker{attempt_});
    fail(out, broker_failure::unreachable, "it does not answer", now);
  } else if (phase_ == phase::waiting && now.monotonic_ns >= due_ns_) {
    out.emplace_back(next_attempt(now));
  } else if (phase_ == phase::connected) {
    send_live(out, now.monotonic_ns);
    send_events(out, s);
  }
  return out;
}

std::int64_t core::next_due_ns() const { return phase_ == phase::connected ? 0 : due_ns_; }

// -- what is live ---------------------------------------------------------------------------------

void core::on_left(const text_left& m) {
  if (m.attempt == attempt_ && unsent_texts_ > 0)
    --unsent_texts_;
}

void core::send_live(effects& out, std::int64_t now_ns) {
  while (unsent_texts_ < max_unsent_texts) {
    auto next = live_.next_due(now_ns);
    if (!next)
      return;
    const auto how = next->row->is_kept ? publication::kind::kept : publication::kind::live;
    publication what{how,
                     topic((next->row->is_kept ? "state/" : "telemetry/") + std::string(io::name_of(next->row->what))),
                     std::move(next->text), 0};
    if (is_too_large(what)) {
      ++too_large_;
      continue;
    }
    ++unsent_texts_;
    ++texts_;
    out.emplace_back(publish{attempt_, std::move(what)});
  }
  live_.hold_back(now_ns);
}

// -- events ---------------------------------------------------------------------------------------

void core::send_events(effects& out, const state& s) {
  if (s.events.empty())
    return;
  const auto first = s.events.front().number;
  sent_upto_ = std::max(sent_upto_, first - 1); // those before it were dropped
  taken_.erase(taken_.begin(), taken_.lower_bound(first));
  std::size_t bytes = 0;
  for (auto number = first; number <= sent_upto_; ++number)
    if (!taken_.contains(number))
      bytes += s.events[number - first].data.size();
  const auto end = std::min(written_upto_, s.events.back().number);
  while (sent_upto_ < end && sent_upto_ + 1 - first - taken_.size() < max_window && bytes < max_window_bytes) {
    const auto& next = s.events[++sent_upto_ - first];
    bytes += next.data.size();
    out.emplace_back(publish{attempt_, event_text(s, next)});
  }
}

void core::on_taken(const event_taken& m) {
  if (m.attempt == attempt_ && phase_ == phase::connected && m.number <= sent_upto_)
    taken_.insert(m.number);
}

std::uint64_t core::taken_upto(const state& s) const {
  if (s.events.empty())
    return 0;
  auto next = s.events.front().number;
  for (auto each = taken_.lower_bound(next); each != taken_.end() && *each == next; ++each)
    ++next;
  return next - 1;
}

std::optional<delivered> core::newly_delivered(const state& s) const {
  const auto upto = taken_upto(s);
  if (s.events.empty() || upto < s.events.front().number)
    return {};
  const auto count = upto - s.events.front().number + 1;
  if (count < events_a_write && upto < sent_upto_)
    return {};
  return delivered{upto};
}

// -- for people -----------------------------------------------------------------------------------

runtime::condition core::health(const state& s) const {
  using runtime::health_colour;
  if (!sentence_.empty())
    return {health_colour::yellow, sentence_ + "; " + std::to_string(s.events.size()) + " events wait"};
  if (s.dropped != 0 && s.events.size() > max_events / 2)
    return {health_colour::yellow, std::to_string(s.dropped) + " events were dropped: there was no broker too long"};
  return {health_colour::green, {}};
}

fleet_view core::view_of(const state& s, instant now) const {
  fleet_view result;
  result.is_connected = is_connected();
  result.broker = settings_.broker.text();
  result.vehicle = settings_.vehicle;
  result.sentence = sentence_;
  if (phase_ == phase::waiting)
    result.next_try_ms = std::max<std::int64_t>(0, due_ns_ - now.monotonic_ns) / ns_per_ms;
  result.waiting = s.events.size();
  result.delivered = s.delivered;
  result.dropped = s.dropped;
  result.connects = connects_;
  result.failures = failures_;
  result.texts = texts_;
  result.skipped = live_.skipped();
  result.too_large = too_large_;
  return result;
}

} // namespace godwit::fleet_link
