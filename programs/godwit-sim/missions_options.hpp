// The options of `godwit-sim missions`: as they are typed, and what they mean for the service.
//
// Reads the files that they name: tokens and keys (mode 0600), certificates, missions. Errors: a sentence that names
// the option, the value and the allowed form. Thread: any; blocks on the disk.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "programs/godwit-sim/missions/settings.hpp"

namespace godwit::sim {

struct missions_arguments {
  std::string listen = "127.0.0.1:0";
  std::string tls;            // CERT,KEY
  std::string wrong_host_tls; // CERT,KEY
  std::string token_file;
  std::string foreign_token_file;
  std::vector<std::string> missions;
  bool allow_partial = false;
  std::string database;
  std::vector<std::string> faults;
  std::string control;
  std::uint64_t seed = 1;
  std::uint64_t map_objects = 0;
  std::string around; // LAT,LON; empty: the return point of the first mission
  bool is_quiet = false;
};

struct missions_request {
  missions::service_settings settings;
  std::vector<std::string> notes; // for people: what is served, and what could not be carried over
};

[[nodiscard]] tl::expected<missions_request, std::string> read(const missions_arguments& given);

} // namespace godwit::sim
