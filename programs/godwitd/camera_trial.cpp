#include "programs/godwitd/camera_trial.hpp"

#include <variant>

namespace godwit::daemon {

using executor::preflight::camera_fact;
using executor::preflight::camera_state;

camera_fact camera_trial::look(std::int64_t now_ns) {
  const std::lock_guard guard(mutex_);
  if (is_in_flight_) {
    if (is_trying_)
      finish(now_ns);
    return known_;
  }
  if (is_trying_)
    judge(now_ns);
  else if (now_ns >= due_ns_)
    begin(now_ns);
  return known_;
}

void camera_trial::set_in_flight(bool is_in_flight) {
  const std::lock_guard guard(mutex_);
  is_in_flight_ = is_in_flight;
  if (is_in_flight && is_trying_)
    finish(0);
}

void camera_trial::on_message(std::uint32_t run, const io::eyes::message& said) {
  const std::lock_guard guard(mutex_);
  if (const auto* status = std::get_if<io::eyes::status>(&said); status != nullptr && run == run_)
    status_ = *status;
}

void camera_trial::on_end(std::uint32_t run, const std::string& why) {
  const std::lock_guard guard(mutex_);
  if (run == run_)
    ended_ = why;
}

void camera_trial::begin(std::int64_t now_ns) {
  is_trying_ = true;
  began_ns_ = now_ns;
  status_.reset();
  ended_.reset();
  helper_.start(++run_);
}

void camera_trial::judge(std::int64_t now_ns) {
  if (status_ && status_->looked > 0) {
    known_ = {status_->model_error.empty() ? camera_state::ready : camera_state::not_ready, status_->model_error};
    return finish(now_ns + ready_lasts_ns);
  }
  if (ended_) {
    known_ = {camera_state::not_ready, "godwit-eyes does not run: " + *ended_};
    return finish(now_ns + retry_ns);
  }
  if (now_ns - began_ns_ < patience_ns)
    return;
  known_ = {camera_state::not_ready, !status_              ? "godwit-eyes has sent nothing since it was started"
                                     : status_->frames > 0 ? "pictures come, and godwit-eyes does not look at them"
                                                           : status_->reason};
  if (!status_)
    finish(now_ns + retry_ns);
}

void camera_trial::finish(std::int64_t next_ns) {
  is_trying_ = false;
  due_ns_ = next_ns;
  helper_.end(run_);
}

} // namespace godwit::daemon
