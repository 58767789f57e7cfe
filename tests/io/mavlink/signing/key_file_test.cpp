#include "io/mavlink/signing/key_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace key_file_test {

namespace fs = std::filesystem;

constexpr std::string_view digits = "000102030405060708090a0b0c0d0e0f101112131415161718191A1B1C1D1E1F";

class mavlink_key_file : public testing::Test {
protected:
  mavlink_key_file() {
    std::string pattern = (fs::temp_directory_path() / "godwit-key-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    path_ = folder_ / "signing.key";
  }
  ~mavlink_key_file() override { fs::remove_all(folder_); }

  void store(std::string_view content, mode_t mode = 0600) const {
    std::ofstream(path_, std::ios::binary) << content;
    ASSERT_EQ(::chmod(path_.c_str(), mode), 0);
  }
  [[nodiscard]] key_file_error refused() const {
    auto loaded = load_key_file(path_);
    return loaded ? key_file_error{} : loaded.error();
  }
  [[nodiscard]] bool holds_counting_key() const {
    const auto loaded = load_key_file(path_);
    return loaded && std::ranges::equal(loaded->bytes(), counting_key().bytes());
  }

  fs::path folder_;
  fs::path path_;
};

TEST_F(mavlink_key_file, holds_64_hexadecimal_digits_with_or_without_an_end_of_line) {
  for (const std::string_view end : {"", "\n", "\r\n"}) {
    store(std::string(digits) + std::string(end));
    EXPECT_TRUE(holds_counting_key());
  }
}

TEST_F(mavlink_key_file, holds_the_32_bytes_themselves) {
  std::string raw;
  for (char c = 0; c < 32; ++c)
    raw += c;
  store(raw);
  EXPECT_TRUE(holds_counting_key());
}

TEST_F(mavlink_key_file, any_other_content_is_refused_and_not_shown) {
  const std::string secret(digits);
  for (const std::string& content : {std::string(), secret.substr(1), secret + "0", secret + "\n\n", secret + "\nmore",
                                     secret.substr(2) + "xy", std::string(31, 'k'), std::string(5000, 'a')}) {
    store(content);
    EXPECT_EQ(refused().code, key_file_errc::not_a_key) << content.size();
    EXPECT_EQ(refused().message().find("0a0b0c"), std::string::npos);
  }
}

TEST_F(mavlink_key_file, a_key_of_zeros_is_refused) {
  store(std::string(64, '0'));
  EXPECT_EQ(refused().code, key_file_errc::all_zero);
}

TEST_F(mavlink_key_file, every_mode_but_0600_is_refused_with_the_remedy) {
  for (const mode_t mode : {0644, 0640, 0604, 0660, 0602, 0700, 0601, 0400, 04600}) {
    store(digits, mode);
    EXPECT_EQ(refused().code, key_file_errc::wrong_mode) << std::oct << mode;
  }
  store(digits, 0644);
  EXPECT_EQ(refused().message(), "signing key " + path_.string() + ": its mode is 0644 and must be 0600: chmod 600 " +
                                     path_.string() + ", and make a new key if others may have read it");
}

TEST_F(mavlink_key_file, a_symbolic_link_is_refused) {
  store(digits);
  const fs::path target = folder_ / "target.key";
  fs::rename(path_, target);
  fs::create_symlink(target, path_);
  EXPECT_EQ(refused().code, key_file_errc::symbolic_link);
}

TEST_F(mavlink_key_file, a_file_of_another_owner_is_refused) {
  store(digits);
  if (::geteuid() != 0)
    GTEST_SKIP() << "only root can give a file away";
  ASSERT_EQ(::chown(path_.c_str(), 12345, 12345), 0);
  EXPECT_EQ(refused().code, key_file_errc::other_owner);
  EXPECT_NE(refused().message().find("chown 0 "), std::string::npos) << refused().message();
}

TEST_F(mavlink_key_file, what_is_no_regular_file_is_refused_without_waiting) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(refused().code, key_file_errc::not_a_file);
  fs::remove(path_);
  fs::create_directory(path_);
  EXPECT_EQ(refused().code, key_file_errc::not_a_file);
}

TEST_F(mavlink_key_file, a_missing_file_is_named_with_the_remedy) {
  EXPECT_EQ(refused().code, key_file_errc::missing);
  EXPECT_NE(refused().message().find("openssl rand -hex 32"), std::string::npos);
}

} // namespace key_file_test
} // namespace godwit::io::mavlink::test
