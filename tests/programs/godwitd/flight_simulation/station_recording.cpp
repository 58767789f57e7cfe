#include "tests/programs/godwitd/flight_simulation/station_recording.hpp"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "io/mavlink/ids.hpp"
#include "io/mavlink/messages.hpp"
#include "io/mavlink/messages/request_data_stream.hpp"

namespace station_recording {
namespace {

using namespace godwit::io;
using field_texts = std::map<std::string, std::string>;

template <class V>
void set(V& value, const std::string& text) {
  if constexpr (std::is_floating_point_v<V>)
    value = text == "nan" ? std::nanf("") : static_cast<V>(std::stod(text));
  else if constexpr (std::is_integral_v<V>)
    value = static_cast<V>(std::stoll(text));
  else
    throw std::invalid_argument("no number: " + text);
}

template <mavlink::message M>
mavlink::frame_buffer frame_of(const field_texts& texts, mavlink::sender who) {
  M message;
  std::size_t found = 0;
  for_each_field<M>([&](const auto& entry) {
    if (const auto text = texts.find(std::string(entry.name)); text != texts.end()) {
      set(message.*entry.member, text->second);
      ++found;
    }
  });
  if (found != texts.size())
    throw std::invalid_argument("a field that the message does not have");
  return mavlink::encode(message, who, 0);
}

std::vector<std::byte> bytes_of(const std::string& hex) {
  std::vector<std::byte> result;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    result.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return result;
}

std::optional<mavlink::frame_buffer> raw_frame(const std::string& name, const std::string& payload,
                                               mavlink::sender who) {
  for (const auto& each : mavlink::known_ids())
    if (each.name == name)
      return mavlink::frame_buffer(each.id, each.crc_extra, bytes_of(payload), who, 0, false);
  return std::nullopt;
}

mavlink::frame_buffer frame_from(const std::string& name, const field_texts& texts, mavlink::sender who) {
  std::optional<mavlink::frame_buffer> result;
  if (const auto payload = texts.find("payload"); payload != texts.end()) {
    result = raw_frame(name, payload->second, who);
  } else {
    mavlink::known_messages::for_each([&]<class M>() {
      if (M::fields.type_name == name)
        result = frame_of<M>(texts, who);
    });
  }
  if (!result)
    throw std::invalid_argument("no message " + name);
  return *result;
}

recorded_frame frame_in(const std::string& line) {
  std::istringstream words(line);
  double at_s = 0;
  std::string direction;
  std::string name;
  if (!(words >> at_s >> direction >> name) || (direction != ">" && direction != "<"))
    throw std::invalid_argument("no time, direction and message");
  field_texts texts;
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals == std::string::npos)
      throw std::invalid_argument("no field: " + word);
    texts[word.substr(0, equals)] = word.substr(equals + 1);
  }
  const bool is_stations = direction == ">";
  return {std::llround(at_s * 1e9), is_stations, frame_from(name, texts, is_stations ? station_id : vehicle_id)};
}

} // namespace

std::vector<recorded_frame> read(const std::string& file) {
  std::ifstream text(file);
  std::vector<recorded_frame> result;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.empty() || line.front() == '#')
      continue;
    try {
      result.push_back(frame_in(line));
    } catch (const std::logic_error& why) {
      throw std::runtime_error(file + ':' + std::to_string(number) + ": " + why.what());
    }
  }
  if (result.empty())
    throw std::runtime_error(file + ": there is nothing in it");
  return result;
}

} // namespace station_recording
