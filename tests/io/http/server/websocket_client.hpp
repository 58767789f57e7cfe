// A client of WebSockets for tests, which waits for what it asks for, or sends bytes that are none.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace godwit::io::http::test {

class websocket_client {
public:
  // ORIGIN: of the page that it is on; empty: it is no browser.
  websocket_client(std::uint16_t port, const std::string& target, const std::string& origin = {});
  ~websocket_client();
  websocket_client(const websocket_client&) = delete;
  websocket_client& operator=(const websocket_client&) = delete;

  // 101: it is open. Else what the server answered; 0: nothing.
  [[nodiscard]] unsigned status() const;
  // The next text; empty: it was closed.
  [[nodiscard]] std::string read();
  void write(const std::string& text, bool is_text = true);
  void write_raw(const std::string& bytes);
  // Of the server, after the end; 0: it said none.
  [[nodiscard]] unsigned close_code() const;
  [[nodiscard]] std::string close_reason() const;

private:
  struct engine;
  std::unique_ptr<engine> engine_;
};

} // namespace godwit::io::http::test
