// Writes a trace as large as is asked for, in the form in which godwitd writes it: for the figures of godwit-trace
// (scripts/bench_trace) and for the tests of its command line. Pattern: bytes of a vehicle wake vehicle_link, which
// tells a position to executor and failsafe; each hundredth time the executor orders something, which is answered.
//
//   write_trace FOLDER MESSAGES [CHANGED | now]     CHANGED: the number of the message whose content differs
//                                                   now: the messages are of now on, and not of some day
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "io/mcap/rotating_writer.hpp"

namespace {

using namespace godwit::io::mcap;

constexpr std::uint64_t some_day_ns = 1'795'000'000'000'000'000; // in November 2026
constexpr std::uint64_t step_ns = 20'000;
constexpr std::uint64_t address_shift = 41; // as in a message id of godwit
constexpr std::uint64_t order_each = 100;

class trace {
public:
  trace(const char* folder, std::uint64_t begin_ns, std::uint64_t changed) : begin_ns_(begin_ns), changed_(changed) {
    rotating_writer_options options;
    options.segments.folder = folder;
    options.segments.total_bytes = std::uint64_t{1} << 40U;
    options.run = 1;
    options.run_info = {{"run", "1"}};
    options.flush_interval_ns = 0;
    require(writer_.open(options));
  }

  std::uint64_t count() const { return count_; }

  std::uint64_t add(std::uint64_t address, const char* actor, const char* type, const char* sender, std::uint64_t cause,
                    const std::string& body) {
    const auto id = (address << address_shift) + ++ids_[address];
    const std::string text =
        R"({"id":)" + std::to_string(id) + R"(,"cause":)" + std::to_string(cause) + R"(,"actor":")" + actor +
        R"(","incarnation":1,"sender":")" + sender + R"(","duration_ns":)" + std::to_string(1'000 + id % 5'000) +
        R"(,"outcome":"handled","message":)" + (count_ == changed_ ? R"({"changed":1})" : body) + '}';
    const auto at_ns = begin_ns_ + count_++ * step_ns;
    require(writer_.write({channel(actor, type), static_cast<std::uint32_t>(count_), at_ns, at_ns, bytes_of(text)}));
    constexpr std::uint64_t messages_a_flush = 5'000; // 100 ms
    if (count_ % messages_a_flush == 0)
      require(writer_.flush());
    return id;
  }

  void close() { require(writer_.close()); }

private:
  static void require(const result<void>& done) {
    if (done)
      return;
    std::fprintf(stderr, "write_trace: %s\n", done.error().message().c_str()); // NOLINT(*-vararg)
    std::exit(1);                                                              // NOLINT(concurrency-mt-unsafe)
  }

  channel_id channel(const std::string& actor, const std::string& type) {
    const auto topic = '/' + actor + '/' + type;
    if (const auto known = channels_.find(topic); known != channels_.end())
      return known->second;
    const auto schema = writer_.add_schema(type, "jsonschema", bytes_of("{}"));
    return channels_[topic] = *writer_.add_channel(*schema, topic, "json");
  }

  rotating_writer writer_;
  std::map<std::string, channel_id> channels_;
  std::map<std::uint64_t, std::uint64_t> ids_; // the newest of each address
  std::uint64_t count_ = 0;
  std::uint64_t begin_ns_;
  std::uint64_t changed_;
};

} // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: write_trace FOLDER MESSAGES [CHANGED | now]\n", stderr);
    return 2;
  }
  const auto wanted = std::strtoull(argv[2], nullptr, 10);
  const std::string_view more = argc > 3 ? argv[3] : "";
  const auto now_ns = std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  trace to(argv[1], more == "now" ? static_cast<std::uint64_t>(now_ns) : some_day_ns,
           more.empty() || more == "now" ? UINT64_MAX : std::strtoull(argv[3], nullptr, 10));
  for (std::uint64_t n = 0; to.count() < wanted; ++n) {
    const auto wake = to.add(12, "vehicle_link", "vehicle_link.wake", "vehicle_port", 0, "{}");
    const auto position = R"({"time_boot_ms":)" + std::to_string(n) + R"(,"lat":)" + std::to_string(473'977'420 + n) +
                          R"(,"lon":85455940})";
    const auto heard = to.add(2, "executor", "GLOBAL_POSITION_INT", "vehicle_link", wake, position);
    to.add(2, "failsafe", "GLOBAL_POSITION_INT", "vehicle_link", wake, position);
    if (n % order_each != 0)
      continue;
    const auto order =
        to.add(6, "vehicle_link", "vehicle_link.send_command", "executor", heard, R"({"command":400,"param1":0})");
    to.add(2, "executor", "vehicle_link.command_outcome", "vehicle_link", order,
           R"({"command":400,"verdict":"accepted"})");
  }
  to.close();
  return 0;
}
