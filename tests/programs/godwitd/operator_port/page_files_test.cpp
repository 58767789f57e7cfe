// The page as a browser asks for it.
#include <fstream>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "programs/godwitd/operator_port/operator_port.hpp"
#include "programs/godwitd/operator_port/page_files.hpp"
#include "programs/godwitd/operator_port/router.hpp"
#include "tests/io/http/server/server_fixture.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace page_files_test {

using namespace godwit::operator_port;
using godwit::io::http::test::get;
using godwit::io::http::test::raw_client;

class page_served : public testing::Test {
protected:
  page_served() {
    EXPECT_TRUE(all.open({.host = "127.0.0.1", .port = 0, .hosts = {}}, page_routes()));
    number = static_cast<std::uint16_t>(std::stoi(all.place().substr(all.place().find(':') + 1)));
  }
  ~page_served() override { all.close(); }

  raw_client::answer ask(const std::string& target, const std::string& headers = {}) const {
    raw_client client(number);
    client.write("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n");
    return client.read();
  }

  port all;
  std::uint16_t number = 0;
};

std::string unzipped(const std::string& text) {
  constexpr int gzip_window = 15 + 16;
  std::string result(4'000'000, '\0');
  z_stream stream{};
  inflateInit2(&stream, gzip_window);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  inflateEnd(&stream);
  return result;
}

TEST_F(page_served, each_file_has_its_type_and_who_takes_gzip_gets_the_same_bytes_smaller) {
  for (const auto& each : page_files()) {
    const auto plain = ask(std::string(each.path));
    EXPECT_EQ(plain.result_int(), 200U) << each.path;
    EXPECT_EQ(plain["Content-Type"], each.content_type);
    EXPECT_EQ(plain.body(), each.bytes) << each.path;
    const auto small = ask(std::string(each.path), "Accept-Encoding: gzip, deflate, br\r\n");
    EXPECT_EQ(small["Content-Encoding"], "gzip");
    EXPECT_EQ(unzipped(small.body()), each.bytes) << each.path;
  }
}

TEST_F(page_served, who_has_a_file_is_not_sent_it_again) {
  const auto first = ask("/page.js");
  const std::string tag(first["ETag"]);
  ASSERT_FALSE(tag.empty());
  const auto again = ask("/page.js", "If-None-Match: " + tag + "\r\n");
  EXPECT_EQ(again.result_int(), 304U);
  EXPECT_TRUE(again.body().empty());
  EXPECT_EQ(ask("/page.js", "If-None-Match: \"older\"\r\n").result_int(), 200U);
  EXPECT_NE(tag, ask("/page.css")["ETag"]);
}

TEST_F(page_served, it_runs_no_script_but_its_own_and_is_shown_in_nobodys_frame) {
  const auto answer = ask("/");
  const std::string policy(answer["Content-Security-Policy"]);
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(policy.find("script-src 'self';"), std::string::npos);
  EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  EXPECT_EQ(answer["X-Content-Type-Options"], "nosniff");
  EXPECT_EQ(answer.count("Content-Security-Policy"), 1U);
  EXPECT_EQ(answer.count("Cache-Control"), 1U);
}

TEST_F(page_served, it_names_only_files_that_there_are_and_has_no_script_of_its_own_inside) {
  const auto text = ask("/").body();
  const std::regex named(R"re((?:src|href)="([^"]+)")re");
  int found = 0;
  for (std::sregex_iterator each(text.begin(), text.end(), named), end; each != end; ++each, ++found)
    EXPECT_EQ(ask((*each)[1].str()).result_int(), 200U) << (*each)[1].str();
  EXPECT_GE(found, 3);
  EXPECT_FALSE(std::regex_search(text, std::regex(R"(<script[^>]*>[^<]|<style|\son[a-z]+=)")));
}

} // namespace page_files_test

namespace tile_file_test {

using namespace godwit;
using namespace godwit::operator_port;
using io::http::test::raw_client;
using io::http::test::running_server;

// Tiles of a file as a map asks for them.

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
