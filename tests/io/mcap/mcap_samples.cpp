// mcap_samples FOLDER: writes one file of every kind that the writer and the repair make, for readers that are not
// ours.
#include <cstdio>
#include <exception>

#include "io/mcap/repair.hpp"
#include "tests/io/mcap/mcap_fixture.hpp"

namespace godwit::io::mcap::test {
namespace {

void write_empty(const std::filesystem::path& path) {
  const channel_registry registry;
  segment_writer writer{registry};
  require(writer.open(path));
  require(writer.close());
}

// Log times that go back and forth, as from several threads: the message index must be in order all the same.
void write_unordered(const std::filesystem::path& path) {
  const two_channels channels;
  segment_writer writer{channels.registry};
  require(writer.open(path));
  for (std::uint32_t n = 0; n < 1000; ++n) {
    const std::string payload = payload_of(n);
    require(writer.write({channels.of(n / 3), n, 5000 + (n * 7919U) % 1000U, n, bytes_of(payload)}));
    if (n % 128 == 0) {
      require(writer.flush());
    }
  }
  require(writer.close());
}

} // namespace

static void write_samples(const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  write_small_recording(folder / "closed.mcap", true);
  write_small_recording(folder / "open.mcap", false);
  write_small_recording(folder / "completed.mcap", false);
  static_cast<void>(complete(folder / "completed.mcap").value());
  byte_buffer bytes = load_bytes(folder / "open.mcap");
  bytes.resize(bytes.size() - 200); // within the last chunk
  store_bytes(folder / "cut_completed.mcap", bytes);
  static_cast<void>(complete(folder / "cut_completed.mcap").value());
  bytes = load_bytes(folder / "closed.mcap");
  bytes[bytes.size() / 4] ^= std::byte{1};
  store_bytes(folder / "closed_with_a_flipped_bit.mcap", bytes);
  write_empty(folder / "empty.mcap");
  write_unordered(folder / "unordered.mcap");
}

} // namespace godwit::io::mcap::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: mcap_samples FOLDER\n", stderr);
    return 2;
  }
  try {
    godwit::io::mcap::test::write_samples(argv[1]);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "mcap_samples: %s\n", failure.what());
    return 1;
  }
  return 0;
}
