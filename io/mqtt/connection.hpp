// One connection to a broker of MQTT 5, from the first try to its end: it does not come back, and keeps nothing for a
// next one.
//
//   [opening] ──CONNACK──> [open] ──lost, refused, end()──> [closed]
//       └────────────── can not be made ───────────────────────^
//
// It has a thread of its own, because looking up a name and making a connection block in libmosquitto. Errors: told to
// `closed`, with the reason; what a broker refuses (a message that its user may not publish) closes the connection, so
// that nothing is taken for delivered that is not. Thread: publish and end from any; the listener is called in the
// connection's thread, and not any more when end() has returned.
// Source: MQTT Version 5.0 (OASIS), mosquitto.h 2.0.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "io/mqtt/broker_uri.hpp"
#include "io/mqtt/failure.hpp"

namespace godwit::io::mqtt {

struct connection_settings {
  broker_uri broker;
  std::string client_id;
  std::string username;         // empty: none
  std::string password_file;    // mode 0600, read with each connection; empty: none
  std::string ca_file;          // PEM; these issuers and no others. Empty: those that the system trusts
  std::string certificate_file; // PEM, our own, with key_file; empty: none
  std::string key_file;         // PEM, mode 0600
  int keep_alive_s = 15;        // the broker publishes the will when it has heard nothing for 1.5 times that
};

struct message {
  std::string topic;
  std::shared_ptr<const std::string> payload; // JSON
  bool is_acknowledged = false;               // QoS 1; else 0
  bool is_retained = false;
  std::uint32_t expires_s = 0; // the broker keeps it no longer for who is away; 0: for ever
};

struct listener {
  std::function<void()> opened;
  std::function<void(failure why, const std::string& sentence)> closed; // once, and the last
  // The broker has it; without acknowledgement: it has left.
  std::function<void(std::uint64_t token)> published;
};

class connection {
public:
  // Returns at once. WILL: published by the broker when the connection is lost, and when it is ended.
  connection(connection_settings wanted, message will, listener ears);
  connection(const connection&) = delete;
  connection& operator=(const connection&) = delete;
  ~connection() { end(); }

  // What can not be handed over any more is not told as published. TOKEN: says which, to the listener.
  void publish(const message& what, std::uint64_t token);

  // Does not wait. What still waits for the network goes on without anybody who listens.
  void end();
  // For its end, so that the broker hears of it before the process is gone. False: not within PATIENCE.
  bool wait_for_end(std::chrono::milliseconds patience);

private:
  class inner;
  std::shared_ptr<inner> inner_;
};

} // namespace godwit::io::mqtt
