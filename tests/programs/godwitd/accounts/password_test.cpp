#include "programs/godwitd/accounts/password.hpp"

#include <gtest/gtest.h>

namespace password_test {

using namespace godwit::accounts;

// As cheap as scrypt can be: what is tested is not its cost.
password_hash cheap() {
  password_hash result;
  result.n = 2;
  result.r = 1;
  result.p = 1;
  return result;
}

TEST(password, is_known_again_and_no_other_is) {
  const auto kept = hash_password("correct horse", cheap());
  EXPECT_TRUE(is_password("correct horse", kept));
  EXPECT_FALSE(is_password("correct horsf", kept));
  EXPECT_FALSE(is_password("", kept));
}

TEST(password, the_same_one_is_kept_differently_each_time) {
  EXPECT_NE(hash_password("correct horse", cheap()).hash, hash_password("correct horse", cheap()).hash);
}

TEST(password, costs_what_is_usual_unless_it_is_said) {
  EXPECT_EQ(password_hash{}.n * password_hash{}.r * 128, 32U * 1024 * 1024);
}

TEST(password, a_cost_that_would_take_all_the_memory_is_none) {
  auto kept = hash_password("correct horse", cheap());
  ASSERT_TRUE(is_sane(kept));
  auto wrong = kept;
  wrong.n = 1ULL << 40U;
  EXPECT_FALSE(is_sane(wrong));
  EXPECT_FALSE(is_password("correct horse", wrong));
  for (const std::uint64_t n : {0ULL, 1ULL, 3ULL, 1ULL << 21U}) {
    wrong.n = n;
    EXPECT_FALSE(is_sane(wrong)) << n;
  }
  wrong = kept;
  wrong.hash.pop_back();
  EXPECT_FALSE(is_sane(wrong));
  wrong = kept;
  wrong.salt[0] = 'X';
  EXPECT_FALSE(is_sane(wrong));
}

TEST(token, is_43_characters_that_nobody_else_gets) {
  const auto one = new_token();
  EXPECT_EQ(one.revealed().size(), token_size);
  EXPECT_NE(one.revealed(), new_token().revealed());
  EXPECT_EQ(one.revealed().find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"),
            std::string_view::npos);
}

TEST(token, its_hash_is_sha_256) { // NIST, FIPS 180-2, B.1
  EXPECT_EQ(hash_of_token("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

} // namespace password_test
