// The page of operators as it is built (programs/godwitd/page/built), inside of the program: GET / and what it needs.
//
// Each file is sent compressed to who takes gzip, and not again to who has it (ETag). The page runs scripts and styles
// of its own and nothing else, and asks no other host (Content-Security-Policy). Thread: that of the port.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "io/sqlite/database.hpp"
#include "programs/godwitd/operator_port/router.hpp"

namespace godwit::operator_port {

struct page_file {
  std::string_view path; // "/page.js"
  std::string_view content_type;
  std::string_view bytes;
};

// That are built into the program.
[[nodiscard]] std::vector<page_file> page_files();

[[nodiscard]] route_list page_routes(const std::vector<page_file>& files = page_files());

// Pictures of the map out of a file, so that the page has a map without internet: GET /tiles/{z}/{x}/{y} and, what
// there is, GET /api/v1/tiles.
//
// The file is an MBTiles 1.3 with png, jpg or webp, as gdal_translate, QGIS and others write it; its rows count from
// the south, those of the address from the north. It is only read. Errors: open, as a sentence. Thread: that of the
// port. Source: https://github.com/mapbox/mbtiles-spec/blob/master/1.3/spec.md
class tile_file {
public:
  [[nodiscard]] static tl::expected<std::shared_ptr<tile_file>, std::string> open(const std::string& path);

  // The picture, as the file has it; none: there is none.
  [[nodiscard]] std::optional<std::string> read(std::int64_t zoom, std::int64_t column, std::int64_t row);
  [[nodiscard]] const std::string& content_type() const { return content_type_; }
  [[nodiscard]] const std::string& description() const { return description_; } // JSON

private:
  tile_file(io::sqlite::database file, io::sqlite::statement tile) : file_(std::move(file)), tile_(std::move(tile)) {}

  std::string content_type_;
  std::string description_;
  io::sqlite::database file_;
  io::sqlite::statement tile_; // goes before its file
};

[[nodiscard]] route_list tile_routes(const std::shared_ptr<tile_file>& from);

// The documents as pages: GET /docs/... from FOLDER, which `./dev docs` or the package godwit-doc has made. What lies
// in it when this is called can be asked for, and nothing else: no link is followed out of it, and a path is compared
// as a whole. The pages run no scripts. Of a folder that is not there they answer where the documents are to be had.
[[nodiscard]] route_list document_routes(const std::string& folder);

} // namespace godwit::operator_port
