#include "actors/domain/mission/convert/kml_import.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <expat.h>

#include "actors/domain/mission/convert/item_import.hpp"
#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/rules.hpp"
#include "io/mavlink/enums.hpp"
#include "io/text.hpp"

namespace godwit::mission {

namespace {

constexpr std::size_t max_depth = 64; // Google Earth writes some ten levels of folders at most
constexpr std::string_view blanks = " \t\r\n";
constexpr auto above_terrain = io::mavlink::number(io::mavlink::mav_frame::global_terrain_alt);

struct drawn_place {
  double latitude = 0;
  double longitude = 0;
  std::optional<double> altitude_m;
  std::size_t line = 0;
};

// "gx:Track" is "Track".
std::string_view local_name(std::string_view name) { return name.substr(name.rfind(':') + 1); }

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

// "8.55,47.39" or "8.55,47.39,30".
std::optional<drawn_place> place_of(std::string_view tuple) {
  std::array<double, 3> numbers{};
  std::size_t count = 0;
  for (auto rest = tuple; count < numbers.size();) {
    rest.remove_prefix(rest.starts_with('+') ? 1 : 0);
    const auto [stopped, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), numbers.at(count));
    if (failure != std::errc() || !std::isfinite(numbers.at(count)))
      return std::nullopt;
    ++count;
    rest.remove_prefix(static_cast<std::size_t>(stopped - rest.data()));
    if (rest.empty())
      break;
    if (rest.front() != ',' || count == numbers.size())
      return std::nullopt;
    rest.remove_prefix(1);
  }
  if (count < 2)
    return std::nullopt;
  return drawn_place{numbers[1], numbers[0], count == numbers.size() ? std::optional(numbers[2]) : std::nullopt, 0};
}

// Expat calls it for each part of the file. One file each.
class kml_reader {
public:
  kml_reader(const import_options& options, loss_list& losses)
      : altitude_m_(options.altitude_m), losses_(losses),
        importer_(context_of(false, options.vehicle, options.allowed), losses) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(), [](void* self, const XML_Char* name, const XML_Char**) { as_reader(self).begin(name); },
        [](void* self, const XML_Char* name) { as_reader(self).end(local_name(name)); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const XML_Char* text, int size) {
      as_reader(self).take_text({text, static_cast<std::size_t>(size)});
    });
    XML_SetStartDoctypeDeclHandler(parser_.get(),
                                   [](void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
                                     as_reader(self).fail("declares a document type, which no KML needs; remove it");
                                   });
  }

  void read(std::string_view text) {
    const auto is_whole = XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), XML_TRUE);
    if (is_whole != XML_STATUS_OK && problems_.empty())
      fail(std::string("is not XML: ") + XML_ErrorString(XML_GetErrorCode(parser_.get())));
  }

  [[nodiscard]] std::vector<document_problem>& problems() { return problems_; }
  [[nodiscard]] bool is_xml() const { return XML_GetErrorCode(parser_.get()) == XML_ERROR_NONE; }
  [[nodiscard]] item_importer& importer() { return importer_; }

