#include "programs/godwitd/operator_port/page_files.hpp"

#include <array>
#include <memory>
#include <span>
#include <stdexcept>

#include <openssl/evp.h>
#include <zlib.h>

#include "io/fields/hex_text.hpp"

namespace godwit::operator_port {
namespace {

// OWASP, "Content Security Policy": scripts, styles and pictures of ours, and our own API. data: and blob: are pictures
// that the page draws or has been sent; no script runs from there.
constexpr std::string_view policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

constexpr int gzip_window = 15 + 16; // zlib.h: a window of 32 KiB, with the head of gzip
constexpr int memory_level = 9;

struct kept_file {
  std::string type;
  std::string plain;
  std::string compressed;
  std::string tag;
};

std::string compress(std::string_view text) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window, memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib can not begin");
  std::string result(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data())); // zlib only reads it
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const auto outcome = deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  if (outcome != Z_STREAM_END)
    throw std::runtime_error("zlib can not compress a file of the page");
  return result;
}

std::string tag_of(std::string_view text) {
  constexpr std::size_t shown_bytes = 12;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("OpenSSL has no SHA-256");
  return '"' + io::hex_of(std::as_bytes(std::span(digest).first<shown_bytes>())) + '"';
}

server_response answer_of(const kept_file& file, const server_request& asked) {
  server_response result;
  result.headers = {{"Content-Security-Policy", std::string(policy)},
                    {"Cache-Control", "no-cache"}, // it asks each time, and is told when it has the newest
                    {"ETag", file.tag},
                    {"Vary", "Accept-Encoding"}};
  result.content_type = file.type;
  if (asked.find("If-None-Match").find(file.tag) != std::string_view::npos) {
    result.status = 304;
    return result;
  }
  const bool takes_gzip = asked.find("Accept-Encoding").find("gzip") != std::string_view::npos;
  if (takes_gzip)
    result.headers.push_back({"Content-Encoding", "gzip"});
  result.body = takes_gzip ? file.compressed : file.plain;
  return result;
}

} // namespace

route_list page_routes(const std::vector<page_file>& files) {
  route_list result;
  for (const auto& each : files) {
    const auto kept = std::make_shared<const kept_file>(
        kept_file{std::string(each.content_type), std::string(each.bytes), compress(each.bytes), tag_of(each.bytes)});
    result.push_back({"GET", each.path, 0,
                      [kept](const server_request& asked, responder answer) { answer.send(answer_of(*kept, asked)); },
                      access::open}); // nothing but the page: what it shows is asked for with its session
  }
  return result;
}

} // namespace godwit::operator_port
