#include "runtime/incarnation.hpp"

#include "runtime/caf_mail.hpp"

namespace godwit::runtime {

namespace {

spawn_context hosted_by(incarnation& host, spawn_context context) {
  context.host = &host;
  return context;
}

} // namespace

incarnation::incarnation(caf::actor_config& config, spawn_context context, const actor_maker& make)
    : caf::event_based_actor(config), frame_(make(hosted_by(*this, std::move(context)))) {
  set_exception_handler([this](caf::scheduled_actor*, std::exception_ptr& thrown) {
    return caf::make_error(caf::sec::runtime_error, frame_->crash_reason(thrown));
  });
  set_default_handler([this](caf::scheduled_actor*, caf::message_view&) -> caf::result<caf::message> {
    frame_->receive_unknown();
    return caf::message{};
  });
}

const char* incarnation::name() const { return frame_->actor_name().c_str(); }

caf::behavior incarnation::make_behavior() {
  frame_->start();
  return {[this](const envelope& m) { frame_->receive(m); }};
}

} // namespace godwit::runtime
