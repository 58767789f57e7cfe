#include "io/mcap/compression.hpp"

#include <zstd.h>

namespace godwit::io::mcap {

namespace {

constexpr int level = 3; // Zstandard's own default

} // namespace

struct compressor::context {
  context() : made(ZSTD_createCCtx()) {}
  context(const context&) = delete;
  context& operator=(const context&) = delete;
  ~context() { ZSTD_freeCCtx(made); }
  ZSTD_CCtx* const made;
};

compressor::compressor() = default;
compressor::~compressor() = default;
compressor::compressor(compressor&&) noexcept = default;
compressor& compressor::operator=(compressor&&) noexcept = default;

bool compressor::compress(byte_view records, byte_buffer& out) {
  if (!context_)
    context_ = std::make_unique<context>();
  if (context_->made == nullptr)
    return false;
  const auto before = out.size();
  out.resize(before + records.size()); // less than that, or it is not worth it
  const auto bytes =
      ZSTD_compressCCtx(context_->made, out.data() + before, records.size(), records.data(), records.size(), level);
  const bool is_smaller = ZSTD_isError(bytes) == 0;
  out.resize(before + (is_smaller ? bytes : 0));
  return is_smaller;
}

struct decompressor::context {
  context() : made(ZSTD_createDCtx()) {}
  context(const context&) = delete;
  context& operator=(const context&) = delete;
  ~context() { ZSTD_freeDCtx(made); }
  ZSTD_DCtx* const made;
};

decompressor::decompressor() = default;
decompressor::~decompressor() = default;
decompressor::decompressor(decompressor&&) noexcept = default;
decompressor& decompressor::operator=(decompressor&&) noexcept = default;

bool decompressor::decompress(byte_view compressed, std::uint64_t records_bytes, byte_buffer& out) {
  if (!context_)
    context_ = std::make_unique<context>();
  if (context_->made == nullptr)
    return false;
  out.resize(static_cast<std::size_t>(records_bytes));
  const auto bytes = ZSTD_decompressDCtx(context_->made, out.data(), out.size(), compressed.data(), compressed.size());
  return ZSTD_isError(bytes) == 0 && bytes == records_bytes;
}

} // namespace godwit::io::mcap
