// How a missions service is to run. Thread: plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/link/uri.hpp"
#include "messages/mission/document.hpp"

namespace godwit::sim::missions {

// Certificate with its chain, and key, in PEM.
struct identity {
  std::string certificate;
  std::string key;
};

// Objects on the map that nobody has seen: for pulls of any size.
struct map_request {
  std::size_t count = 0;
  double latitude = 47.397742; // the middle of a square of 30 km
  double longitude = 8.545594;
};

struct service_settings {
  std::string host = "127.0.0.1"; // a name or an address of this computer
  std::uint16_t port = 0;         // 0: any free one
  std::optional<identity> tls;    // none: plain HTTP
  std::optional<identity> wrong_host_tls;
  std::string token;                       // of the vehicles; whoever has none gets a 401
  std::string foreign_token;               // known, but not for these missions: 403; empty: there is none
  std::string database;                    // a file, made where it is missing
  std::vector<mission::document> missions; // that the file does not have yet are put into it
  map_request map;                         // for those of these missions that have no objects yet
  std::vector<std::string> faults;         // in the words of fault.hpp
  std::uint64_t seed = 1;                  // draws what is random: ids and objects
  std::optional<io::link::uri> control;    // tcp_in, on a loopback address
  bool ends_on_signals = false;            // SIGINT and SIGTERM
};

} // namespace godwit::sim::missions
