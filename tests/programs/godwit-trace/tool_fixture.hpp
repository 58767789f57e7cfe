// What the tests of godwit-trace share: a console whose text is kept, frames, and a folder that goes away.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/mavlink/codec.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/signing/signer.hpp"
#include "programs/godwit-trace/output.hpp"

namespace godwit::trace_tool::test {

inline constexpr std::uint64_t some_day_us = 1'781'000'000'123'456; // 2026-06-09T10:13:20.123456Z

// Where an `output` writes, in memory.
class memory_file {
public:
  memory_file();
  ~memory_file();
  memory_file(const memory_file&) = delete;
  memory_file& operator=(const memory_file&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::string text() const;

private:
  int descriptor_;
};

// A console whose text is kept.
class kept_console {
  memory_file out_file_;
  memory_file words_file_;
  output out_{out_file_.descriptor()};
  output words_{words_file_.descriptor()};

public:
  console to{out_, words_};

  // After a flush.
  [[nodiscard]] std::string out();
  [[nodiscard]] std::string words();
};

[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);
[[nodiscard]] std::string capture(const std::string& name); // its path

class temporary_folder {
public:
  temporary_folder();
  ~temporary_folder();
  temporary_folder(const temporary_folder&) = delete;
  temporary_folder& operator=(const temporary_folder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

private:
  std::filesystem::path path_;
};

// The key of a test: 32 bytes that begin with FIRST and go up by one.
[[nodiscard]] io::mavlink::secret_key counting_key(std::uint8_t first = 1);

template <io::mavlink::message M>
[[nodiscard]] io::mavlink::frame_buffer frame_of(const M& message, std::uint8_t sequence = 0,
                                                 io::mavlink::sender from = {1, 1}) {
  return io::mavlink::encode(message, from, sequence);
}

// A frame of an id that is in no table (54321), or of one that is, with this payload.
[[nodiscard]] io::mavlink::frame_buffer raw_frame(std::uint32_t id, const std::vector<std::uint8_t>& payload);

} // namespace godwit::trace_tool::test
