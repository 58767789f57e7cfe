// What godwit-eyes costs as the process that godwitd starts, and how soon it tells what it sees: a flight of the
// generator, recorded as 1280 x 720 at 30 a second, is its camera; poses come ten times a second, and somebody looks at
// the picture.
//
// Errors: a sentence. Thread: one; real time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tests/support/eyes/suite.hpp"

namespace godwit::eyes::test {

struct process_options {
  std::string program;        // godwit-eyes
  int seconds = 30;           // of the recording
  bool has_recording = false; // it records what it sees, too
  std::uint64_t seed = 0;
};

struct process_figures {
  // From the moment at which a picture came out of the decoder to the arrival of the datagram that tells what is in it.
  std::vector<double> latencies_ms;
  double share = 0;       // of a core: all threads, decoding too
  double resident_mb = 0; // in the middle of the run, and at most
  double most_resident_mb = 0;
  double seconds = 0;       // for which it was watched
  std::uint64_t frames = 0; // of the camera, in that time
  std::uint64_t dropped = 0;
  std::uint64_t usable = 0;
  std::uint64_t pictures = 0; // shown to people
};

[[nodiscard]] tl::expected<process_figures, std::string> measure_process(const process_options& options);

} // namespace godwit::eyes::test
