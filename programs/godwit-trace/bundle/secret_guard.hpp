// Looks for the contents of secret files in what is about to leave the machine.
//
// The files are those that the configuration names: a token, keys of links as text or bytes, a PEM key. What is shorter
// than `shortest` is no secret. Errors: a sentence for a file that can not be read. Blocks on the disk. Thread: one at
// a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

namespace godwit::trace_tool {

class secret_guard {
public:
  static constexpr std::size_t shortest = 8;
  static constexpr std::size_t longest_file = std::size_t{64} << 10U;
  static constexpr std::size_t max_lines = 4; // of a PEM key; one is enough to know it

  [[nodiscard]] tl::expected<void, std::string> add_file(const std::filesystem::path& file);

  // The name of the file whose secret stands in it; empty: none does.
  [[nodiscard]] std::string found_in(std::string_view text) const;
  // In the first SIZE_BYTES of FILE. What can not be read counts as found.
  [[nodiscard]] std::string found_in_file(const std::filesystem::path& file, std::uint64_t size_bytes) const;

private:
  struct secret {
    std::string file;
    std::string text;
  };
  void add(const std::string& file, std::string text);

  std::vector<secret> secrets_;
  std::size_t longest_ = 0;
};

} // namespace godwit::trace_tool
