// The documents as a browser asks for them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "programs/godwitd/operator_port/operator_port.hpp"
#include "programs/godwitd/operator_port/page_files.hpp"
#include "tests/io/http/server/server_fixture.hpp"
#include "tests/programs/godwitd/scratch.hpp"

namespace documents_test {

using namespace godwit::operator_port;
using godwit::io::http::test::raw_client;

class documents : public testing::Test {
protected:
  documents() {
    std::filesystem::create_directories(site + "/docs/pictures");
    write(site + "/index.html", "<h1>first</h1>");
    write(site + "/docs/safety.html", "<h1>safety</h1>");
    write(site + "/docs/pictures/map.png", "\x89PNG");
    write(site + "/run", "#!/bin/sh\n");
    write(folder.file("secret"), "a key");
    std::filesystem::create_symlink(folder.file("secret"), site + "/link.html");
  }
  ~documents() override {
    if (served)
      served->close();
  }

  static void write(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

  raw_client::answer ask(const std::string& target) {
    if (!served) {
      served = std::make_unique<port>();
      EXPECT_TRUE(served->open({.host = "127.0.0.1", .port = 0, .hosts = {}}, document_routes(site)));
    }
    raw_client client(static_cast<std::uint16_t>(std::stoi(served->place().substr(served->place().find(':') + 1))));
    client.write("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return client.read();
  }

  godwit::test::scratch folder;
  std::string site = folder.file("site");
  std::unique_ptr<port> served;
};

TEST_F(documents, begin_with_their_first_page) {
  for (const std::string start : {"/docs", "/docs/"}) {
    const auto answer = ask(start);
    EXPECT_EQ(answer.result_int(), 302U) << start;
    EXPECT_EQ(answer["Location"], "/docs/index.html");
  }
  EXPECT_EQ(ask("/docs/index.html").body(), "<h1>first</h1>");
}

TEST_F(documents, are_served_with_their_types_and_run_no_scripts) {
  const auto page = ask("/docs/docs/safety.html?from=page");
  EXPECT_EQ(page.result_int(), 200U);
  EXPECT_EQ(page["Content-Type"], "text/html; charset=utf-8");
  const std::string policy(page["Content-Security-Policy"]);
  EXPECT_NE(policy.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(policy.find("script-src"), std::string::npos);
  EXPECT_EQ(page.count("Content-Security-Policy"), 1U);
  EXPECT_EQ(ask("/docs/docs/pictures/map.png")["Content-Type"], "image/png");
  EXPECT_EQ(ask("/docs/run")["Content-Type"], "text/plain; charset=utf-8");
}

TEST_F(documents, lead_to_nothing_outside_of_their_folder) {
  for (const std::string target : {"/docs/../secret", "/docs/docs/../../secret", "/docs/%2e%2e/secret", "/docs//secret",
                                   "/docs/link.html", "/docs/docs", "/docs/docs/", "/docs/none.html"})
    EXPECT_EQ(ask(target).result_int(), 404U) << target;
}

TEST_F(documents, that_are_not_installed_say_where_they_are_to_be_had) {
  std::filesystem::remove_all(site);
  const auto answer = ask("/docs/index.html");
  EXPECT_EQ(answer.result_int(), 404U);
  EXPECT_NE(answer.body().find("godwit-doc"), std::string::npos) << answer.body();
}

} // namespace documents_test
