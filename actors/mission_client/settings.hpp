// What can be set about the missions service. Thread: plain values.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace godwit::mission_client {

using std::chrono::milliseconds;

struct settings {
  int max_tries = 5; // of a call that the start of a mission waits for: the mission, a page, what earlier missions left
  milliseconds call_timeout{10'000};  // without a byte; a page or a batch goes on for as long as bytes come,
  milliseconds total_timeout{60'000}; // but not longer than this
  std::chrono::seconds poll_wait{30}; // how long the service may hold back an empty list of assignments
  std::uint32_t page_limit = 2'000;   // rows of a page; the contract's bound
  std::uint32_t batch_limit = 500;    // observations or ignored items in one delivery; the contract's bound
};

// Why GIVEN can not be used, as a sentence for people; nothing: it can.
[[nodiscard]] std::optional<std::string> objection_to(const settings& given);

} // namespace godwit::mission_client
