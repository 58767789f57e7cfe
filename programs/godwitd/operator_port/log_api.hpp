// What godwitd has logged of late, for who opens the page later: GET /api/v1/log.
//
//   hub ──topic log──> the newest max_lines ──> {"lines": [...]}, the oldest first, each as the stream has it
//
// A subscriber of the stream like any other. Thread: that of the context.
#pragma once

#include <deque>
#include <memory>

#include <boost/asio/io_context.hpp>

#include "actors/telemetry_stream/hub.hpp"
#include "programs/godwitd/operator_port/route.hpp"

namespace godwit::operator_port {

class log_api : public std::enable_shared_from_this<log_api> {
public:
  static constexpr std::size_t max_lines = 500; // the oldest goes

  explicit log_api(boost::asio::io_context& io) : io_(io) {}
  void open(telemetry_stream::hub& from);
  void close();
  [[nodiscard]] route_list routes();

private:
  void hear();

  boost::asio::io_context& io_;
  std::shared_ptr<telemetry_stream::subscriber> place_;
  std::deque<telemetry_stream::text_ptr> lines_;
};

} // namespace godwit::operator_port
