// Recordings whose chunks are compressed: written, read, cut, damaged, completed.
#include "io/mcap/chunks.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "io/mcap/repair.hpp"
#include "io/mcap/salvage_reader.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace compression_test {

constexpr std::uint32_t messages_a_chunk = 40;
constexpr std::uint32_t chunks = 3;

// Chunks that are large enough to be compressed.
byte_buffer compressed_recording(const std::filesystem::path& path, bool closed) {
  const two_channels channels;
  segment_writer writer{channels.registry};
  require(writer.open(path));
  for (std::uint32_t n = 0; n < chunks * messages_a_chunk; ++n) {
    require(write_numbered(writer, channels, n));
    if (n % messages_a_chunk == messages_a_chunk - 1) {
      require(writer.flush());
    }
  }
  if (closed) {
    require(writer.close());
  } else {
    writer.abandon();
  }
  return load_bytes(path);
}

bool stands_in(byte_view file, std::string_view words) {
  const auto bytes = bytes_of(words);
  return std::search(file.begin(), file.end(), bytes.begin(), bytes.end()) != file.end();
}

std::size_t messages_salvaged(byte_view file) {
  const memory_source source{file};
  salvage_reader reader{source};
  std::size_t messages = 0;
  for (;;) {
    const auto item = reader.next();
    if (!item || std::holds_alternative<end_of_file>(*item)) {
      return messages;
    }
    messages += std::holds_alternative<message_record>(*item) ? 1 : 0;
  }
}

TEST(mcap_compression, chunks_of_some_size_are_compressed_and_read_back) {
  const temporary_folder folder;
  for (const bool closed : {true, false}) {
    const auto file = compressed_recording(folder / (closed ? "closed.mcap" : "open.mcap"), closed);
    EXPECT_TRUE(stands_in(file, "zstd"));
    EXPECT_FALSE(stands_in(file, payload_of(7)));
    const auto seen = read_all(file);
    EXPECT_EQ(seen.end, closed ? ending::complete : ending::truncated) << seen.failure.message();
    ASSERT_EQ(seen.messages.size(), chunks * messages_a_chunk);
    for (std::uint32_t n = 0; n < seen.messages.size(); ++n) {
      EXPECT_EQ(seen.messages[n], numbered(n));
    }
    EXPECT_EQ(messages_salvaged(file), seen.messages.size());
  }
}

TEST(mcap_compression, a_cut_costs_its_chunk_alone_and_a_completed_file_is_whole) {
  const temporary_folder folder;
  const auto whole = compressed_recording(folder / "open.mcap", false);
  for (std::size_t cut_at = 0; cut_at < whole.size(); cut_at += 7) {
    const auto cut = byte_view{whole}.first(cut_at);
    const auto messages = read_all(cut).messages.size();
    ASSERT_EQ(messages % messages_a_chunk, 0U);
    ASSERT_EQ(messages_salvaged(cut), messages) << cut_at;
    store_bytes(folder / "cut.mcap", cut);
    if (!complete(folder / "cut.mcap")) {
      continue;
    }
    const auto completed = read_file(folder / "cut.mcap");
    ASSERT_EQ(completed.end, ending::complete) << cut_at << ": " << completed.failure.message();
    ASSERT_EQ(completed.messages.size(), messages);
  }
}

TEST(mcap_compression, a_flipped_byte_costs_at_most_its_chunk) {
  const temporary_folder folder;
  const auto whole = compressed_recording(folder / "closed.mcap", true);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto file = whole;
    file[at] ^= std::byte{0x41};
    ASSERT_GE(messages_salvaged(file) + messages_a_chunk, chunks * messages_a_chunk) << at;
  }
}

TEST(mcap_compression, what_does_not_become_smaller_is_left_as_it_is) {
  compressor pack;
  byte_buffer noise;
  std::uint32_t state = 1;
  for (int n = 0; n < 1000; ++n) {
    state = state * 1'664'525 + 1'013'904'223;
    noise.push_back(static_cast<std::byte>(state >> 24U));
  }
  byte_buffer out{std::byte{7}};
  EXPECT_FALSE(pack.compress(noise, out));
  EXPECT_EQ(out.size(), 1U);
}

TEST(mcap_compression, another_size_than_was_said_is_refused) {
  compressor pack;
  byte_buffer packed;
  const std::string text(1000, 'x');
  ASSERT_TRUE(pack.compress(bytes_of(text), packed));
  decompressor unpack;
  byte_buffer back;
  EXPECT_TRUE(unpack.decompress(packed, 1000, back));
  EXPECT_TRUE(std::ranges::equal(back, bytes_of(text)));
  EXPECT_FALSE(unpack.decompress(packed, 999, back));
  EXPECT_FALSE(unpack.decompress(packed, 1001, back));
  EXPECT_FALSE(unpack.decompress(byte_view{packed}.first(packed.size() - 1), 1000, back));
}

} // namespace compression_test
} // namespace godwit::io::mcap::test
