#include "programs/godwitd/log/line_forms.hpp"

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>
#include <spdlog/details/log_msg.h>
#include <spdlog/pattern_formatter.h>

#include "programs/common/printable.hpp"

namespace godwit::daemon {
namespace {

std::string_view view(spdlog::string_view_t text) { return {text.data(), text.size()}; }

void append(spdlog::memory_buf_t& to, std::string_view text) { to.append(text.data(), text.data() + text.size()); }

class utc_stamp {
public:
  [[nodiscard]] std::string of(const spdlog::details::log_msg& said) {
    spdlog::memory_buf_t text;
    form_.format(said, text);
    return {text.data(), text.size()};
  }

private:
  spdlog::pattern_formatter form_{"%Y-%m-%dT%H:%M:%S.%eZ", spdlog::pattern_time_type::utc, ""};
};

class plain_formatter final : public spdlog::formatter {
public:
  void format(const spdlog::details::log_msg& said, spdlog::memory_buf_t& to) override {
    if (said.level >= spdlog::level::warn)
      append(to, said.level == spdlog::level::warn ? "warning: " : "error: ");
    append(to, programs::printable(view(said.payload)));
  }
  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<plain_formatter>();
  }
};

class stamped_formatter final : public spdlog::formatter {
public:
  void format(const spdlog::details::log_msg& said, spdlog::memory_buf_t& to) override {
    append(to, stamp_.of(said) + " ");
    append(to, view(spdlog::level::to_string_view(said.level)));
    append(to, " " + std::string(view(said.logger_name)) + ": ");
    append(to, programs::printable(view(said.payload)));
  }
  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<stamped_formatter>();
  }

private:
  utc_stamp stamp_;
};

class json_formatter final : public spdlog::formatter {
public:
  void format(const spdlog::details::log_msg& said, spdlog::memory_buf_t& to) override {
    nlohmann::ordered_json line;
    line["time"] = stamp_.of(said);
    line["level"] = view(spdlog::level::to_string_view(said.level));
    line["part"] = view(said.logger_name);
    line["message"] = view(said.payload);
    append(to, line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }
  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return std::make_unique<json_formatter>(); }

private:
  utc_stamp stamp_;
};

} // namespace

std::unique_ptr<spdlog::formatter> make_formatter(line_form form) {
  switch (form) {
  case line_form::json:
    return std::make_unique<json_formatter>();
  case line_form::stamped:
    return std::make_unique<stamped_formatter>();
  case line_form::plain:
    break;
  }
  return std::make_unique<plain_formatter>();
}

} // namespace godwit::daemon
