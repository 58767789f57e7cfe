// A client of one service over HTTP or HTTPS: requests go in from any thread, answers come back in the client's own.
//
//   auto opened = client::open({.base_url = "https://missions.example/api", .token_file = "/etc/godwit/token"});
//   const auto sent = (*opened)->send({.target = "/missions/7"}, [](result<response> got) { ... });
//
// send() gives a number: then the callback is called exactly once, in the client's thread, whatever happens: answered,
// failed, cancelled, or the client destroyed. Or it gives an error: then the callback is never called.
//
// TLS is 1.2 or newer, and the certificate of the service is verified, with its host; this can not be switched off.
// Redirects are not followed, because the token would go along. Compressed answers come where a request accepts them.
// Cookies, HTTP/2, credentials for a proxy are not there.
//
// A status is an answer and no error; outcome.hpp says what it means for trying again. Nothing is tried again here, but
// for a kept connection that turns out to be dead: once, before a byte of the answer has come, and only for what may be
// sent twice (message.hpp, may_repeat).
//
// Errors: as values (error.hpp). An exception out of a callback or sink is a broken invariant and ends the process, as
// does destroying a client inside of one. Thread: any, but open and destroy by the owner. Callbacks and sinks come one
// at a time; one that takes long holds up all requests of this client. Source: RFC 9110, RFC 9112, RFC 6750.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "io/http/counters.hpp"
#include "io/http/error.hpp"
#include "io/http/message.hpp"
#include "io/http/settings.hpp"

namespace godwit::io::http {

using request_id = std::uint64_t; // rises from 1 in each client

class client {
public:
  using done = std::function<void(result<response>)>;

  // Reads the certificates; connects to nobody. They are read once, the token file for each request. Throws when the
  // system has no thread or descriptor left.
  [[nodiscard]] static result<std::unique_ptr<client>> open(settings wanted);
  // Cancels what is under way, waits for its callbacks, and ends the thread.
  ~client();
  client(const client&) = delete;
  client& operator=(const client&) = delete;

  [[nodiscard]] result<request_id> send(request asked, done then);
  // Nothing happens when that request has ended.
  void cancel(request_id id);
  // Goes on after a sink has asked for a pause. Nothing happens when that request has ended or is not paused; so a sink
  // asks for the pause first and has somebody else call this later.
  void resume(request_id id);

  [[nodiscard]] client_counters counters() const;

private:
  class engine;
  explicit client(std::unique_ptr<engine> running);

  std::unique_ptr<engine> engine_;
};

} // namespace godwit::io::http
