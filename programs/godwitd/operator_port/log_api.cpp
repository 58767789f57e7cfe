#include "programs/godwitd/operator_port/log_api.hpp"

#include <utility>

#include <boost/asio/post.hpp>

namespace godwit::operator_port {
namespace {

constexpr std::string_view mark_of_a_line = R"({"topic":"log",)";

} // namespace

void log_api::open(telemetry_stream::hub& from) {
  auto subscribed = from.subscribe({{telemetry_stream::topic::log, 0}}, [self = weak_from_this(), &io = io_] {
    boost::asio::post(io, [self] {
      if (const auto api = self.lock())
        api->hear();
    });
  });
  if (subscribed)
    place_ = *std::move(subscribed);
}

void log_api::close() {
  place_.reset();
  lines_.clear();
}

void log_api::hear() {
  if (!place_)
    return;
  while (auto text = place_->take()) {
    if (!text->starts_with(mark_of_a_line))
      continue;
    lines_.push_back(std::move(text));
    if (lines_.size() > max_lines)
      lines_.pop_front();
  }
}

route_list log_api::routes() {
  return {{"GET", "/api/v1/log", 0, [self = shared_from_this()](const server_request&, responder answer) {
             self->hear();
             std::string body = R"({"lines":[)";
             for (const auto& each : self->lines_)
               body.append(each == self->lines_.front() ? "" : ",").append(*each);
             answer.send({.body = body + "]}"});
           }}};
}

} // namespace godwit::operator_port
