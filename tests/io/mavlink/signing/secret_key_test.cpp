#include "io/mavlink/signing/secret_key.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <ostream>
#include <type_traits>

#include <gtest/gtest.h>

#include "tests/io/mavlink/signing/signing_fixture.hpp"

namespace godwit::io::mavlink::test {
namespace secret_key_test {

template <class T>
concept printable = requires(std::ostream& out, const T& value) {
  out << value;
};

bool is_zero(std::span<const std::byte> bytes) {
  return std::ranges::all_of(bytes, [](std::byte each) { return each == std::byte{0}; });
}

TEST(mavlink_secret_key, can_not_be_printed_or_copied) {
  static_assert(!printable<secret_key>);
  static_assert(!std::is_copy_constructible_v<secret_key> && !std::is_copy_assignable_v<secret_key>);
  static_assert(std::is_nothrow_move_constructible_v<secret_key> && std::is_nothrow_move_assignable_v<secret_key>);
}

TEST(mavlink_secret_key, a_move_wipes_what_it_leaves) {
  secret_key from = counting_key();
  secret_key to(std::move(from));
  EXPECT_TRUE(is_zero(from.bytes())); // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_TRUE(std::ranges::equal(to.bytes(), counting_key().bytes()));
  secret_key assigned = counting_key(100);
  assigned = std::move(to);
  EXPECT_TRUE(is_zero(to.bytes())); // NOLINT(bugprone-use-after-move)
  EXPECT_TRUE(std::ranges::equal(assigned.bytes(), counting_key().bytes()));
}

TEST(mavlink_secret_key, is_wiped_when_it_ends) {
  alignas(secret_key) std::array<std::byte, sizeof(secret_key)> memory{};
  auto* const key = new (memory.data()) secret_key(counting_key(1));
  ASSERT_FALSE(is_zero(memory));
  std::destroy_at(key);
  EXPECT_TRUE(is_zero(memory));
}

TEST(mavlink_secret_key, only_a_key_of_zeros_is_all_zero) {
  std::array<std::byte, secret_key_size> bytes{};
  EXPECT_TRUE(secret_key(bytes).is_all_zero());
  bytes.back() = std::byte{1};
  EXPECT_FALSE(secret_key(bytes).is_all_zero());
}

} // namespace secret_key_test
} // namespace godwit::io::mavlink::test