private:
  static kml_reader& as_reader(void* self) { return *static_cast<kml_reader*>(self); }
  [[nodiscard]] std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }
  [[nodiscard]] bool is_in_geometry() const { return geometry_depth_ != 0 && depth_ == geometry_depth_ + 1; }

  void begin(std::string_view full_name) {
    const auto name = local_name(full_name);
    if (depth_ == 0 && name != "kml")
      fail("is no KML: it begins with <" + std::string(full_name.substr(0, max_document_key)) + '>');
    if (depth_ == max_depth)
      fail("is nested deeper than " + std::to_string(max_depth) + " elements");
    ++depth_;
    text_.clear();
    text_line_ = line();
    if (skipped_from_)
      return;
    if (is_any_of(name, {"Polygon", "LinearRing", "Model", "Track", "MultiTrack", "NetworkLink"}))
      skip(name);
    else if (name.ends_with("Overlay"))
      skipped_from_ = depth_;
    else if (is_any_of(name, {"Point", "LineString"})) {
      geometry_depth_ = depth_;
      drawn_.clear();
      mode_.clear();
    }
  }

  void end(std::string_view name) {
    if (is_in_geometry() && name == "coordinates")
      take_coordinates();
    else if (is_in_geometry() && name == "altitudeMode")
      mode_ = io::trimmed(text_, blanks);
    else if (depth_ == geometry_depth_) {
      append_drawn(name);
      geometry_depth_ = 0;
    }
    if (skipped_from_ == depth_)
      skipped_from_.reset();
    --depth_;
    text_.clear();
  }

  void take_text(std::string_view text) {
    if (is_in_geometry())
      text_ += text;
  }

  void take_coordinates() {
    auto at = text_line_;
    for (std::size_t i = 0; i < text_.size();) {
      const auto end = std::min(text_.find_first_of(blanks, i), text_.size());
      const auto tuple = std::string_view(text_).substr(i, end - i);
      if (auto place = place_of(tuple)) {
        place->line = at;
        drawn_.push_back(*place);
      } else if (!tuple.empty())
        return fail_at(at, in_quotes(tuple) + " is no place", "longitude,latitude or longitude,latitude,height");
      at += end < text_.size() && text_[end] == '\n' ? 1 : 0;
      i = end + 1;
    }
  }

  void append_drawn(std::string_view what) {
    const bool has_heights = mode_ == "absolute" || mode_ == "relativeToGround";
    for (const auto& each : drawn_) {
      const auto altitude_m = has_heights ? each.altitude_m : altitude_m_;
      if (!altitude_m)
        return fail_at(each.line, "(" + std::string(what) + ") has no heights",
                       "heights above ground or sea level from the map program, or one for all with `godwitd convert "
                       "IN OUT --altitude M`, metres above home");
      if (number_ == max_items)
        return fail_at(each.line, "comes after " + std::to_string(max_items) + " places, the most of a mission");
      vehicle_item next{.number = number_++, .command = command::waypoint, .frame = frame::global_relative};
      if (has_heights)
        next.frame = mode_ == "absolute" ? frame::global : above_terrain;
      next.params = {0, 0, 0, not_given, each.latitude, each.longitude, *altitude_m};
      next.place = "line " + std::to_string(each.line);
      importer_.take(next);
    }
  }

  void skip(std::string_view name) {
    skipped_from_ = depth_;
    losses_.add({{},
                 "line " + std::to_string(line()) + ": " + std::string(name),
                 "says no place to fly to: draw a path or points",
                 "left out",
                 {}});
  }

  void fail(std::string what) {
    fail_at(line(), std::move(what));
    XML_StopParser(parser_.get(), XML_FALSE);
  }
  void fail_at(std::size_t at, std::string what, std::string allowed = {}) {
    if (problems_.size() < max_document_problems)
      problems_.push_back({"line " + std::to_string(at), std::move(what), std::move(allowed)});
  }

  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_{XML_ParserCreate(nullptr), &XML_ParserFree};
  std::optional<double> altitude_m_;
  loss_list& losses_;
  item_importer importer_;
  std::vector<document_problem> problems_;
  std::size_t depth_ = 0;                   // of the element that is open
  std::optional<std::size_t> skipped_from_; // depth of the element
  std::size_t geometry_depth_ = 0;          // of the Point or LineString that is open; 0: none
  std::string mode_;
  std::vector<drawn_place> drawn_;
  std::string text_; // of the newest element
  std::size_t text_line_ = 0;
  std::size_t number_ = 0;
};

} // namespace

import_result import_kml(std::string_view text, const import_options& options) {
  const auto failed = [&](document_errc code, std::vector<document_problem> problems) {
    return tl::unexpected(conversion_error{bounded({code, std::move(problems)}, text), {}});
  };
  if (text.size() > max_mission_bytes)
    return failed(document_errc::too_large, {{{}, "has more than 16 MiB", {}}});
  if (text.starts_with("PK\x03\x04"))
    return failed(document_errc::syntax, {{{}, "is a zip archive (KMZ): unzip it and take its doc.kml", {}}});
  loss_list losses;
  kml_reader reader(options, losses);
  reader.read(text);
  if (!reader.problems().empty())
    return failed(reader.is_xml() ? document_errc::wrong_form : document_errc::syntax, std::move(reader.problems()));
  document mission;
  mission.mission_id = options.mission_id.value_or(uuid_of_text(text));
  mission.vehicle = options.vehicle;
  auto& found = reader.importer();
  mission.items = std::move(found.items());
  if (mission.items.empty() && losses.empty())
    return failed(document_errc::wrong_form, {{{}, "holds no path and no point", {}}});
  return finished(mission, std::move(losses), options, text, {std::move(found.places()), {}, {}, true});
}

} // namespace godwit::mission
