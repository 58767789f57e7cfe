#include "tests/io/mcap/mcap_fixture.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

namespace godwit::io::mcap::test {

void require(const result<void>& outcome) {
  if (!outcome) {
    throw std::runtime_error{outcome.error().message()};
  }
}

temporary_folder::temporary_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "godwit-mcap-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error{"mkdtemp"};
  }
  path_ = name;
}

temporary_folder::~temporary_folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

namespace {

class collector {
public:
  explicit collector(reading& into) : into_{into} {}
  void operator()(const header_record& header) { into_.library = header.library; }
  void operator()(const schema_record& schema) { into_.schemas.emplace_back(schema.name); }
  void operator()(const channel_record& channel) { topics_[channel.id] = channel.topic; }
  void operator()(const message_record& message) {
    const auto* text = reinterpret_cast<const char*>(message.data.data());
    into_.messages.push_back(
        {topics_.at(message.channel), message.sequence, message.log_time_ns, std::string(text, message.data.size())});
  }
  void operator()(const metadata_record& metadata) { into_.metadata.emplace_back(metadata.name); }
  void operator()(const statistics_record& statistics) { into_.statistics = statistics; }
  void operator()(const end_of_file&) { into_.end = ending::complete; }
  void operator()(const truncated& torn) {
    into_.end = ending::truncated;
    into_.torn = torn;
  }

private:
  reading& into_;
  std::map<channel_id, std::string> topics_;
};

bool is_last(const strict_mcap_reader::item& item) {
  return std::holds_alternative<end_of_file>(item) || std::holds_alternative<truncated>(item);
}

} // namespace

reading read_all(const byte_source& source, read_limits limits) {
  reading seen;
  collector collect{seen};
  strict_mcap_reader reader{source, limits};
  for (;;) {
    const auto item = reader.next();
    if (!item) {
      seen.end = ending::error;
      seen.failure = item.error();
      return seen;
    }
    std::visit(collect, *item);
    if (is_last(*item)) {
      return seen;
    }
  }
}

reading read_all(byte_view bytes, read_limits limits) { return read_all(memory_source{bytes}, limits); }

reading read_file(const std::filesystem::path& path) {
  file_source source;
  require(source.open(path));
  return read_all(source);
}

byte_buffer load_bytes(const std::filesystem::path& path) {
  std::ifstream file{path, std::ios::binary};
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  const byte_view bytes = bytes_of(text);
  return {bytes.begin(), bytes.end()};
}

void store_bytes(const std::filesystem::path& path, byte_view bytes) {
  std::ofstream file{path, std::ios::binary | std::ios::trunc};
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

std::string schema_text() {
  return R"({"type":"object","required":["n","text"],"properties":{"n":{"type":"integer"},"text":{"type":"string"}}})";
}

two_channels::two_channels() {
  const schema_id schema = registry.add_schema("numbered", "jsonschema", bytes_of(schema_text())).value();
  even = registry.add_channel(schema, "/even", "json", {{"actor", "even"}}).value();
  odd = registry.add_channel(schema, "/odd", "json", {{"actor", "odd"}}).value();
}

std::string payload_of(std::uint32_t n) { return R"({"n":)" + std::to_string(n) + R"(,"text":"hello"})"; }

seen_message numbered(std::uint32_t n) { return {n % 2 == 0 ? "/even" : "/odd", n, 1000 + n, payload_of(n)}; }

result<void> write_numbered(segment_writer& writer, const two_channels& channels, std::uint32_t n) {
  const std::string payload = payload_of(n);
  return writer.write({channels.of(n), n, 1000 + n, 900 + n, bytes_of(payload)});
}

void write_small_recording(const std::filesystem::path& path, bool closed) {
  const two_channels channels;
  segment_writer writer{channels.registry};
  require(writer.open(path));
  for (std::uint32_t n = 0; n < small_recording_messages; ++n) {
    require(write_numbered(writer, channels, n));
    if (n == 7) {
      require(writer.add_metadata("godwit.run", {{"run", "7"}, {"host", "test"}}));
    }
    if (n % 4 == 3) {
      require(writer.flush());
    }
  }
  if (closed) {
    require(writer.close());
  }
}

} // namespace godwit::io::mcap::test
