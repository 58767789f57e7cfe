#include "programs/godwitd/operator_port/log_api.hpp"

#include <utility>

namespace godwit::operator_port {

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
