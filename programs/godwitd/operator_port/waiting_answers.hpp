// Requests that wait for the answer of an actor: each has a ticket, and is answered once or, when nobody does within
// their time, with 504.
//
// The token of a session that is being opened waits here with its request, so that no message carries it. Thread: any;
// an answer is sent in the thread of the port.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "io/http/connection.hpp"
#include "io/http/secret_file.hpp"
#include "io/http/server/responder.hpp"

namespace godwit::operator_port {

class waiting_answers {
public:
  static constexpr std::size_t max_waiting = 64;
  static constexpr std::chrono::seconds patience{6}; // longer than all that operator_bridge and the executor take

  // What goes along as a cookie: the token of a session that is opened, or nothing any more.
  enum class cookie { none, opens_session, ends_session };

  // IS_SECURE: the cookie is for TLS alone.
  explicit waiting_answers(bool is_secure = false) : is_secure_(is_secure) {}

  // None: too many wait, or the end has come; ANSWER was given 503. NEW_TOKEN: of the session that the answer opens.
  // PLACE: of its connection.
  [[nodiscard]] std::optional<std::uint64_t> add(io::http::responder answer, io::http::secret_text new_token = {},
                                                 std::weak_ptr<io::http::client_place> place = {});
  // Whose request is not answered but goes on, to THEN.
  [[nodiscard]] std::optional<std::uint64_t> add(io::http::responder answer,
                                                 std::function<void(io::http::responder)> then,
                                                 std::weak_ptr<io::http::client_place> place = {});
  // It came with SESSION, which is open.
  void prove(std::uint64_t ticket, const std::string& session);
  void resolve(std::uint64_t ticket, io::http::server_response what, cookie with = cookie::none);
  void let_go_on(std::uint64_t ticket);
  // Of those for whom nobody has answered in time.
  void give_up_overdue();
  // Nobody is answered any more: before the port goes.
  void end();

private:
  struct waiting {
    io::http::responder answer;
    io::http::secret_text new_token;
    std::chrono::steady_clock::time_point until;
    std::function<void(io::http::responder)> then = {};
    std::weak_ptr<io::http::client_place> place = {};
  };

  [[nodiscard]] std::optional<std::uint64_t> put(waiting one);
  [[nodiscard]] std::string cookie_of(std::string_view token, bool ends) const;

  const bool is_secure_;

  std::mutex mutex_; // over what stands below
  std::map<std::uint64_t, waiting> waiting_;
  std::uint64_t last_ticket_ = 0;
  bool has_ended_ = false;
};

} // namespace godwit::operator_port
