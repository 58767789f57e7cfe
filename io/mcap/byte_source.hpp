// Where a reader takes its bytes from: a file or memory, read at any offset.
//
// Errors: io. Thread: one reader each; several may share one source.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "io/mcap/error.hpp"
#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

class byte_source {
public:
  byte_source() = default;
  virtual ~byte_source() = default;
  byte_source(const byte_source&) = delete;
  byte_source& operator=(const byte_source&) = delete;

  // Fills `to` from `offset` on; gives the bytes read, fewer than asked for only at the end of the source.
  [[nodiscard]] virtual result<std::size_t> read_at(std::uint64_t offset, std::span<std::byte> to) const = 0;
  // When it was opened; a file may have grown since.
  [[nodiscard]] virtual std::uint64_t size_bytes() const = 0;
  // The path, for error texts.
  [[nodiscard]] virtual const std::string& name() const = 0;
};

class file_source final : public byte_source {
public:
  file_source() = default;
  ~file_source() override;

  [[nodiscard]] result<void> open(const std::filesystem::path& path);
  [[nodiscard]] result<std::size_t> read_at(std::uint64_t offset, std::span<std::byte> to) const override;
  [[nodiscard]] std::uint64_t size_bytes() const override { return size_bytes_; }
  [[nodiscard]] const std::string& name() const override { return name_; }

private:
  int descriptor_ = -1;
  std::uint64_t size_bytes_ = 0;
  std::string name_;
};

// The bytes must outlive the source.
class memory_source final : public byte_source {
public:
  explicit memory_source(byte_view bytes, std::string name = {}) : bytes_{bytes}, name_{std::move(name)} {}

  [[nodiscard]] result<std::size_t> read_at(std::uint64_t offset, std::span<std::byte> to) const override;
  [[nodiscard]] std::uint64_t size_bytes() const override { return bytes_.size(); }
  [[nodiscard]] const std::string& name() const override { return name_; }

private:
  byte_view bytes_;
  std::string name_;
};

} // namespace godwit::io::mcap
