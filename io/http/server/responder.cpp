#include "io/http/server/responder.hpp"

#include <boost/asio/dispatch.hpp>

#include "io/http/server/session.hpp"

namespace godwit::io::http {
namespace {

std::shared_ptr<session> waiting(const std::weak_ptr<session>& to, std::uint64_t request_number) {
  auto found = to.lock();
  return found && found->awaits(request_number) ? found : nullptr;
}

// Runs WHAT in the thread of the server: a session must not be held, and so not end, anywhere else.
template <class What>
void inside(boost::asio::io_context::executor_type where, std::weak_ptr<session> to, std::uint64_t request_number,
            What what) {
  boost::asio::dispatch(where, [to = std::move(to), request_number, what = std::move(what)] {
    if (const auto who = waiting(to, request_number))
      what(*who);
  });
}

} // namespace

responder::~responder() {
  if (!to_.expired())
    abort();
}

void responder::send(server_response whole) {
  inside(where_, std::exchange(to_, {}), request_number_,
         [whole = std::move(whole)](session& who) { who.respond(whole); });
}

void responder::abort() {
  inside(where_, std::exchange(to_, {}), request_number_, [](session& who) { who.abort(); });
}

void responder::start(const server_response& what, std::optional<std::uint64_t> body_bytes, next then) {
  if (const auto who = waiting(to_, request_number_))
    who->begin_answer(what, body_bytes, std::move(then));
}

void responder::write(std::string bytes, next then) {
  if (const auto who = waiting(to_, request_number_))
    who->write(std::move(bytes), std::move(then));
}

void responder::finish() {
  if (const auto who = waiting(std::exchange(to_, {}), request_number_))
    who->finish();
}

void responder::on_gone(next then) {
  if (const auto who = waiting(to_, request_number_))
    who->on_gone(std::move(then));
}

void responder::keep_unread() {
  if (const auto who = waiting(to_, request_number_))
    who->keep_unread();
}

void responder::upgrade(const taker& then) {
  if (const auto who = waiting(std::exchange(to_, {}), request_number_))
    who->upgrade(then);
}

} // namespace godwit::io::http
