// Tiles of a file as a map asks for them.
#include "programs/godwitd/operator_port/tile_file.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs/godwitd/operator_port/router.hpp"
#include "tests/io/http/server/server_fixture.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace tile_file_test {

using namespace godwit;
using namespace godwit::operator_port;
using io::http::test::raw_client;
using io::http::test::running_server;

class tiles : public testing::Test {
protected:
  // Of zoom 1: one tile in the north-west, one in the south-east. Rows of the file count from the south.
  std::string made(const std::string& format) {
    auto path = folder.file("map.mbtiles");
    auto file = io::sqlite::database::open(path, {.mode = io::sqlite::open_mode::create});
    EXPECT_TRUE(file->exec("CREATE TABLE metadata (name TEXT, value TEXT);"
                           "CREATE TABLE tiles (zoom_level INTEGER, tile_column INTEGER, tile_row INTEGER, tile_data "
                           "BLOB);"
                           "INSERT INTO tiles VALUES (1, 0, 1, x'890050'), (1, 1, 0, x'02');"
                           "INSERT INTO metadata VALUES ('name', 'Test'), ('attribution', '(c) nobody'), ('format', '" +
                           format + "')"));
    return path;
  }

  test::scratch folder;
};

TEST_F(tiles, a_tile_is_found_by_its_row_from_the_north_and_comes_as_it_is_in_the_file) {
  const auto file = tile_file::open(made("png"));
  ASSERT_TRUE(file) << file.error();
  EXPECT_EQ((*file)->read(1, 0, 0), std::string("\x89\0P", 3));
  EXPECT_EQ((*file)->read(1, 1, 1), "\x02");
  EXPECT_FALSE((*file)->read(1, 1, 0));
  for (const auto zoom : {0, 2, 24, 25, 63, 64, 1000})
    EXPECT_FALSE((*file)->read(zoom, 5, 5)) << zoom;
  const auto about = nlohmann::json::parse((*file)->description());
  EXPECT_EQ(about.at("attribution"), "(c) nobody");
  EXPECT_EQ(about.at("min_zoom"), 1);
  EXPECT_EQ(about.at("max_zoom"), 1);
}

TEST_F(tiles, a_browser_gets_a_picture_or_404_and_nothing_strange_is_read) {
  const auto file = tile_file::open(made("jpg"));
  ASSERT_TRUE(file) << file.error();
  router routes(tile_routes(*file), {}, false);
  running_server server(
      [&](server_request asked, responder answer) { routes.answer(std::move(asked), std::move(answer)); });
  const auto ask = [&](const std::string& target) {
    raw_client client(server);
    client.write("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return client.read();
  };
  const auto there = ask("/tiles/1/0/0");
  EXPECT_EQ(there.result_int(), 200U);
  EXPECT_EQ(there["Content-Type"], "image/jpeg");
  EXPECT_EQ(there.body(), std::string("\x89\0P", 3));
  for (const auto* strange : {"/tiles/1/1/0", "/tiles/-1/0/0", "/tiles/1/0x1/0", "/tiles/1/0/99999999999999999999",
                              "/tiles/1/0/", "/tiles/a/b/c", "/tiles/1/0/0%27", "/tiles/62/0/0"})
    EXPECT_EQ(ask(strange).result_int(), 404U) << strange;
  EXPECT_EQ(ask("/api/v1/tiles").result_int(), 200U);
}

TEST_F(tiles, a_file_that_is_none_is_refused_with_the_reason) {
  EXPECT_FALSE(tile_file::open(folder.file("missing.mbtiles")));
  std::ofstream(folder.file("text.mbtiles")) << "no database";
  EXPECT_FALSE(tile_file::open(folder.file("text.mbtiles")));
  const auto vector = tile_file::open(made("pbf"));
  ASSERT_FALSE(vector);
  EXPECT_NE(vector.error().find("png, jpg and webp"), std::string::npos);
}

} // namespace tile_file_test
