#include "io/http/content_coding.hpp"

#include <cassert>
#include <new>
#include <vector>

#include <zlib.h>
#include <zstd.h>

#include "io/http/message.hpp"
#include "io/http/response_reader.hpp"

namespace godwit::io::http {
namespace {

constexpr int gzip_only = 16; // added to the window of zlib: neither a zlib stream nor a raw one
constexpr int zlib_memory = 8;
constexpr int zstd_level = 1; // a page of the map in 1 ms; 9 saves 1 % and takes 60 times as long

tl::unexpected<error> not_as_announced(content_coding how, std::string_view why) {
  return failure(errc::malformed,
                 "the body of the answer is not " + std::string(coding_name(how)) + ": " + std::string(why));
}

} // namespace

std::string_view coding_name(content_coding how) { return how == content_coding::gzip ? "gzip" : "zstd"; }

std::optional<content_coding> parse_coding(std::string_view value) {
  if (equals_ignoring_case(value, "gzip") || equals_ignoring_case(value, "x-gzip"))
    return content_coding::gzip;
  if (equals_ignoring_case(value, "zstd"))
    return content_coding::zstd;
  return std::nullopt;
}

// One step of unpacking: from the input that is left into the room that there is.
struct content_decoder::stream {
  explicit stream(content_coding given) : how(given), room(read_piece_bytes) {}
  stream(const stream&) = delete;
  stream& operator=(const stream&) = delete;
  virtual ~stream() = default;

  struct step {
    std::size_t read = 0;
    std::size_t written = 0;
    bool has_ended = false;
    std::string_view error = {};
  };
  [[nodiscard]] virtual step next(std::span<const std::byte> input) = 0;

  content_coding how;
  std::vector<std::byte> room;
  bool has_begun = false;
  bool has_ended = false;
};

namespace {

class gzip_stream final : public content_decoder::stream {
public:
  gzip_stream() : stream(content_coding::gzip) {
    if (inflateInit2(&of_, MAX_WBITS + gzip_only) != Z_OK)
      throw std::bad_alloc();
  }
  ~gzip_stream() override { inflateEnd(&of_); }

  step next(std::span<const std::byte> input) override {
    of_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(input.data()));
    of_.avail_in = static_cast<uInt>(input.size());
    of_.next_out = reinterpret_cast<Bytef*>(room.data());
    of_.avail_out = static_cast<uInt>(room.size());
    const auto code = inflate(&of_, Z_NO_FLUSH);
    step done{input.size() - of_.avail_in, room.size() - of_.avail_out, code == Z_STREAM_END, {}};
    if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR)
      done.error = of_.msg != nullptr ? of_.msg : "wrong data";
    return done;
  }

private:
  z_stream of_{};
};

class zstd_stream final : public content_decoder::stream {
public:
  zstd_stream() : stream(content_coding::zstd), of_(ZSTD_createDStream()) {
    if (of_ == nullptr)
      throw std::bad_alloc();
    [[maybe_unused]] const auto code = ZSTD_DCtx_setParameter(of_, ZSTD_d_windowLogMax, max_zstd_window_log);
    assert(ZSTD_isError(code) == 0);
  }
  ~zstd_stream() override { ZSTD_freeDStream(of_); }

  step next(std::span<const std::byte> input) override {
    ZSTD_inBuffer in{input.data(), input.size(), 0};
    ZSTD_outBuffer out{room.data(), room.size(), 0};
    const auto code = ZSTD_decompressStream(of_, &out, &in);
    step done{in.pos, out.pos, code == 0, {}};
    if (ZSTD_isError(code) != 0)
      done.error = ZSTD_getErrorName(code);
    return done;
  }

private:
  ZSTD_DStream* of_;
};

std::string gzipped(std::string_view body) {
  z_stream to{};
  if (deflateInit2(&to, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + gzip_only, zlib_memory, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  std::string result(deflateBound(&to, body.size()), '\0');
  to.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(body.data()));
  to.avail_in = static_cast<uInt>(body.size());
  to.next_out = reinterpret_cast<Bytef*>(result.data());
  to.avail_out = static_cast<uInt>(result.size());
  [[maybe_unused]] const auto code = deflate(&to, Z_FINISH);
  assert(code == Z_STREAM_END); // the bound of zlib holds
  result.resize(to.total_out);
  deflateEnd(&to);
  return result;
}

std::string zstandard(std::string_view body) {
  std::string result(ZSTD_compressBound(body.size()), '\0');
  const auto size = ZSTD_compress(result.data(), result.size(), body.data(), body.size(), zstd_level);
  assert(ZSTD_isError(size) == 0); // the bound of zstd holds
  result.resize(size);
  return result;
}

} // namespace

content_decoder::content_decoder(content_coding how) {
  if (how == content_coding::gzip)
    stream_ = std::make_unique<gzip_stream>();
  else
    stream_ = std::make_unique<zstd_stream>();
}

content_decoder::~content_decoder() = default;

bool content_decoder::is_complete() const { return stream_->has_ended || !stream_->has_begun; }

result<void> content_decoder::feed(std::span<const std::byte> bytes,
                                   const std::function<bool(std::span<const std::byte>)>& take) {
  auto& s = *stream_;
  bool may_hold_more = false; // the room was full, so that there may be output without input
  while (!bytes.empty() || may_hold_more) {
    if (s.has_ended)
      return bytes.empty() ? result<void>() : not_as_announced(s.how, "bytes come after its end");
    s.has_begun = true;
    const auto done = s.next(bytes);
    if (!done.error.empty())
      return not_as_announced(s.how, done.error);
    bytes = bytes.subspan(done.read);
    s.has_ended = done.has_ended;
    may_hold_more = done.written == s.room.size();
    if (done.written != 0 && !take(std::span<const std::byte>(s.room).first(done.written)))
      return {};
    if (done.read == 0 && done.written == 0 && !done.has_ended)
      return bytes.empty() ? result<void>() : not_as_announced(s.how, "it does not go on");
  }
  return {};
}

std::optional<content_coding> chosen_coding(std::string_view accept_encoding) {
  for (const auto each : {content_coding::zstd, content_coding::gzip})
    if (accept_encoding.find(coding_name(each)) != std::string_view::npos)
      return each;
  return std::nullopt;
}

std::string compressed(std::string_view body, content_coding how) {
  return how == content_coding::gzip ? gzipped(body) : zstandard(body);
}

} // namespace godwit::io::http
