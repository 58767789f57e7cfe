// The page as a browser asks for it.
#include "programs/godwitd/operator_port/page_files.hpp"

#include <regex>

#include <gtest/gtest.h>
#include <zlib.h>

#include "programs/godwitd/operator_port/operator_port.hpp"
#include "tests/io/http/server/server_fixture.hpp"

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
