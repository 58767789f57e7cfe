#include "io/http/content_coding.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "io/http/response_reader.hpp"

namespace godwit::io::http {
namespace content_coding_test {

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

constexpr std::array both{content_coding::gzip, content_coding::zstd};

// Letters that repeat at random, as JSON does.
std::string some_text(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string text(size, 'a');
  for (auto& each : text)
    each = static_cast<char>('a' + random() % 7);
  return text;
}

struct unpacked {
  result<void> how;
  std::string text;
  bool is_complete = false;
  std::size_t largest = 0;
};

unpacked unpack(std::string_view packed, content_coding how, std::size_t piece) {
  content_decoder decoder(how);
  unpacked all;
  for (std::size_t at = 0; at < packed.size() && all.how; at += piece)
    all.how = decoder.feed(bytes_of(packed.substr(at, piece)), [&](std::span<const std::byte> bytes) {
      all.text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      all.largest = std::max(all.largest, bytes.size());
      return true;
    });
  all.is_complete = decoder.is_complete();
  return all;
}

TEST(http_content_coding, what_was_packed_comes_out_whatever_the_pieces) {
  for (const auto how : both)
    for (const std::size_t size : {0, 1, 300, 65'536, 200'000})
      for (const std::size_t piece : {1, 7, 4'096, 1'000'000}) {
        const auto text = some_text(size, static_cast<unsigned>(size + piece));
        const auto seen = unpack(compressed(text, how), how, piece);
        EXPECT_TRUE(seen.how && seen.is_complete) << coding_name(how) << size << ' ' << piece;
        EXPECT_EQ(seen.text, text);
        EXPECT_LE(seen.largest, read_piece_bytes);
      }
}

TEST(http_content_coding, an_end_in_the_middle_bytes_after_it_and_other_bytes_are_noticed) {
  for (const auto how : both) {
    const auto packed = compressed(some_text(100'000, 1), how);
    EXPECT_FALSE(unpack(std::string_view(packed).substr(0, packed.size() - 1), how, 1'000).is_complete);
    EXPECT_FALSE(unpack(packed + "x", how, 1'000).how);
    EXPECT_FALSE(unpack(packed + packed, how, 1'000).how) << "one stream is a body";
    EXPECT_FALSE(unpack("{\"map_objects\":[]} and so on, plain", how, 1'000).how);
  }
}

TEST(http_content_coding, damaged_bytes_end_in_an_error_or_in_other_text_and_never_in_more_than_is_taken) {
  std::mt19937 random(5);
  for (const auto how : both)
    for (int i = 0; i < 300; ++i) {
      auto packed = compressed(some_text(3'000, 2), how);
      packed[random() % packed.size()] ^= static_cast<char>(1U << (random() % 8));
      content_decoder decoder(how);
      std::size_t taken = 0;
      (void)decoder.feed(bytes_of(packed), [&](std::span<const std::byte> bytes) {
        taken += bytes.size();
        return taken < 1'000'000;
      });
      EXPECT_LT(taken, 1'000'000 + read_piece_bytes);
    }
}

// -- as the body of an answer
// ------------------------------------------------------------------------------------------

std::string answer_of(std::string_view body, content_coding how, unsigned status = 200) {
  return "HTTP/1.1 " + std::to_string(status) + " X\r\nContent-Encoding: " + std::string(coding_name(how)) +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + std::string(body);
}

result<response> read(const std::string& text, std::size_t most, std::size_t piece = read_piece_bytes) {
  response_reader reader({.max_body_bytes = most, .expected_content_type = {}, .accepts_compressed = true});
  for (std::size_t at = 0; at < text.size(); at += piece)
    if (auto fed = reader.feed(bytes_of(std::string_view(text).substr(at, piece))); !fed)
      return tl::unexpected(fed.error());
  if (!reader.is_complete())
    return failure(errc::truncated, "");
  return reader.take();
}

errc code_of(const result<response>& got) { return got ? errc{} : got.error().code; }

TEST(http_content_coding, the_bound_of_an_answer_is_that_of_what_is_unpacked) {
  const auto text = some_text(50'000, 3);
  for (const auto how : both) {
    const auto packed = compressed(text, how);
    ASSERT_LT(packed.size(), 40'000U);
    EXPECT_EQ(read(answer_of(packed, how), 50'000)->body, text);
    EXPECT_EQ(read(answer_of(packed, how), 50'000)->body_bytes, 50'000U);
    EXPECT_EQ(read(answer_of(packed, how), 50'000, 1)->body, text);
    EXPECT_EQ(code_of(read(answer_of(packed, how), 49'999)), errc::body_too_large);
  }
}

TEST(http_content_coding, a_hundred_megabytes_in_a_few_kilobytes_are_given_up_at_the_bound) {
  const std::string zeros(100'000'000, '0');
  for (const auto how : both) {
    const auto bomb = compressed(zeros, how);
    ASSERT_LT(bomb.size(), 200'000U);
    std::size_t taken = 0;
    reader_rules rules{.max_body_bytes = 2'000'000, .expected_content_type = {}, .accepts_compressed = true};
    rules.on_body = [&](std::span<const std::byte> bytes) {
      taken += bytes.size();
      return body_flow::more;
    };
    response_reader reader(rules);
    const auto text = answer_of(bomb, how);
    result<void> fed;
    for (std::size_t at = 0; at < text.size() && fed; at += read_piece_bytes)
      fed = reader.feed(bytes_of(std::string_view(text).substr(at, read_piece_bytes)));
    ASSERT_FALSE(fed);
    EXPECT_EQ(fed.error().code, errc::body_too_large);
    EXPECT_LE(taken, 2'000'000U);
  }
}

TEST(http_content_coding, a_window_that_takes_a_hundred_megabytes_is_refused) {
  // A frame of zstd whose descriptor asks for a window of 128 MiB (RFC 8878, 3.1.1.1.2: exponent 17).
  const std::string frame("\x28\xb5\x2f\xfd\x00\x88\x01\x00\x00", 9);
  EXPECT_EQ(code_of(read(answer_of(frame, content_coding::zstd), 1'000)), errc::malformed);
}

TEST(http_content_coding, a_body_that_ends_too_early_or_is_not_what_it_says_is_an_error) {
  for (const auto how : both) {
    const auto packed = compressed(some_text(5'000, 4), how);
    EXPECT_EQ(code_of(read(answer_of(std::string_view(packed).substr(0, packed.size() / 2), how), 10'000)),
              errc::truncated);
    EXPECT_EQ(code_of(read(answer_of("plain, whatever it says", how), 10'000)), errc::malformed);
  }
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Encoding: br\r\nContent-Length: 1\r\n\r\na", 10)), errc::encoded);
  EXPECT_EQ(code_of(read("HTTP/1.1 200 OK\r\nContent-Encoding: gzip, gzip\r\nContent-Length: 1\r\n\r\na", 10)),
            errc::encoded);
  EXPECT_TRUE(read("HTTP/1.1 204 X\r\nContent-Encoding: gzip\r\n\r\n", 10));
}

TEST(http_content_coding, the_beginning_of_an_error_page_is_unpacked_as_well) {
  const auto page =
      read(answer_of(compressed(std::string(200'000, 'e'), content_coding::gzip), content_coding::gzip, 503), 10);
  ASSERT_TRUE(page) << page.error().message();
  EXPECT_EQ(page->status, 503U);
  EXPECT_TRUE(page->is_cut);
  EXPECT_EQ(page->body.size(), max_error_body_bytes);
}

TEST(http_content_coding, who_answers_uses_the_best_one_that_is_accepted) {
  EXPECT_EQ(chosen_coding("zstd, gzip"), content_coding::zstd);
  EXPECT_EQ(chosen_coding("gzip, deflate, br"), content_coding::gzip);
  EXPECT_EQ(chosen_coding("identity"), std::nullopt);
  EXPECT_EQ(chosen_coding(""), std::nullopt);
}

} // namespace content_coding_test
} // namespace godwit::io::http
