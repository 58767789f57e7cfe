// How large the trace of a flight is: written as godwitd writes it, of a flight in virtual time beside a PX4 that
// streams at its real rates.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "io/fields/json_text.hpp"
#include "io/mcap/rotating_writer.hpp"
#include "programs/godwit-drill/flight_simulation/flight_simulation.hpp"
#include "programs/godwit-drill/scratch_folder.hpp"

namespace trace_size_test {

using namespace godwit;
using namespace godwit::drill;
using executor::phase;

// As runtime::trace_renderer, without a schema.
class trace_files {
public:
  explicit trace_files(const std::string& folder) {
    io::mcap::rotating_writer_options options;
    options.segments.folder = folder;
    options.run = 1;
    EXPECT_TRUE(writer_.open(options));
  }

  void add(const runtime::delivery& each, const runtime::name_table& names) {
    const auto at_ns = static_cast<std::uint64_t>(each.began_ns);
    EXPECT_TRUE(writer_.tick(at_ns));
    const auto duration_ns = 2'000 + each.id * 7'919 % 60'000; // time passes in no handler of a simulation
    const auto text = R"({"id":)" + std::to_string(each.id) + R"(,"cause":)" + std::to_string(each.cause) +
                      R"(,"actor":)" + quoted(names.name(each.actor)) + R"(,"incarnation":)" +
                      std::to_string(each.incarnation) + R"(,"sender":)" + quoted(names.name(each.sender)) +
                      R"(,"duration_ns":)" + std::to_string(duration_ns) + R"(,"clock_offset_ns":)" +
                      std::to_string(duration_ns % 700) + R"(,"wall_offset_ns":)" + std::to_string(duration_ns % 800) +
                      R"(,"outcome":")" + std::string(io::name_of(each.how)) +
                      (each.oversize ? R"(","oversize":true})" : R"(","message":)" + std::string(each.body) + "}");
    auto& own = channel_of(names.name(each.actor), names.name(each.type));
    EXPECT_TRUE(writer_.write({own.id, own.sequence++, at_ns, at_ns, io::mcap::bytes_of(text)}));
    bytes_by_type[names.name(each.type)] += text.size();
    rendered_bytes += text.size();
  }
  void close() { EXPECT_TRUE(writer_.close()); }

  std::map<std::string, std::size_t> bytes_by_type; // as they are before they are compressed
  std::size_t rendered_bytes = 0;

private:
  struct channel {
    io::mcap::channel_id id{};
    std::uint32_t sequence = 0;
  };

  channel& channel_of(const std::string& actor, const std::string& type) {
    const auto topic = '/' + actor + '/' + type;
    const auto [found, is_new] = channels_.try_emplace(topic);
    if (is_new)
      found->second.id =
          *writer_.add_channel(*writer_.add_schema(type, "jsonschema", io::mcap::bytes_of("{}")), topic, "json");
    return found->second;
  }
  static std::string quoted(const std::string& text) {
    std::string result;
    io::append_json_string(result, text);
    return result;
  }

  io::mcap::rotating_writer writer_;
  std::map<std::string, channel> channels_;
};

TEST(trace_size, an_hour_beside_a_px4_at_default_streams_takes_at_most_100_mb) {
  const scratch_folder folder;
  trace_files files(folder.file("trace"));
  flight_simulation flight({.who = sim::personality::px4, .speed = 1, .stream_factor = 1, .is_recorded = true});
  flight.record().tell([&](const runtime::delivery& each) { files.add(each, flight.record().names()); });
  ASSERT_TRUE(flight.run_until_phase(phase::flying, 300)) << flight.story();
  constexpr double flown_s = 120;
  flight.run_for(flown_s);
  files.close();
  std::uintmax_t bytes = 0;
  for (const auto& each : std::filesystem::directory_iterator(folder.file("trace")))
    bytes += each.file_size();
  const auto seconds = static_cast<double>(flight.now_ns()) * 1e-9;
  const auto mb_an_hour = static_cast<double>(bytes) / seconds * 3600 * 1e-6;
  RecordProperty("mb_an_hour", std::to_string(mb_an_hour));
  RecordProperty("rendered_mb_an_hour", std::to_string(static_cast<double>(files.rendered_bytes) / seconds * 3600e-6));
  for (const auto& [type, size] : files.bytes_by_type)
    RecordProperty("mb_an_hour_of_" + type, std::to_string(static_cast<double>(size) / seconds * 3600e-6));
  EXPECT_LE(mb_an_hour, 100);
}

} // namespace trace_size_test
