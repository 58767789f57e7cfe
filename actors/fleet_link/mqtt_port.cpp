#include "actors/fleet_link/mqtt_port.hpp"

#include <atomic>
#include <optional>
#include <utility>

namespace godwit::fleet_link {
namespace {

constexpr std::uint32_t live_for_s = 5;
constexpr std::chrono::seconds end_patience{1};
// Of what is no event: the listener is told a token for each publication.
constexpr std::uint64_t token_of_live = 0;
constexpr std::uint64_t token_of_status = ~std::uint64_t{0};

io::mqtt::message message_of(const publication& what) {
  using kind = publication::kind;
  io::mqtt::message result;
  result.topic = what.topic;
  result.payload = what.payload;
  result.is_acknowledged = what.how == kind::event || what.how == kind::status;
  result.is_retained = what.how == kind::kept || what.how == kind::status;
  result.expires_s = what.how == kind::live ? live_for_s : 0;
  return result;
}

std::uint64_t token_of(const publication& what) {
  using kind = publication::kind;
  return what.how == kind::event ? what.number : what.how == kind::status ? token_of_status : token_of_live;
}

} // namespace

// The mutex is held while the gateway is used: it is exchanged by the owner of the port.
struct mqtt_port::way_in {
  std::mutex mutex;
  std::optional<runtime::gateway> gateway;
  port_handle actor;
  std::atomic<bool> broker_retains{true}; // false: it has refused a will that is to be kept, and gets one that is not

  template <class Message>
  void tell(Message what) {
    const std::lock_guard guard(mutex);
    if (gateway)
      gateway->tell(actor, std::move(what));
  }
};

mqtt_port::mqtt_port(const settings& configured) : way_in_(std::make_shared<way_in>()) {
  thread_.start();
  wanted_.broker = configured.broker;
  wanted_.client_id = configured.vehicle;
  wanted_.username = configured.username;
  wanted_.password_file = configured.password_file;
  wanted_.ca_file = configured.ca_file;
  wanted_.certificate_file = configured.certificate_file;
  wanted_.key_file = configured.key_file;
}

mqtt_port::~mqtt_port() { detach(); }

void mqtt_port::attach(runtime::gateway gateway, port_handle actor) {
  const std::lock_guard guard(way_in_->mutex);
  way_in_->gateway.emplace(std::move(gateway));
  way_in_->actor = std::move(actor);
}

void mqtt_port::detach() {
  std::shared_ptr<io::mqtt::connection> ended;
  {
    const std::lock_guard guard(mutex_);
    is_detached_ = true;
    ended = std::move(connection_);
  }
  if (ended) {
    ended->end();
    (void)ended->wait_for_end(end_patience);
  }
  const std::lock_guard guard(way_in_->mutex);
  way_in_->gateway.reset();
}

void mqtt_port::open(std::uint64_t attempt, const publication& will) {
  close(attempt);
  const std::lock_guard guard(mutex_);
  if (is_detached_)
    return;
  attempt_ = attempt;
  auto last_word = message_of(will);
  last_word.is_retained = way_in_->broker_retains;
  connection_ =
      std::make_shared<io::mqtt::connection>(thread_.context(), wanted_, std::move(last_word), listener_of(attempt));
}

io::mqtt::listener mqtt_port::listener_of(std::uint64_t attempt) const {
  io::mqtt::listener result;
  result.opened = [to = way_in_, attempt](std::uint32_t max_packet_bytes) {
    to->tell(broker_opened{attempt, max_packet_bytes});
  };
  result.closed = [to = way_in_, attempt](io::mqtt::failure why, const std::string& sentence) {
    if (why == io::mqtt::failure::retain_refused)
      to->broker_retains = false;
    to->tell(broker_closed{attempt, why, sentence});
  };
  result.published = [to = way_in_, attempt](std::uint64_t token) {
    if (token == token_of_live)
      to->tell(text_left{attempt});
    else if (token != token_of_status)
      to->tell(event_taken{attempt, token});
  };
  return result;
}

void mqtt_port::close(std::uint64_t upto) {
  std::shared_ptr<io::mqtt::connection> ended;
  const std::lock_guard guard(mutex_);
  if (attempt_ <= upto)
    ended = std::move(connection_);
}

void mqtt_port::publish(std::uint64_t attempt, const publication& what) {
  std::shared_ptr<io::mqtt::connection> to;
  {
    const std::lock_guard guard(mutex_);
    if (attempt == attempt_)
      to = connection_;
  }
  if (to)
    to->publish(message_of(what), token_of(what));
}

} // namespace godwit::fleet_link
