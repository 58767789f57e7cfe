// Chunks compressed with Zstandard, the one compression of MCAP that is written and read here.
//
// Both keep their memory from call to call. Errors: as false; what was put out is then not to be used. Thread: one at a
// time. Source: MCAP specification, "Well-known compression formats"; RFC 8878.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "io/mcap/format.hpp"

namespace godwit::io::mcap {

inline constexpr std::string_view zstd_name = "zstd";

class compressor {
public:
  compressor();
  ~compressor();
  compressor(compressor&&) noexcept;
  compressor& operator=(compressor&&) noexcept;

  // Appends RECORDS, compressed, to OUT. False: they do not become smaller.
  [[nodiscard]] bool compress(byte_view records, byte_buffer& out);

private:
  struct context;
  std::unique_ptr<context> context_; // made with the first chunk
};

class decompressor {
public:
  decompressor();
  ~decompressor();
  decompressor(decompressor&&) noexcept;
  decompressor& operator=(decompressor&&) noexcept;

  // OUT becomes the records, which are to be RECORDS_BYTES. The caller has bounded that number.
  [[nodiscard]] bool decompress(byte_view compressed, std::uint64_t records_bytes, byte_buffer& out);

private:
  struct context;
  std::unique_ptr<context> context_;
};

} // namespace godwit::io::mcap
