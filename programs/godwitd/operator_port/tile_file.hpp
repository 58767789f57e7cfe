// Pictures of the map out of a file, so that the page has a map without internet: GET /tiles/{z}/{x}/{y} and, what
// there is, GET /api/v1/tiles.
//
// The file is an MBTiles 1.3 with png, jpg or webp, as gdal_translate, QGIS and others write it; its rows count from
// the south, those of the address from the north. It is only read. Errors: open, as a sentence. Thread: that of the
// port. Source: https://github.com/mapbox/mbtiles-spec/blob/master/1.3/spec.md
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "io/sqlite/database.hpp"
#include "programs/godwitd/operator_port/route.hpp"

namespace godwit::operator_port {

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

} // namespace godwit::operator_port
