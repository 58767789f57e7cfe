#include "programs/godwitd/log/program_log.hpp"

#include <cerrno>
#include <cstring>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spdlog/details/log_msg.h>
#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/base_sink.h>

#include "programs/common/printable.hpp"

namespace godwit::daemon {

namespace {

constexpr mode_t file_mode = 0640; // the group of the log may read it

class printer_sink final : public spdlog::sinks::base_sink<std::mutex> {
public:
  printer_sink(programs::line_printer& printer, std::unique_ptr<spdlog::formatter> form)
      : base_sink(std::move(form)), printer_(printer) {}

protected:
  void sink_it_(const spdlog::details::log_msg& said) override {
    spdlog::memory_buf_t line;
    formatter_->format(said, line);
    printer_.push({line.data(), line.size()});
  }
  void flush_() override {}

private:
  programs::line_printer& printer_;
};

spdlog::level::level_enum spdlog_level(log_level level) {
  switch (level) {
  case log_level::info:
    return spdlog::level::info;
  case log_level::warning:
    return spdlog::level::warn;
  case log_level::error:
    break;
  }
  return spdlog::level::err;
}

line_form form_of(const log_settings& wanted) {
  if (wanted.format == log_format::json)
    return line_form::json;
  return wanted.file.empty() ? line_form::plain : line_form::stamped;
}

programs::line_printer::loss_text loss_in(line_form form) {
  if (form == line_form::plain)
    return programs::line_printer::plain_loss;
  return [form](std::uint64_t lost) {
    const auto sentence = std::to_string(lost) + " lines are missing here: they could not be written fast enough";
    spdlog::memory_buf_t line;
    make_formatter(form)->format({"log", spdlog::level::warn, sentence}, line);
    return std::string(line.data(), line.size());
  };
}

// Without waiting, as a pipe that nobody reads would want it.
tl::expected<io::link::descriptor, std::string> open_file(const std::string& file) {
  io::link::descriptor opened(
      ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | O_NOFOLLOW, file_mode));
  if (!opened.is_open() && errno == ELOOP)
    return tl::make_unexpected("the log file " + file +
                               " is a symbolic link, and whoever made it chooses the file: name that itself");
  if (!opened.is_open())
    return tl::make_unexpected("the log file " + file + " can not be opened: " + std::strerror(errno));
  return opened;
}

} // namespace

tl::expected<std::unique_ptr<program_log>, std::string> program_log::open(log_settings wanted, int standard_output) {
  io::link::descriptor file;
  if (!wanted.file.empty()) {
    auto opened = open_file(wanted.file);
    if (!opened)
      return tl::make_unexpected(std::move(opened.error()));
    file = *std::move(opened);
  }
  const int number = file.is_open() ? file.number() : standard_output;
  return std::unique_ptr<program_log>(new program_log(std::move(wanted), std::move(file), number));
}

program_log::program_log(log_settings wanted, io::link::descriptor file, int number)
    : wanted_(std::move(wanted)), file_(std::move(file)),
      printer_(std::make_unique<programs::line_printer>(number, loss_in(form_of(wanted_)))),
      sink_(std::make_shared<printer_sink>(*printer_, make_formatter(form_of(wanted_)))) {
  sink_->set_level(spdlog_level(wanted_.level));
}

program_log::~program_log() = default;

void program_log::say(log_level level, std::string_view part, std::string_view sentence) {
  spdlog::logger(std::string(part), sink_)
      .log(spdlog_level(level), spdlog::string_view_t(sentence.data(), sentence.size()));
}

tl::expected<void, std::string> program_log::reopen() {
  if (wanted_.file.empty())
    return {};
  const auto fresh = open_file(wanted_.file);
  if (!fresh)
    return tl::make_unexpected(fresh.error());
  if (!printer_->put_file(fresh->number()))
    return tl::make_unexpected("the log file " + wanted_.file + " can not be exchanged: " + std::strerror(errno));
  return {};
}

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
