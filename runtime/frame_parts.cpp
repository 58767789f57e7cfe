#include "runtime/frame_parts.hpp"

#include <vector>

#include "io/fields/binary.hpp"
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

namespace {

constexpr std::size_t max_dead_letter_bytes = 64 * 1024; // of the encoded message

std::string body_of(const envelope& m) {
  std::vector<std::byte> memory(max_dead_letter_bytes);
  io::byte_sink sink(memory);
  m.type->encode(sink, m.body.data());
  if (sink.overflow())
    return R"({"too_long":true})";
  std::string text;
  io::byte_source source(std::span<const std::byte>(memory.data(), sink.used()));
  m.type->append_decoded(text, source);
  return text;
}

} // namespace

dead_letter make_dead_letter(const envelope& m, std::int64_t at_ns, std::string sender, int crashes,
                             std::string reason) {
  return {m.head.id, m.head.cause,     at_ns, std::move(sender), std::string(m.type->name), body_of(m),
          crashes,   std::move(reason)};
}

} // namespace godwit::runtime
