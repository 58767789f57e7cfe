// What can be looked at: /healthz, /status and /metrics.
//
//   GET /healthz   the newest health; 503 when it is red, or nobody has looked for 5 s
//   GET /status    a report as JSON; GET /metrics the same as figures for Prometheus
//
// A report is at most max_report_age old: an older one is asked for anew, and all who ask meanwhile get that one. When
// none comes within report_patience they are told so. Nothing here waits for an actor. Thread: that of the context.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "actors/health/report_port.hpp"
#include "actors/telemetry_stream/hub.hpp"
#include "io/prometheus/text.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "runtime/clock.hpp"

namespace godwit::operator_port {

struct view_parts {
  std::shared_ptr<health::report_port> reports;
  std::function<void()> ask_for_report;                                        // quick; from the port's thread
  std::function<void(io::prometheus::text_writer& out)> append_more = nullptr; // figures that are not the actors'
  const runtime::time_source* time = nullptr;                                  // of the health actor
};

class view_api : public std::enable_shared_from_this<view_api> {
public:
  static constexpr std::chrono::milliseconds max_report_age{250};
  static constexpr std::chrono::seconds report_patience{4}; // longer than that of the health actor
  static constexpr std::chrono::seconds health_counts{5};   // it is looked at each second

  view_api(boost::asio::io_context& io, view_parts parts);
  void open();  // reports are heard of from here on
  void close(); // and no more
  [[nodiscard]] route_list routes();

private:
  using clock = std::chrono::steady_clock;
  using form = server_response (view_api::*)(const health::report& made) const;
  struct waiting {
    responder answer;
    form how;
  };

  void say_health(responder answer) const;
  void send_report(responder answer, form how);
  void hand_out(const std::shared_ptr<const health::report>& made);
  void give_up();
  [[nodiscard]] server_response as_json(const health::report& made) const;
  [[nodiscard]] server_response as_metrics(const health::report& made) const;

  boost::asio::io_context& io_;
  view_parts parts_;
  boost::asio::steady_timer patience_;
  std::optional<clock::time_point> made_at_; // of the newest report
  std::vector<waiting> waiting_;             // at most one for each client
};

// What godwitd has logged of late, for who opens the page later: GET /api/v1/log.
//
//   log ──publish──> hub ──text──> add: the newest max_lines ──> {"lines": [...]}, the oldest first, as the stream has
//   them
//
// Thread: add by any; the route in that of the port.
class log_api : public std::enable_shared_from_this<log_api> {
public:
  static constexpr std::size_t max_lines = 500; // the oldest goes

  // LINE: as it was published.
  void add(telemetry_stream::text_ptr line);
  [[nodiscard]] route_list routes();

private:
  std::mutex mutex_; // over all that follows
  std::deque<telemetry_stream::text_ptr> lines_;
};

} // namespace godwit::operator_port
