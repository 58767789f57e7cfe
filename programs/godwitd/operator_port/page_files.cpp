#include "programs/godwitd/operator_port/page_files.hpp"

#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>
#include <openssl/evp.h>
#include <zlib.h>

#include "io/fields/hex_text.hpp"
#include "io/http/server/response_head.hpp"

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

namespace {

constexpr std::int64_t max_zoom = 24; // of what a browser draws
constexpr const char* kept_by_browsers = "private, max-age=86400";

struct type_row {
  std::string_view format;
  const char* content_type;
};
constexpr std::array types{type_row{"png", "image/png"}, type_row{"jpg", "image/jpeg"}, type_row{"jpeg", "image/jpeg"},
                           type_row{"webp", "image/webp"}};

const char* type_of(std::string_view format) {
  for (const auto& each : types)
    if (each.format == format)
      return each.content_type;
  return nullptr;
}

std::string metadata(io::sqlite::database& file, const std::string& name) {
  return file.query_text("SELECT value FROM metadata WHERE name = " + io::sqlite::quoted(name)).value_or("");
}

// All digits of TEXT.
std::optional<std::int64_t> number_of(std::string_view text) {
  std::int64_t result = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), result);
  if (failed != std::errc() || end != text.data() + text.size() || result < 0)
    return std::nullopt;
  return result;
}

// The last of PATH between slashes, which is taken off.
std::optional<std::int64_t> take_last(std::string_view& path) {
  const auto slash = path.rfind('/');
  const auto result = number_of(path.substr(slash + 1));
  path = path.substr(0, slash);
  return result;
}

} // namespace

tl::expected<std::shared_ptr<tile_file>, std::string> tile_file::open(const std::string& path) {
  auto file = io::sqlite::database::open(path, {.mode = io::sqlite::open_mode::immutable});
  if (!file)
    return tl::make_unexpected(path + " can not be opened: " + file.error().message);
  auto tile = file->prepare("SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ?");
  if (!tile)
    return tl::make_unexpected(path + " is no MBTiles file: " + tile.error().message);
  const auto format = metadata(*file, "format");
  const auto* const type = type_of(format);
  if (type == nullptr)
    return tl::make_unexpected(path + " has tiles of the format \"" + format + "\"; png, jpg and webp are shown");
  const auto zoom = [&](const char* key, const char* chosen) {
    const auto said = number_of(metadata(*file, key));
    return said ? *said : file->query_integer("SELECT " + std::string(chosen) + "(zoom_level) FROM tiles").value_or(0);
  };
  const nlohmann::json description{{"attribution", metadata(*file, "attribution")},
                                   {"name", metadata(*file, "name")},
                                   {"min_zoom", zoom("minzoom", "min")},
                                   {"max_zoom", zoom("maxzoom", "max")}};
  std::shared_ptr<tile_file> result(new tile_file(*std::move(file), *std::move(tile)));
  result->content_type_ = type;
  result->description_ = description.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return result;
}

std::optional<std::string> tile_file::read(std::int64_t zoom, std::int64_t column, std::int64_t row) {
  if (zoom > max_zoom || column >= std::int64_t{1} << zoom || row >= std::int64_t{1} << zoom)
    return std::nullopt;
  const auto from_south = (std::int64_t{1} << zoom) - 1 - row;
  const auto found = tile_.with(zoom, column, from_south).step();
  std::optional<std::string> result;
  if (found && *found)
    result = tile_.text(0);
  tile_.reset();
  return result;
}

route_list tile_routes(const std::shared_ptr<tile_file>& from) {
  const auto describe = [from](const server_request&, responder answer) { answer.send({.body = from->description()}); };
  const auto show = [from](const server_request& asked, responder answer) {
    auto path = std::string_view(asked.target).substr(0, asked.target.find('?'));
    const auto row = take_last(path);
    const auto column = take_last(path);
    const auto zoom = take_last(path);
    auto picture = row && column && zoom ? from->read(*zoom, *column, *row) : std::nullopt;
    if (!picture)
      return answer.send(io::http::problem_response(404, "The file has no such tile."));
    answer.send({200, from->content_type(), *std::move(picture), {{"Cache-Control", kept_by_browsers}}});
  };
  return {{"GET", "/api/v1/tiles", 0, describe}, {"GET", "/tiles/{}/{}/{}", 0, show}};
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_files = 5'000;             // the site has some 300
constexpr std::uintmax_t max_file_bytes = 8U << 20U; // its largest picture has less than 1 MiB
constexpr const char* first_page = "/docs/index.html";

// The styles stand in the pages.
constexpr const char* documents_policy =
    "default-src 'none'; style-src 'unsafe-inline'; img-src 'self'; frame-ancestors 'none'; "
    "base-uri 'none'; form-action 'none'";

struct type_of_ending {
  std::string_view ending;
  const char* content_type;
};
constexpr std::array document_types{type_of_ending{".html", "text/html; charset=utf-8"},
                                    type_of_ending{".png", "image/png"},
                                    type_of_ending{".svg", "image/svg+xml"},
                                    type_of_ending{".gif", "image/gif"},
                                    type_of_ending{".jpg", "image/jpeg"},
                                    type_of_ending{".webp", "image/webp"},
                                    type_of_ending{".json", "application/json"}};

const char* content_type_of(const std::string& ending) {
  for (const auto& each : document_types)
    if (each.ending == ending)
      return each.content_type;
  return "text/plain; charset=utf-8"; // sources of the tree, to which documents lead
}

using file_table = std::map<std::string, fs::path, std::less<>>; // by the path of the request

file_table files_in(const fs::path& folder) {
  file_table result;
  std::error_code failed;
  fs::recursive_directory_iterator each(folder, fs::directory_options::skip_permission_denied, failed);
  for (; !failed && each != fs::end(each) && result.size() < max_files; each.increment(failed))
    if (fs::symlink_status(each->path(), failed).type() == fs::file_type::regular)
      result.emplace("/docs/" + each->path().lexically_relative(folder).generic_string(), each->path());
  return result;
}

std::optional<std::string> text_of(const fs::path& file) {
  std::error_code failed;
  if (const auto size = fs::file_size(file, failed); failed || size > max_file_bytes)
    return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  std::string result{std::istreambuf_iterator<char>(stream), {}};
  return stream.bad() || !stream.is_open() ? std::nullopt : std::optional(std::move(result));
}

server_response document_at(const file_table& files, std::string_view path) {
  const auto found = files.find(path);
  auto text = found == files.end() ? std::nullopt : text_of(found->second);
  if (text)
    return {200,
            content_type_of(found->second.extension().string()),
            *std::move(text),
            {{"Content-Security-Policy", documents_policy}, {"Cache-Control", "no-cache"}}};
  return io::http::problem_response(
      404, files.empty() ? "The documents are not installed: install godwit-doc, or make them with ./dev docs and name "
                           "their folder in operator.docs."
                         : "There is no such document.");
}

} // namespace

route_list document_routes(const std::string& folder) {
  const auto files = std::make_shared<const file_table>(folder.empty() ? file_table{} : files_in(folder));
  const auto begin = [](const server_request&, responder answer) {
    answer.send({302, "text/plain; charset=utf-8", {}, {{"Location", first_page}}});
  };
  const auto show = [files](const server_request& asked, responder answer) {
    answer.send(document_at(*files, path_of(asked.target)));
  };
  return {{"GET", "/docs", 0, begin}, {"GET", "/docs/", 0, begin}, {"GET", "/docs/*", 0, show}};
}

} // namespace godwit::operator_port
