#include "programs/godwit-sim/missions/running_service.hpp"

#include <chrono>
#include <csignal>
#include <utility>

#include <nlohmann/json.hpp>

#include "actors/domain/mission/read.hpp"
#include "io/http/tls.hpp"
#include "programs/godwit-sim/missions/answer_table.hpp"
#include "programs/godwit-sim/missions/control_answers.hpp"
#include "programs/godwit-sim/missions/delivered_table.hpp"
#include "programs/godwit-sim/missions/mission_table.hpp"
#include "programs/godwit-sim/missions/service_calls.hpp"
#include "programs/godwit-sim/missions/service_operations.hpp"
#include "programs/godwit-sim/missions/synthetic_map.hpp"

namespace godwit::sim::missions {
namespace {

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

} // namespace

tl::expected<std::unique_ptr<running_service>, std::string> running_service::open(service_settings settings,
                                                                                  teller tell) {
  std::unique_ptr<running_service> made(new running_service(std::move(settings), std::move(tell)));
  if (auto started = made->start(); !started)
    return tl::unexpected(std::move(started.error()));
  return made;
}

running_service::running_service(service_settings settings, teller tell)
    : settings_(std::move(settings)), teller_(std::move(tell)), thread_(io::link::start_io_thread()),
      refusal_(thread_->context()), signals_(thread_->context()) {}

running_service::~running_service() {
  thread_->run_inside([this] {
    if (!server_)
      return;
    server_->stop_listening();
    server_->end_connections();
  });
  control_.reset(); // here and not inside: it waits for the thread
  thread_->stop();
}

running_service::done running_service::start() {
  if (auto opened = open_file(); !opened)
    return opened;
  service_.emplace(*file_, access_tokens{settings_.token, settings_.foreign_token});
  faulty_.emplace(*service_, faults_);
  done started;
  thread_->run_inside([&] { started = start_server(); });
  if (!started || !settings_.control)
    return started;
  auto failing = control_opened_.get_future();
  thread_->run_inside([this] { open_control(); });
  if (auto failure = failing.get(); !failure.empty())
    return tl::unexpected("the control port: " + failure);
  return {};
}

running_service::done running_service::open_file() {
  auto opened = service_file::open(settings_.database);
  if (!opened)
    return tl::unexpected(std::move(opened.error()));
  file_ = *std::move(opened);
  forget_answers(*file_, now_ns() / second_ns);
  return put_missions();
}

running_service::done running_service::put_missions() {
  std::uint64_t number = 0;
  for (const auto& each : settings_.missions) {
    if (!find_mission(*file_, each.mission_id))
      if (auto added = service_operations::add_mission(*file_, each); !added)
        return added;
    const auto seed = settings_.seed + number++;
    const auto row = find_mission(*file_, each.mission_id);
    const bool wants_map = settings_.map.count > 0 && row && !row->deleted_at;
    if (wants_map && map_object_count(*file_, each.mission_id) == 0)
      if (auto put = service_operations::set_map_objects(*file_, each.mission_id, synthetic_map(settings_.map, seed));
          !put)
        return put;
  }
  settings_.missions.clear();
  if (auto failed = file_->take_error(); !failed.empty())
    return tl::unexpected(settings_.database + ": " + failed);
  return {};
}

running_service::done running_service::start_server() {
  server_tls tls;
  for (const auto& [who, context] :
       {std::pair{&settings_.tls, &tls.usual}, {&settings_.wrong_host_tls, &tls.wrong_host}}) {
    if (!*who)
      continue;
    auto made = io::http::make_server_tls_context((*who)->certificate, (*who)->key);
    if (!made)
      return tl::unexpected(made.error().message());
    *context = *std::move(made);
  }
  has_wrong_host_ = tls.usual && tls.wrong_host;
  server_.emplace(thread_->context(),
                  io::http::server_settings{
                      .host = settings_.host, .port = settings_.port, .max_body_bytes = mission::max_mission_bytes},
                  *faulty_, faults_, std::move(tls), teller_);
  if (auto listening = server_->listen(); !listening)
    return listening;
  for (const auto& each : settings_.faults)
    if (auto set = set_fault(each); !set)
      return set;
  if (settings_.ends_on_signals)
    end_on_signals();
  return {};
}

void running_service::end_on_signals() {
  signals_.add(SIGINT);
  signals_.add(SIGTERM);
  signals_.async_wait([this](const boost::system::error_code& cancelled, int) {
    if (!cancelled)
      end();
  });
}

void running_service::open_control() {
  control_ = std::make_unique<control_port>(
      [this](const nlohmann::json& request) { return answer_control(*this, request); },
      [this](const io::link::link_status& status) {
        if (status.phase != io::link::link_phase::connecting)
          control_answered(status.phase == io::link::link_phase::down ? status.reason : "");
      });
  if (auto opened = control_->open(*settings_.control, thread_); !opened)
    control_answered(opened.error());
}

void running_service::control_answered(const std::string& failure) {
  if (!std::exchange(control_has_answered_, true))
    control_opened_.set_value(failure);
}

std::string running_service::control() const {
  const auto text = control_ ? control_->description() : std::string();
  return text.empty() ? text : text.substr(text.find("//") + 2);
}

running_service::done running_service::set_fault(std::string_view spec) {
  const auto rule = parse_fault_rule(spec);
  if (!rule)
    return tl::unexpected(rule.error());
  const bool is_wrong_host = std::holds_alternative<fault::wrong_host>(rule->what);
  if (is_wrong_host && !has_wrong_host_)
    return tl::unexpected(std::string("there is no certificate of a wrong host: name one with --wrong-host-tls"));
  if (auto added = faults_.add(spec); !added)
    return tl::unexpected(std::move(added.error()));
  const auto* const refusal = std::get_if<fault::refuse>(&rule->what);
  if (refusal != nullptr)
    server_->stop_listening();
  if (refusal != nullptr && refusal->time)
    refuse_for(*refusal->time);
  if (refusal != nullptr || is_wrong_host)
    server_->end_connections();
  return {};
}

void running_service::refuse_for(std::chrono::nanoseconds time) {
  refusal_.expires_after(time);
  refusal_.async_wait([this](const boost::system::error_code& cancelled) {
    if (cancelled)
      return;
    faults_.end_refusal();
    if (faults_.refuses())
      return;
    if (auto listening = server_->listen(); !listening && teller_)
      teller_(listening.error());
  });
}

void running_service::clear_faults() {
  faults_.clear();
  refusal_.cancel();
  if (auto listening = server_->listen(); !listening && teller_)
    teller_(listening.error());
}

running_service::done running_service::add_mission(const mission::document& mission) {
  auto added = service_operations::add_mission(*file_, mission);
  if (added)
    server_->wake_polls();
  return added;
}

tl::expected<mission::assignment, std::string> running_service::assign(const std::string& mission_id,
                                                                       const assignment_request& wanted) {
  auto made = service_operations::assign(*file_, mission_id, wanted, settings_.seed);
  if (made)
    server_->wake_polls();
  return made;
}

running_service::done running_service::delete_mission(const std::string& mission_id) {
  auto deleted = service_operations::delete_mission(*file_, mission_id, now_ns());
  if (deleted)
    server_->wake_polls();
  return deleted;
}

std::optional<mission::document> running_service::current_mission(const std::string& mission_id) {
  const auto row = find_mission(*file_, mission_id);
  if (!row || row->deleted_at)
    return std::nullopt;
  return stored_mission(*file_, mission_id);
}

tl::expected<std::string, std::string> running_service::only_mission() {
  const auto ids = live_missions(*file_);
  if (ids.size() == 1)
    return ids.front();
  return tl::unexpected(ids.empty() ? std::string("there is no mission")
                                    : std::string("there are several missions: name one with \"mission\""));
}

service_figures running_service::figures() {
  service_figures all;
  faulty_->count_into(all);
  all.rows = row_counts(*file_);
  all.replayed = replays(*file_);
  all.connections = server_->figures();
  all.faults = faults_.figures();
  return all;
}

void running_service::end() {
  if (!std::exchange(has_ended_, true))
    ended_.set_value();
}

} // namespace godwit::sim::missions
