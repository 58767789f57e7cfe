#include "programs/godwitd/operator_port/stream_api.hpp"

#include <utility>

#include <boost/asio/post.hpp>

#include "io/http/server/response_head.hpp"
#include "programs/godwitd/operator_port/stream_query.hpp"

namespace godwit::operator_port {

using io::http::close_code;
using io::http::problem_response;
using telemetry_stream::subscriber;

// One WebSocket and its place in the hub.
class stream_client : public std::enable_shared_from_this<stream_client> {
public:
  explicit stream_client(std::weak_ptr<stream_api> of) : of_(std::move(of)) {}

  void begin(boost::asio::io_context& io, const io::http::websocket_settings& set) {
    line_ = std::make_shared<io::http::websocket>(
        io, set, io::http::websocket_hooks{[this] { pump(); }, {}, [this](const std::string&) { leave(); }});
  }
  [[nodiscard]] io::http::websocket& line() { return *line_; }
  void listen(std::shared_ptr<subscriber> place) { place_ = std::move(place); }

  // Sends on what there is, one text after the other.
  void pump() {
    if (is_writing_ || !line_->is_open())
      return;
    if (place_->has_ended())
      return line_->close(close_code::try_again_later, "too slow: begin anew");
    auto next = place_->take();
    if (!next)
      return;
    is_writing_ = true;
    line_->write(std::move(next), [this] {
      is_writing_ = false;
      pump();
    });
  }

private:
  // The WebSocket calls nobody any more.
  void leave() {
    const auto self = shared_from_this();
    place_.reset();
    if (const auto api = of_.lock())
      api->clients_.erase(self);
  }

  std::weak_ptr<stream_api> of_;
  std::shared_ptr<io::http::websocket> line_;
  std::shared_ptr<subscriber> place_;
  bool is_writing_ = false;
};

stream_api::stream_api(boost::asio::io_context& io, std::shared_ptr<telemetry_stream::hub> from,
                       const io::http::websocket_settings& set)
    : io_(io), hub_(std::move(from)), set_(set) {}

stream_api::~stream_api() = default;

route_list stream_api::routes() {
  return {{"GET", "/api/v1/stream", 0, [self = shared_from_this()](const server_request& asked, responder answer) {
             self->welcome(asked, std::move(answer));
           }}};
}

void stream_api::welcome(const server_request& asked, responder answer) {
  const auto refuse = [&](server_response with) {
    ++refused_;
    answer.send(std::move(with));
  };
  const auto wanted = read_topics(asked.target);
  if (!wanted)
    return refuse(problem_response(400, wanted.error()));
  if (!io::http::is_websocket_request(asked)) {
    auto said = problem_response(426, "This is a WebSocket: ask for it with a client of WebSockets.");
    said.headers.push_back({"Upgrade", "websocket"});
    return refuse(std::move(said));
  }
  const auto client = std::make_shared<stream_client>(weak_from_this());
  auto place = hub_->subscribe(*wanted, [&io = io_, who = std::weak_ptr(client)] {
    boost::asio::post(io, [who] {
      if (const auto awake = who.lock())
        awake->pump();
    });
  });
  if (!place)
    return refuse(problem_response(503, place.error() + "."));
  client->listen(*std::move(place));
  client->begin(io_, set_);
  clients_.insert(client);
  ++opened_;
  bool is_there = false; // else it has gone meanwhile
  answer.upgrade([&](std::unique_ptr<io::http::connection> taken, const std::string& early) {
    is_there = true;
    client->line().accept(asked, std::move(taken), early);
  });
  if (!is_there)
    clients_.erase(client);
}

void stream_api::close() {
  while (!clients_.empty()) {
    const auto each = *clients_.begin();
    each->line().end("godwitd ends");
    clients_.erase(each);
  }
}

void stream_api::append_metrics(io::prometheus::text_writer& out) const {
  using io::prometheus::metric_kind;
  const auto counted = hub_->counts();
  out.one("godwit_stream_subscribers", metric_kind::gauge, "Subscribers of the stream of telemetry.",
          counted.subscribers);
  out.one("godwit_stream_ended_total", metric_kind::counter, "Subscribers ended because they were too slow.",
          counted.ended);
  out.one("godwit_stream_handshakes_total", metric_kind::counter, "Requests for the stream that were taken.", opened_);
  out.one("godwit_stream_handshakes_refused_total", metric_kind::counter, "Requests for the stream that were not.",
          refused_);
  out.begin("godwit_stream_texts_total", metric_kind::counter, "Texts that were published, by topic.");
  for (const auto& [what, name] : enum_names(telemetry_stream::topic{}))
    out.add(counted.published[static_cast<std::size_t>(what)], {{"topic", name}});
  out.begin("godwit_stream_dropped_total", metric_kind::counter, "Texts that slow subscribers have missed, by topic.");
  for (const auto& [what, name] : enum_names(telemetry_stream::topic{}))
    out.add(counted.dropped[static_cast<std::size_t>(what)], {{"topic", name}});
}

} // namespace godwit::operator_port
