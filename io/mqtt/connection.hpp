// One connection to a broker of MQTT 5, from the first try to its end: it does not come back, and keeps nothing for a
// next one. It publishes, and nothing else (session.hpp).
//
//   [opening: look-up, TCP, TLS] ──> [session] ──lost, refused, end()──> [closed]
//       └────────────── can not be made ───────────────────────────────────^
//
// Errors: given to `closed`, with the reason; what a broker refuses (a message that its user may not publish) closes
// the connection, so that nothing is taken for delivered that is not. Thread: publish and end from any; the work is
// done, and the listener called, in the thread of the context, and not any more when end() has returned. Files of keys
// and passwords are read in that thread.
// Source: MQTT Version 5.0 (OASIS).
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/io_context.hpp>

#include "io/mqtt/broker_uri.hpp"
#include "io/mqtt/failure.hpp"
#include "io/mqtt/message.hpp"

namespace godwit::io::mqtt {

struct connection_settings {
  broker_uri broker;
  std::string client_id;
  std::string username;         // empty: none
  std::string password_file;    // mode 0600, read with each connection; empty: none
  std::string ca_file;          // PEM; these issuers and no others. Empty: those that the system trusts
  std::string certificate_file; // PEM, our own, with key_file; empty: none
  std::string key_file;         // PEM, mode 0600
  std::uint16_t keep_alive_s = 15;
};

struct listener {
  std::function<void(std::uint32_t max_packet_bytes)> opened;
  std::function<void(failure why, const std::string& sentence)> closed; // once, and the last
  // The broker has it; without acknowledgement: it has left.
  std::function<void(std::uint64_t token)> published;
};

class connection {
public:
  static constexpr std::chrono::seconds opening_limit{25}; // look-up, TCP and TLS

  // Returns at once. WILL: published by the broker when the connection is lost, and when it is ended.
  connection(boost::asio::io_context& io, connection_settings settings, message will, listener to);
  connection(const connection&) = delete;
  connection& operator=(const connection&) = delete;
  ~connection() { end(); }

  // What can not be handed over any more is not reported as published. TOKEN: says which, to the listener.
  void publish(const message& what, std::uint64_t token);

  // Does not wait: the last packet goes out within a second, or not at all.
  void end();
  // For its end, so that the broker hears of it before the process is gone. False: not within PATIENCE. Not in the
  // thread of the context.
  bool wait_for_end(std::chrono::milliseconds patience);

private:
  class inner;
  std::shared_ptr<inner> inner_;
};

} // namespace godwit::io::mqtt
