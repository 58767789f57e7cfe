#include "io/http/secret_file.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <unistd.h>

#include "tests/io/http/http_fixture.hpp"

namespace godwit::io::http::test {
namespace secret_file_test {

class http_secret_file : public http_fixture {
protected:
  [[nodiscard]] std::string sentence(const std::string& content, mode_t mode = 0600) const {
    const auto loaded = load_token(store("token", content, mode));
    return loaded ? "" : loaded.error().message();
  }
};

TEST_F(http_secret_file, gives_the_token_without_its_end_of_line) {
  for (const auto* content : {"abc.DEF-1_~+/=", "abc.DEF-1_~+/=\n", "abc.DEF-1_~+/=\r\n"}) {
    const auto loaded = load_token(store("token", content));
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->revealed(), "abc.DEF-1_~+/=");
  }
}

TEST_F(http_secret_file, must_have_mode_0600_exactly) {
  for (const mode_t mode : {0644U, 0640U, 0400U, 0700U, 04600U})
    EXPECT_NE(sentence("abc", mode).find("must be 0600"), std::string::npos) << mode;
}

TEST_F(http_secret_file, must_hold_one_token_and_nothing_else) {
  for (const auto* content : {"\n", "two words", "two\nlines", "a\n\n", " a", "a\tb", "caf\xc3\xa9"})
    EXPECT_NE(sentence(content).find("it holds no token"), std::string::npos) << content;
  EXPECT_NE(sentence("").find("it is empty"), std::string::npos);
  EXPECT_NE(sentence(std::string(max_token_bytes + 1, 'a')).find("may have 8192"), std::string::npos);
}

TEST_F(http_secret_file, is_a_regular_file_of_its_own) {
  const auto file = store("token", "abc");
  std::filesystem::create_symlink(file, file + ".link");
  EXPECT_NE(load_token(file + ".link").error().message().find("symbolic link"), std::string::npos);
  EXPECT_NE(load_token("/dev/null").error().message().find("not a regular file"), std::string::npos);
  EXPECT_NE(load_token(file + ".none").error().message().find("no such file"), std::string::npos);
  ASSERT_EQ(::mkfifo((file + ".pipe").c_str(), 0600), 0);
  EXPECT_FALSE(load_token(file + ".pipe")); // and does not hang
}

TEST_F(http_secret_file, must_belong_to_us) {
  if (::geteuid() != 0)
    GTEST_SKIP() << "only root can give a file away";
  const auto file = store("token", "abc");
  ASSERT_EQ(::chown(file.c_str(), 12345, 12345), 0);
  EXPECT_NE(load_token(file).error().message().find("belongs to user id 12345"), std::string::npos);
}

TEST_F(http_secret_file, is_never_shown_in_an_error) {
  EXPECT_EQ(sentence("hunter2 hunter2").find("hunter2"), std::string::npos);
  EXPECT_EQ(sentence("hunter2", 0644).find("hunter2"), std::string::npos);
}

TEST(http_secret_text, moves_without_leaving_itself_behind) {
  secret_text first(3);
  std::copy_n("abc", 3, first.data());
  const char* const room = first.data(); // a short text lies in the object itself
  const secret_text second = std::move(first);
  EXPECT_EQ(second.revealed(), "abc");
  EXPECT_EQ(std::string_view(room, 3), std::string_view("\0\0\0", 3));
}

} // namespace secret_file_test
} // namespace godwit::io::http::test
