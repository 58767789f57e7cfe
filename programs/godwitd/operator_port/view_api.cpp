#include "programs/godwitd/operator_port/view_api.hpp"

#include <utility>

#include <boost/asio/post.hpp>

#include "actors/health/report_text.hpp"
#include "io/http/server/response_head.hpp"

namespace godwit::operator_port {

view_api::view_api(boost::asio::io_context& io, view_parts parts) : io_(io), parts_(std::move(parts)), patience_(io) {}

void view_api::open() {
  parts_.reports->on_published([self = weak_from_this(), &io = io_, reports = parts_.reports] {
    boost::asio::post(io, [self] {
      if (const auto api = self.lock())
        api->hand_out(api->parts_.reports->newest());
    });
  });
}

void view_api::close() {
  parts_.reports->on_published({});
  patience_.cancel();
  waiting_.clear();
}

route_list view_api::routes() {
  const auto self = shared_from_this();
  return {
      {"GET", "/healthz", 0, [self](const server_request&, responder answer) { self->say_health(std::move(answer)); }},
      {"GET", "/status", 0,
       [self](const server_request&, responder answer) { self->send_report(std::move(answer), &view_api::as_json); }},
      {"GET", "/metrics", 0, [self](const server_request&, responder answer) {
         self->send_report(std::move(answer), &view_api::as_metrics);
       }}};
}

void view_api::say_health(responder answer) const {
  const auto [at_ns, status] = parts_.reports->newest_health();
  if (at_ns == 0 || parts_.time->monotonic_ns() - at_ns > std::chrono::nanoseconds(health_counts).count())
    return answer.send(io::http::problem_response(
        503, "The health of the program was not checked of late: the actor health does not run."));
  answer.send({.status = status.worst == health::colour::red ? 503U : 200U, .body = health::json_of(status)});
}

void view_api::send_report(responder answer, form how) {
  if (made_at_ && clock::now() - *made_at_ < max_report_age)
    return answer.send((this->*how)(*parts_.reports->newest()));
  if (waiting_.empty()) {
    patience_.expires_after(report_patience);
    patience_.async_wait([self = weak_from_this()](const boost::system::error_code& cancelled) {
      const auto api = self.lock();
      if (!cancelled && api)
        api->give_up();
    });
    parts_.ask_for_report();
  }
  waiting_.push_back({std::move(answer), how});
}

void view_api::hand_out(const std::shared_ptr<const health::report>& made) {
  patience_.cancel();
  made_at_ = clock::now();
  for (auto& each : std::exchange(waiting_, {}))
    each.answer.send((this->*each.how)(*made));
}

void view_api::give_up() {
  for (auto& each : std::exchange(waiting_, {}))
    each.answer.send(io::http::problem_response(503, "The actor health does not answer; godwitd ctl status may."));
}

server_response view_api::as_json(const health::report& made) const { return {.body = health::json_of(made)}; }

server_response view_api::as_metrics(const health::report& made) const {
  io::prometheus::text_writer out;
  health::append_metrics(out, made);
  if (parts_.append_more)
    parts_.append_more(out);
  return {.content_type = std::string(io::prometheus::content_type), .body = out.text()};
}

void log_api::add(telemetry_stream::text_ptr line) {
  const std::lock_guard guard(mutex_);
  lines_.push_back(std::move(line));
  if (lines_.size() > max_lines)
    lines_.pop_front();
}

route_list log_api::routes() {
  return {{"GET", "/api/v1/log", 0, [self = shared_from_this()](const server_request&, responder answer) {
             std::string body = R"({"lines":[)";
             {
               const std::lock_guard guard(self->mutex_);
               for (const auto& each : self->lines_)
                 body.append(each == self->lines_.front() ? "" : ",").append(*each);
             }
             answer.send({.body = body + "]}"});
           }}};
}

} // namespace godwit::operator_port
