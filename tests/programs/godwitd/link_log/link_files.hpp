// What the tests of the link log share: frames, a clock that a test sets, and the records of .tlog files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "io/mavlink/tlog/tlog_reader.hpp"
#include "runtime/clock.hpp"

namespace godwit::test {

class set_time final : public runtime::time_source {
public:
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept override { return now_ns; }
  [[nodiscard]] std::int64_t wall_ns() const noexcept override { return 1'781'000'000'000'000'000 + now_ns; }
  std::int64_t now_ns = 0;
};

inline io::mavlink::frame_buffer heartbeat(std::uint8_t sequence = 0) {
  return io::mavlink::encode(io::mavlink::heartbeat{}, {1, 1}, sequence, io::mavlink::signing::off);
}

inline io::mavlink::frame_buffer signed_heartbeat() {
  const std::array<std::byte, io::mavlink::secret_key_size> key{std::byte{1}};
  io::mavlink::signer out(io::mavlink::secret_key(key), io::mavlink::link_id{0}, io::mavlink::signing_time{1000});
  auto frame = io::mavlink::encode(io::mavlink::heartbeat{}, {1, 1}, 0, io::mavlink::signing::on);
  (void)out.sign(frame, 0);
  return frame;
}

struct logged {
  std::uint64_t time_us = 0;
  std::uint32_t id = 0;
  std::uint8_t sequence = 0;
  bool is_signed = false;
  bool operator==(const logged&) const = default;
};

inline std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> result;
  for (const auto& each : std::filesystem::directory_iterator(folder))
    result.push_back(each.path().filename().string());
  std::ranges::sort(result);
  return result;
}

inline std::vector<logged> records_of(const std::filesystem::path& file) {
  std::vector<logged> result;
  io::mcap::file_source source;
  if (!source.open(file))
    return result;
  io::mavlink::tlog_reader reader(source);
  for (auto record = reader.next(); record && *record; record = reader.next())
    result.push_back(
        {(*record)->timestamp_us, (*record)->frame.id(), (*record)->frame.sequence(), (*record)->frame.is_signed()});
  return result;
}

} // namespace godwit::test
