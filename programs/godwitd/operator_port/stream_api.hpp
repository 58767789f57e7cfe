// The stream of telemetry as WebSockets: /api/v1/stream.
//
//   request ──topics──> hub.subscribe ──> subscriber ──take, write, take, write──> WebSocket
//
// Each client has its own queue in the hub, and one text under way: a slow one is dropped from, told, and ended, and
// nobody waits for it. Who says something is closed: there is nothing to say. Errors: 426 and 400 before there is a
// WebSocket, a close code and a reason after. Thread: that of the context; the hub wakes it from any.
#pragma once

#include <cstdint>
#include <memory>
#include <set>

#include <boost/asio/io_context.hpp>

#include "actors/telemetry_stream/hub.hpp"
#include "io/http/server/websocket.hpp"
#include "io/prometheus/text.hpp"
#include "programs/godwitd/operator_port/router.hpp"

namespace godwit::operator_port {

class stream_client;

class stream_api : public std::enable_shared_from_this<stream_api> {
public:
  stream_api(boost::asio::io_context& io, std::shared_ptr<telemetry_stream::hub> from,
             const io::http::websocket_settings& set = {});
  ~stream_api();
  stream_api(const stream_api&) = delete;
  stream_api& operator=(const stream_api&) = delete;

  [[nodiscard]] route_list routes();
  void close(); // all clients
  void append_metrics(io::prometheus::text_writer& out) const;

private:
  friend class stream_client;
  void welcome(const server_request& asked, responder answer);

  boost::asio::io_context& io_;
  std::shared_ptr<telemetry_stream::hub> hub_;
  io::http::websocket_settings set_;
  std::set<std::shared_ptr<stream_client>> clients_; // as many as the port lets in
  std::uint64_t refused_ = 0;                        // requests that became no WebSocket
  std::uint64_t opened_ = 0;
};

} // namespace godwit::operator_port
