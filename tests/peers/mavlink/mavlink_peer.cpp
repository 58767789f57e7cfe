// mavlink_peer: our side of the check against an implementation of MAVLink that is not ours.
//
//   mavlink_peer write FOLDER [SEED]       frames of all our messages, and what the peer must find in them
//   mavlink_peer read FRAMES LINES         holds the frames of the peer against the descriptions that it wrote
//   mavlink_peer self-test FRAMES LINES    changes each field and each byte of these: each must be noticed
//
// Exit 0 if all is as it must be, 1 if not, 2 on wrong usage.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/peers/mavlink/field_text.hpp"
#include "tests/peers/mavlink/peer_messages.hpp"
#include "tests/peers/mavlink/read_frames.hpp"
#include "tests/peers/mavlink/write_ours.hpp"

namespace godwit::io::mavlink::peers {
namespace {

constexpr std::uint64_t default_seed = 1;
constexpr std::size_t max_printed = 20; // differences; the rest is counted

std::ifstream open(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw std::runtime_error(path + " can not be read");
  return file;
}

std::vector<std::byte> load_frames(const std::string& path) {
  auto file = open(path);
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto bytes = std::as_bytes(std::span(content));
  return {bytes.begin(), bytes.end()};
}

std::vector<described_frame> load_descriptions(const std::string& path) {
  auto file = open(path);
  std::vector<described_frame> result;
  for (std::string line; std::getline(file, line);)
    result.push_back(from_line(line));
  return result;
}

// Each of our messages must be there, signed and unsigned: what is not, was not compared.
std::vector<std::string> uncovered(const std::vector<described_frame>& expected) {
  std::set<std::string> covered;
  for (const auto& each : expected)
    covered.insert(each.message + ' ' + each.frame.at("signature"));
  std::vector<std::string> result;
  for_each_message([&]<message M>() {
    for (const char* signature : {" none", " right"})
      if (!covered.contains(std::string(type_name<M>()) + signature))
        result.push_back(std::string(type_name<M>()) + ": no frame with signature:" + signature);
  });
  return result;
}

std::vector<std::string> all_differences(const std::vector<described_frame>& expected,
                                         const std::vector<described_frame>& found) {
  std::vector<std::string> result;
  if (expected.size() != found.size())
    result.push_back(std::to_string(found.size()) + " frames, expected " + std::to_string(expected.size()));
  for (std::size_t i = 0; i < std::min(expected.size(), found.size()); ++i)
    for (const auto& each : differences(expected[i], found[i]))
      result.push_back("frame " + std::to_string(i) + ": " + each);
  return result;
}

std::string summary(const std::vector<described_frame>& frames) {
  std::set<std::string> messages;
  std::size_t fields = 0;
  std::size_t with_signature = 0;
  for (const auto& each : frames) {
    messages.insert(each.message);
    fields += each.fields.size();
    with_signature += each.frame.contains("link") ? 1 : 0;
  }
  return std::to_string(frames.size()) + " frames of " + std::to_string(messages.size()) + " messages, " +
         std::to_string(with_signature) + " signed, " + std::to_string(fields) + " fields";
}

int report(const std::string& what, const std::string& good, const std::vector<std::string>& wrong) {
  for (std::size_t i = 0; i < std::min(wrong.size(), max_printed); ++i)
    std::printf("%s\n", wrong[i].c_str());
  const std::string result = wrong.empty() ? good : "ERROR: " + std::to_string(wrong.size()) + " wrong";
  std::printf("%s: %s\n", what.c_str(), result.c_str());
  return wrong.empty() ? 0 : 1;
}

int read(const std::string& frames, const std::string& lines) {
  const auto expected = load_descriptions(lines);
  auto wrong = all_differences(expected, read_frames(load_frames(frames)));
  const auto missing = uncovered(expected);
  wrong.insert(wrong.end(), missing.begin(), missing.end());
  return report("read " + summary(expected), "all equal", wrong);
}

// A description in which one text was changed must differ in exactly that.
std::size_t change_each_text(const described_frame& right, texts described_frame::*part,
                             std::vector<std::string>& unnoticed) {
  for (const auto& [name, text] : right.*part) {
    auto changed = right;
    (changed.*part)[name] += '0';
    if (differences(changed, right).size() != 1)
      unnoticed.push_back(right.message + ' ' + name + ": the change was not noticed");
  }
  return (right.*part).size();
}

// A frame in which one bit was changed must not be read as it was.
std::size_t change_each_byte(std::vector<std::byte> frame, const described_frame& right,
                             std::vector<std::string>& unnoticed) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const std::byte before = frame[i];
    frame[i] ^= std::byte{1} << (i % 8);
    if (all_differences({right}, read_frames(frame)).empty())
      unnoticed.push_back(right.message + ": the change of byte " + std::to_string(i) + " was not noticed");
    frame[i] = before;
  }
  return frame.size();
}

int self_test(const std::string& frames, const std::string& lines) {
  const auto expected = load_descriptions(lines);
  const auto bytes = load_frames(frames);
  std::vector<std::string> unnoticed;
  std::size_t texts_changed = 0;
  std::size_t bytes_changed = 0;
  byte_view rest = bytes;
  for (const auto& each : expected) {
    if (rest.size() < min_frame_size || rest.size() < frame_size(rest.data()))
      throw std::runtime_error(frames + " holds fewer frames than are described");
    const auto frame = rest.first(frame_size(rest.data()));
    texts_changed += change_each_text(each, &described_frame::frame, unnoticed);
    texts_changed += change_each_text(each, &described_frame::fields, unnoticed);
    bytes_changed += change_each_byte({frame.begin(), frame.end()}, each, unnoticed);
    rest = rest.subspan(frame.size());
  }
  return report("self-test: " + std::to_string(texts_changed) + " texts and " + std::to_string(bytes_changed) +
                    " bytes changed, one at a time",
                "all noticed", unnoticed);
}

int write(const std::string& folder, std::uint64_t seed) {
  write_ours(folder, seed);
  std::printf("written with seed %llu: %s\n", static_cast<unsigned long long>(seed),
              summary(load_descriptions(folder + "/frames.jsonl")).c_str());
  return 0;
}

std::optional<std::uint64_t> parse_seed(std::string_view text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(seed) : std::nullopt;
}

int run(const std::vector<std::string>& arguments) {
  const std::string command = arguments.empty() ? "" : arguments[0];
  if (command == "write" && arguments.size() == 2)
    return write(arguments[1], default_seed);
  if (command == "write" && arguments.size() == 3)
    if (const auto seed = parse_seed(arguments[2]))
      return write(arguments[1], *seed);
  if (command == "read" && arguments.size() == 3)
    return read(arguments[1], arguments[2]);
  if (command == "self-test" && arguments.size() == 3)
    return self_test(arguments[1], arguments[2]);
  std::fputs("usage: mavlink_peer write FOLDER [SEED] | read FRAMES LINES | self-test FRAMES LINES\n", stderr);
  return 2;
}

} // namespace
} // namespace godwit::io::mavlink::peers

int main(int argc, char** argv) {
  try {
    return godwit::io::mavlink::peers::run({argv + 1, argv + argc});
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "mavlink_peer: %s\n", failure.what());
    return 1;
  }
}
