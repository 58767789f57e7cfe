#include "runtime/process.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "io/sqlite/work_queue.hpp"

namespace godwit::runtime {

namespace {

std::uint64_t mebibytes(const nlohmann::json& value) { return value.get<std::uint64_t>() << 20U; }

milliseconds ms(const nlohmann::json& value) { return milliseconds(value.get<std::int64_t>()); }

void post_journal(const journal_status& status, health_board& to) {
  if (status.failing)
    return to.post("journal", health_colour::red, status.reason);
  if (status.fill >= io::sqlite::nearly_full)
    return to.post("journal", health_colour::red,
                   std::to_string(status.queued) + " writes wait for the disk, " +
                       std::to_string(static_cast<int>(status.fill * 100)) +
                       " % of what may: it is too slow or hangs. No mission is started and no plan changed until then");
  to.post("journal", status.reason.empty() ? health_colour::green : health_colour::yellow, status.reason);
}

} // namespace

exit_code exit_code_for(exit_cause cause) {
  switch (cause) {
  case exit_cause::requested:
    return exit_code::ok;
  case exit_cause::guardian_died:
  case exit_cause::essential_given_up:
  case exit_cause::given_up_in_flight:
    return exit_code::essential_given_up;
  case exit_cause::essential_silent:
  case exit_cause::no_free_worker:
  case exit_cause::recovery_overdue:
    return exit_code::unresponsive;
  }
  return exit_code::failed;
}

process_options options_from(const nlohmann::json& configuration) {
  const auto& trace = configuration.at("trace");
  const auto& scheduler = configuration.at("scheduler");
  const auto& supervision = configuration.at("supervision");
  process_options result;
  result.journal.path = configuration.at("journal").at("path").get<std::string>();
  result.trace.emplace();
  result.trace->folder = trace.at("directory").get<std::string>();
  result.trace->segment_bytes = mebibytes(trace.at("segment_mib"));
  result.trace->total_bytes = mebibytes(trace.at("total_mib"));
  result.trace->flush = ms(trace.at("flush_ms"));
  result.actors.workers = scheduler.at("workers").get<std::size_t>();
  result.actors.max_throughput = scheduler.at("max_throughput").get<std::size_t>();
  result.actors.ping = {ms(supervision.at("ping_period_ms")), ms(supervision.at("ping_warn_ms")),
                        ms(supervision.at("ping_fatal_ms"))};
  result.actors.stop_timeout = ms(supervision.at("stop_timeout_ms"));
  return result;
}

tl::expected<std::unique_ptr<process>, std::string> process::open(process_options options) {
  std::unique_ptr<process> result(new process());
  options.journal.on_health_change = [health = &result->health_](const journal_status& status) {
    post_journal(status, *health);
  };
  options.journal.path = journal_in_use(options.journal.path);
  auto journal = sqlite_journal::open(options.journal);
  if (!journal)
    return tl::unexpected(journal.error().message());
  result->journal_ = std::move(*journal);
  (void)result->look_at_journal();
  if (options.trace) {
    options.trace->run = result->journal_->status().run;
    auto trace = ring_trace::open(std::move(*options.trace), result->names_, result->time_, result->health_);
    if (!trace)
      return tl::unexpected(trace.error());
    result->trace_ = std::move(*trace);
  }
  services outside;
  outside.time = &result->time_;
  outside.names = &result->names_;
  outside.health = &result->health_;
  outside.durable = result->journal_.get();
  outside.trace = result->trace_.get();
  outside.crashes = options.crashes;
  outside.seed = options.seed;
  result->actors_ = std::make_unique<runtime::system>(outside, options.actors);
  return result;
}

process::~process() { (void)finish(0); }

journal_status process::look_at_journal() {
  auto status = journal_->status();
  post_journal(status, health_);
  return status;
}

int process::finish(int code) {
  const bool clean = !actors_ || actors_->stop();
  if (trace_)
    trace_->close();
  if (!clean) {
    journal_->close();
    std::fflush(nullptr);
    std::_Exit(code);
  }
  actors_.reset();
  if (journal_)
    journal_->close();
  return code;
}

} // namespace godwit::runtime
