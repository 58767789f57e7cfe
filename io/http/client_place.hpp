// The place of a connection among those that a server has at a time, made by whoever counts them
// (server_hooks::admit). It stays with the connection, also when that becomes a WebSocket, and is given back with it.
//
// Thread: end_connection and is_websocket in that of the context; prove by any; destroyed in any.
#pragma once

#include <functional>
#include <string>

namespace godwit::io::http {

class client_place {
public:
  client_place() = default;
  client_place(const client_place&) = delete;
  client_place& operator=(const client_place&) = delete;
  virtual ~client_place() = default;

  // A request that came by it has a session.
  virtual void prove(const std::string& session) { static_cast<void>(session); }

  std::function<void()> end_connection = {}; // set by the connection, for as long as there is one
  bool is_websocket = false;                 // set by the connection when it becomes one
};

} // namespace godwit::io::http
