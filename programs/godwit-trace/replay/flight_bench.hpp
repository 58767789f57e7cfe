// godwitd's actors on the bench of a replay, joined by the daemon's own code: the replayed one runs, and the others are
// only there to be told. Nothing is opened: no port, no file, no clock of this machine.
//
// Errors: sentences for people. Thread: one.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <tl/expected.hpp>

#include "programs/godwitd/settings.hpp"
#include "runtime/replay/actor_bench.hpp"

namespace godwit::trace_tool {

// What the actors of a process have that others of the same settings do not.
struct recorded_process {
  std::uint64_t run = 0;
  std::uint64_t seed = 0;
};

class flight_bench {
public:
  // SETTINGS of the record. The error: why ACTOR can not be replayed, or that there is none of that name.
  [[nodiscard]] static tl::expected<std::unique_ptr<flight_bench>, std::string>
  make(const std::string& actor, const daemon::daemon_settings& settings, const recorded_process& of);
  flight_bench(const flight_bench&) = delete;
  flight_bench& operator=(const flight_bench&) = delete;
  ~flight_bench();

  [[nodiscard]] runtime::actor_bench& bench();

private:
  flight_bench(const daemon::daemon_settings& settings, const recorded_process& of);

  struct parts;
  std::unique_ptr<parts> parts_;
};

} // namespace godwit::trace_tool
